#include "radiosity/visibility/coverage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "radiosity/base/box_tree.h"
#include "radiosity/scene/surface_pieces.h"
#include "radiosity/scene/winding.h"
#include "radiosity/visibility/body_finder.h"
#include "radiosity/visibility/outer_planes.h"

namespace radiosity {
namespace {

/// Shares closer to 0 or 1 are rounding.
constexpr double kShareRounding = 1e-6;
/// A solid is in a hollow if a point just off some facet is: of how many, how far off in shares of
/// their size and in thicknesses.
constexpr std::size_t kTriedFacets = 32;
constexpr double kGap = 1e-4;
constexpr double kSameVolume = 1e-6;
constexpr double kGaps = 16;
/// Of a patch that is covered but for less than a tenth, slivers that are narrower than that many
/// thicknesses are no openings: so far apart digits leave edges that were meant to coincide.
constexpr double kSliver = 8;
constexpr double kLeastCovered = 0.9;

bool is_sliver(std::span<const Vec3> polygon, double width) {
  double length2 = 0;
  for (const Vec3& a : polygon) {
    for (const Vec3& b : polygon) length2 = std::max(length2, (b - a).squaredNorm());
  }
  return 2 * vector_area(polygon).norm() <= width * std::sqrt(length2);
}

/// A face of a solid, or a wall around a hollow, that may cover patches.
struct Cover {
  std::vector<Vec3> outline;  // convex, counter-clockwise about `normal`
  Vec3 normal;                // out of the solid
  Vec3 on_plane;              // a point
  std::int32_t piece;         // that it is of, or -1: the missing face of a body
  Box3 box;
};

struct Plane {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::Zero();
};

class CoverFinder {
 public:
  CoverFinder(PatchMesh mesh, double thickness) : mesh_(std::move(mesh)), thickness_(thickness) {}

  Coverage find() {
    find_planes();
    std::vector<std::int32_t>& one_sided = patch_of_facet_;
    for (std::int32_t i = 0; i < mesh_.size(); ++i) {
      if (mesh_.twin[i] < 0) one_sided.push_back(i);
    }
    pieces_ = find_surface_pieces(mesh_, one_sided, thickness_);
    piece_of_patch_.assign(mesh_.size(), -1);
    facet_of_patch_.assign(mesh_.size(), -1);
    for (std::size_t p = 0; p < pieces_.pieces.size(); ++p) {
      for (const std::int32_t f : pieces_.pieces[p].facets) {
        piece_of_patch_[one_sided[f]] = static_cast<std::int32_t>(p);
        facet_of_patch_[one_sided[f]] = f;
      }
    }
    add_pieces();
    add_caps();
    Coverage result{Eigen::VectorXd::Zero(mesh_.size()), {}};
    if (covers_.empty()) return result;
    std::vector<Box3> boxes;
    for (const Cover& cover : covers_) boxes.push_back(cover.box);
    tree_.emplace(std::move(boxes));
    for (std::int32_t i = 0; i < mesh_.size(); ++i) cover_patch(i, result);
    return result;
  }

 private:
  /// The planes of the patches: the one of the polygon that a patch is of, where it lies in that.
  /// The digits of its own corners say little about a small patch's.
  void find_planes() {
    planes_.resize(mesh_.size());
    std::vector<Plane> polygons(mesh_.n_polygons());
    for (Index p = 0; p < mesh_.n_polygons(); ++p) {
      const std::span<const Vec3> outline = mesh_.outline(p);
      for (const Vec3& corner : outline) polygons[p].point += corner;
      polygons[p].point /= static_cast<double>(outline.size());
      polygons[p].normal = vector_area(outline).normalized();
    }
    for (std::int32_t i = 0; i < mesh_.size(); ++i) {
      planes_[i] = {mesh_.centroid[i], mesh_.normal[i]};
      if (mesh_.n_polygons() == 0) continue;
      Plane plane = polygons[mesh_.polygon[i]];
      if (plane.normal.dot(mesh_.normal[i]) < 0) plane.normal *= -1;  // of a back
      bool is_on = true;
      for (int k = 0; k < mesh_.n_corners(i); ++k) {
        is_on = is_on && std::abs(plane.normal.dot(mesh_.corner(i, k) - plane.point)) <= thickness_;
      }
      if (is_on) planes_[i] = plane;
    }
  }

  [[nodiscard]] ConvexPolygon outline_of(Index patch) const {
    ConvexPolygon result;
    for (int k = 0; k < mesh_.n_corners(patch); ++k) result.push_back(mesh_.corner(patch, k));
    return result;
  }

  void add_cover(std::span<const Vec3> outline, const Plane& plane, std::int32_t piece) {
    Cover& cover = covers_.emplace_back(
        Cover{{outline.begin(), outline.end()}, plane.normal, plane.point, piece, Box3()});
    for (const Vec3& corner : outline) cover.box.extend(corner);
  }

  void add_pieces() {
    for (std::size_t p = 0; p < pieces_.pieces.size(); ++p) {
      const SurfacePiece& piece = pieces_.pieces[p];
      if (!piece.is_solid() && !piece.is_hollow()) continue;
      // Their facets have corners of others along their edges, too, which may be off these.
      for (const std::int32_t f : piece.facets) {
        const std::int32_t patch = patch_of_facet_[f];
        add_cover(outline_of(patch).points(), planes_[patch], static_cast<std::int32_t>(p));
      }
    }
  }

  /// Whether what is behind the cover is before the patch, and not the patch's own side: a solid
  /// and a hollow that touch hide their faces from each other if the solid stands in the hollow,
  /// but not if it is the shell around it.
  [[nodiscard]] bool is_before(const Cover& cover, std::int32_t patch) {
    const std::int32_t own = piece_of_patch_[patch];
    // A solid with parts without thickness has a face for either side of these.
    if (cover.piece == own) return is_in_solid(own, sides_of(facet_of_patch_[patch]).front);
    const bool is_of_hollow = own >= 0 && pieces_.pieces[own].is_hollow();
    if (pieces_.pieces[cover.piece].is_hollow()) {
      return own >= 0 && pieces_.pieces[own].is_solid() && stands_in(own, cover.piece);
    }
    return !is_of_hollow || stands_in(cover.piece, own);
  }

  [[nodiscard]] bool is_in_solid(std::int32_t solid, const Vec3& point) {
    const SurfacePiece& piece = pieces_.pieces[solid];
    return piece.is_solid() &&
           windings_.try_emplace(solid, pieces_, piece).first->second.about(point) != 0;
  }

  [[nodiscard]] bool stands_in(std::int32_t solid, std::int32_t hollow) {
    const auto [known, is_new] = stands_in_.try_emplace({solid, hollow}, false);
    if (!is_new) return known->second;
    const SurfacePiece& around = pieces_.pieces[hollow];
    const std::vector<std::int32_t>& facets = pieces_.pieces[solid].facets;
    const std::size_t step = std::max<std::size_t>(1, facets.size() / kTriedFacets);
    const WindingNumber& winding = windings_.try_emplace(hollow, pieces_, around).first->second;
    bool has_free_front = false;
    for (std::size_t k = 0; k < facets.size() && !has_free_front; k += step) {
      const FacetSides sides = sides_of(facets[k]);
      has_free_front =
          winding.about(sides.front) != 0 && !is_back_to_back(sides.middle, sides.normal);
    }
    // Walled in by others, a solid is in the hollow that has all of it within, and more.
    bool is_within =
        !has_free_front && pieces_.pieces[solid].volume < (1 - kSameVolume) * -around.volume;
    for (std::size_t k = 0; k < facets.size() && is_within; k += step) {
      is_within = winding.about(sides_of(facets[k]).back) != 0;
    }
    known->second = has_free_front || is_within;
    return known->second;
  }

  /// A facet's middle, and points just off it.
  struct FacetSides {
    Vec3 middle, normal, front, back;
  };

  [[nodiscard]] FacetSides sides_of(std::int32_t facet) const {
    const std::span<const Vec3> outline = pieces_.outline(facet);
    Vec3 point = Vec3::Zero();
    for (const Vec3& corner : outline) point += corner;
    point /= static_cast<double>(outline.size());
    const Vec3& normal = pieces_.normal[facet];
    const double gap = kGap * (outline[1] - outline[0]).norm() + kGaps * thickness_;
    return {point, normal, point + gap * normal, point - gap * normal};
  }

  /// Whether a point of a facet lies on one that faces the other way, as on walls without thickness
  /// that have a polygon for either side.
  [[nodiscard]] bool is_back_to_back(const Vec3& point, const Vec3& normal) const {
    bool result = false;
    tree_->for_each_meeting(grown(Box3(point, point), thickness_), [&](std::int32_t k) {
      const Cover& cover = covers_[k];
      result = result || (cover.normal.dot(normal) < -0.9 && holds(cover, point));
    });
    return result;
  }

  [[nodiscard]] bool holds(const Cover& cover, const Vec3& point) const {
    if (std::abs(cover.normal.dot(point - cover.on_plane)) > thickness_) return false;
    for (std::size_t k = 0; k < cover.outline.size(); ++k) {
      const Vec3& a = cover.outline[k];
      const Vec3& b = cover.outline[k + 1 < cover.outline.size() ? k + 1 : 0];
      if (cover.normal.dot((b - a).cross(point - a)) < 0) return false;
    }
    return true;
  }

  /// What stands on an outer plane covers the floor also where it has no face there.
  void add_caps() {
    std::vector<std::int32_t> one_sided;
    for (const std::int32_t i : find_blocking_patches(mesh_, thickness_)) {
      if (mesh_.twin[i] < 0) one_sided.push_back(i);
    }
    const SurfacePieces pieces = find_surface_pieces(mesh_, one_sided, thickness_);
    const VertexBlocks vertices(mesh_);
    for (const SurfacePiece& piece : pieces.pieces) {
      if (piece.open_edges.empty()) continue;
      const auto body = find_body(pieces, piece, vertices, thickness_);
      if (!body || body->cap.size() < 3) continue;
      add_cap(*body);
    }
  }

  void add_cap(const FoundBody& body) {
    // The face about whose edges the others meet it.
    const HalfSpace& plane = body.blocker.faces.back();
    const int cap = static_cast<int>(body.blocker.faces.size()) - 1;
    Vec3 center = Vec3::Zero();
    std::vector<const Blocker::Edge*> rim;
    for (const Blocker::Edge& edge : body.blocker.edges) {
      if (edge.right == cap) rim.push_back(&edge);
    }
    for (const Blocker::Edge* edge : rim) center += edge->start;
    center /= static_cast<double>(rim.size());
    // In triangles about the middle: convex, however many corners.
    for (const Blocker::Edge* edge : rim) {
      const std::array triangle{center, edge->end, edge->start};
      add_cover(triangle, {center, plane.normal}, -1);
    }
  }

  void cover_patch(std::int32_t i, Coverage& result) {
    // Covers may overlap each other, so each is taken away from what the others left.
    std::vector<ConvexPolygon> open{outline_of(i)};
    bool is_touched = false;
    tree_->for_each_meeting(grown(patch_box(mesh_, i), thickness_), [&](std::int32_t k) {
      const Cover& cover = covers_[k];
      if (cover.normal.dot(mesh_.normal[i]) > -0.9 || !is_in_plane(i, cover)) return;
      if (cover.piece >= 0 && !is_before(cover, i)) return;
      is_touched = true;
      std::vector<ConvexPolygon> left;
      for (const ConvexPolygon& part : open) subtract(part, cover, left);
      open = std::move(left);
    });
    if (!is_touched) return;
    double area = 0;
    for (const ConvexPolygon& part : open) area += vector_area(part.points()).norm();
    const double share = 1 - area / mesh_.area[i];
    if (share <= kShareRounding) return;
    const bool is_whole =
        share >= 1 - kShareRounding ||
        (share >= kLeastCovered && std::all_of(open.begin(), open.end(), [&](const auto& part) {
           return is_sliver(part.points(), kSliver * thickness_);
         }));
    result.share[i] = is_whole ? 1 : share;
    if (result.share[i] < 1) result.open[i] = std::move(open);
  }

  /// Whether one of the two lies in the plane of the other: the plane of a small one is not known
  /// well far from it.
  [[nodiscard]] bool is_in_plane(Index i, const Cover& cover) const {
    const auto is_on = [this](const Vec3& point, const Vec3& normal, const Vec3& on_plane) {
      return std::abs(normal.dot(point - on_plane)) <= thickness_;
    };
    bool is_patch_on = true;
    for (int k = 0; k < mesh_.n_corners(i); ++k) {
      is_patch_on &= is_on(mesh_.corner(i, k), cover.normal, cover.on_plane);
    }
    return is_patch_on ||
           std::all_of(cover.outline.begin(), cover.outline.end(), [&](const Vec3& corner) {
             return is_on(corner, planes_[i].normal, planes_[i].point);
           });
  }

  /// Appends the parts of a polygon outside a cover.
  void subtract(const ConvexPolygon& polygon, const Cover& cover,
                std::vector<ConvexPolygon>& parts) const {
    ConvexPolygon rest = polygon;
    ConvexPolygon inside;
    ConvexPolygon outside;
    const std::size_t first = parts.size();
    for (std::size_t k = 0; k < cover.outline.size(); ++k) {
      const Vec3& a = cover.outline[k];
      const Vec3& b = cover.outline[k + 1 < cover.outline.size() ? k + 1 : 0];
      const Vec3 inwards = cover.normal.cross(b - a).normalized();
      split(rest, a, inwards, thickness_, inside, outside);
      rest = inside;
      if (rest.size() < 3) {  // nothing is covered
        parts.resize(first);
        parts.push_back(polygon);
        return;
      }
      if (outside.size() >= 3) add_part(outside, parts);
    }
  }

  /// In halves if further cuts might exceed the capacity.
  static void add_part(const ConvexPolygon& part, std::vector<ConvexPolygon>& parts) {
    constexpr std::size_t kMostCorners = 8;
    if (part.size() <= kMostCorners) {
      parts.push_back(part);
      return;
    }
    for (const ConvexPolygon& piece : divide_about_corners(part)) parts.push_back(piece);
  }

  const PatchMesh mesh_;
  double thickness_;
  std::vector<Plane> planes_;  // of the patches
  SurfacePieces pieces_;
  std::vector<std::int32_t> patch_of_facet_;
  std::vector<std::int32_t> facet_of_patch_;
  std::vector<std::int32_t> piece_of_patch_;
  std::vector<Cover> covers_;
  std::optional<BoxTree> tree_;  // of the covers
  std::map<std::pair<std::int32_t, std::int32_t>, bool> stands_in_;
  std::map<std::int32_t, WindingNumber> windings_;  // of hollows
};

}  // namespace

Coverage find_coverage(const PatchMesh& mesh, double thickness) {
  return CoverFinder(centered(mesh), thickness).find();
}

}  // namespace radiosity
