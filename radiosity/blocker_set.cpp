#include "radiosity/blocker_set.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "radiosity/body_finder.h"
#include "radiosity/convex_polygon.h"
#include "radiosity/occluders.h"
#include "radiosity/polytope.h"
#include "radiosity/surface_pieces.h"

namespace radiosity {
namespace {

/// Pieces of so many polygons are given bodies around and within.
constexpr std::size_t kManyPolygons = 24;
/// Polygons of more sides are given simpler ones around and within.
constexpr std::size_t kManySides = 16;

Blocker polygon_blocker(const Occluder& occluder) {
  Blocker result;
  result.faces = {{occluder.normal, occluder.offset}, {-occluder.normal, -occluder.offset}};
  for (std::size_t k = 0; k < occluder.corners.size(); ++k) {
    const std::size_t next = k + 1 < occluder.corners.size() ? k + 1 : 0;
    result.edges.push_back({occluder.corners[k], occluder.corners[next], 0, 1});
  }
  result.corners = occluder.corners;
  result.box = occluder.box;
  set_sphere(result);
  if (result.corners.size() <= kManySides) return result;
  const std::optional<Blocker> outer = enclosing_polygon(result.corners, result.faces[0]);
  if (!outer) return result;
  // The least size at which all corners of the shrunk polygon are within.
  double factor = 1;
  for (const Blocker::Edge& edge : result.edges) {
    const Vec3 outwards = (edge.end - edge.start).cross(occluder.normal).normalized();
    const double reach = outwards.dot(edge.start - result.center);
    for (const Vec3& corner : outer->corners) {
      const double height = outwards.dot(corner - result.center);
      if (height > reach) factor = std::min(factor, reach / height);
    }
  }
  if (factor > 0) result.inner.push_back(shrunk(*outer, result.center, factor));
  result.outer.push_back(*outer);
  return result;
}

class Builder {
 public:
  Builder(const PatchMesh& mesh, double thickness) : mesh_(mesh), thickness_(thickness) {}

  BlockerSet build() {
    const BlockingPatches blocking = find_blocking_patches(mesh_, thickness_);
    std::vector<std::int32_t> one_sided;
    std::vector<std::int32_t> loose;
    for (const std::int32_t i : blocking.patches) {
      (mesh_.twin[i] < 0 ? one_sided : loose).push_back(i);
    }
    const SurfacePieces pieces = find_surface_pieces(mesh_, one_sided, thickness_);
    std::vector<std::int32_t> items;
    for (const SurfacePiece& piece : pieces.pieces) {
      if (const auto body = find_body(pieces, piece, mesh_, thickness_)) {
        items.push_back(add_leaf(body->blocker));
        continue;
      }
      std::vector<std::int32_t> patches;
      for (const std::int32_t f : piece.facets) patches.push_back(one_sided[f]);
      if (piece.facets.size() < kManyPolygons) {
        loose.insert(loose.end(), patches.begin(), patches.end());
        continue;
      }
      add_piece(pieces, piece, make_occluders(mesh_, patches, thickness_), loose, patches, items);
    }
    std::sort(loose.begin(), loose.end());
    std::vector<Occluder> occluders = make_occluders(mesh_, loose, thickness_);
    drop_covered_occluders(occluders, thickness_);
    for (const Occluder& occluder : occluders) items.push_back(add_leaf(polygon_blocker(occluder)));
    if (!items.empty()) result_.root = join({items.data(), items.size()});
    return std::move(result_);
  }

 private:
  std::int32_t add_leaf(Blocker blocker) {
    result_.nodes.push_back({blocker.box, static_cast<std::int32_t>(result_.blockers.size())});
    result_.blockers.push_back(std::move(blocker));
    return static_cast<std::int32_t>(result_.nodes.size()) - 1;
  }

  /// A piece of many polygons gets a node of its own; others become loose.
  void add_piece(const SurfacePieces& pieces, const SurfacePiece& piece,
                 const std::vector<Occluder>& occluders, std::vector<std::int32_t>& loose,
                 const std::vector<std::int32_t>& patches, std::vector<std::int32_t>& items) {
    // A hollow (the walls of a room) has everything inside.
    const bool is_hollow = piece.open_edges.empty() && piece.volume < 0;
    if (occluders.size() < kManyPolygons || is_hollow) {
      loose.insert(loose.end(), patches.begin(), patches.end());
      return;
    }
    std::vector<std::int32_t> leaves;
    std::vector<Vec3> corners;
    for (const Occluder& occluder : occluders) {
      leaves.push_back(add_leaf(polygon_blocker(occluder)));
      corners.insert(corners.end(), occluder.corners.begin(), occluder.corners.end());
    }
    const std::int32_t node = join({leaves.data(), leaves.size()});
    if (std::optional<Blocker> outer = enclosing_polytope(corners)) {
      if (piece.is_solid()) {
        if (auto inner = find_inner_body(pieces, piece, *outer)) {
          result_.nodes[node].inner.push_back(std::move(*inner));
        }
      }
      result_.nodes[node].outer.push_back(std::move(*outer));
    }
    items.push_back(node);
  }

  /// A binary tree over nodes, halved along the longest side of the box of their centres.
  std::int32_t join(std::span<std::int32_t> nodes) {
    if (nodes.size() == 1) return nodes[0];
    Box3 box;
    Box3 centers;
    for (const std::int32_t k : nodes) {
      box.extend(result_.nodes[k].box);
      centers.extend(result_.nodes[k].box.center());
    }
    int axis = 0;
    centers.sizes().maxCoeff(&axis);
    std::sort(nodes.begin(), nodes.end(), [&](std::int32_t a, std::int32_t b) {
      const double x = result_.nodes[a].box.center()[axis];
      const double y = result_.nodes[b].box.center()[axis];
      return x != y ? x < y : a < b;
    });
    const std::size_t half = nodes.size() / 2;
    const std::int32_t left = join(nodes.first(half));
    const std::int32_t right = join(nodes.subspan(half));
    result_.nodes.push_back({box, -1, left, right});
    return static_cast<std::int32_t>(result_.nodes.size()) - 1;
  }

  const PatchMesh& mesh_;
  double thickness_;
  BlockerSet result_;
};

/// A face of a solid that may cover patches.
struct Cover {
  std::vector<Vec3> outline;  // convex, counter-clockwise about `normal`
  Vec3 normal;                // out of the solid
  Box3 box;
};

class CoverFinder {
 public:
  CoverFinder(PatchMesh mesh, double thickness) : mesh_(std::move(mesh)), thickness_(thickness) {}

  Eigen::VectorXd find() {
    std::vector<std::int32_t> one_sided;
    for (std::int32_t i = 0; i < mesh_.size(); ++i) {
      if (mesh_.twin[i] < 0) one_sided.push_back(i);
    }
    add_solids(one_sided);
    add_caps();
    Eigen::VectorXd shares = Eigen::VectorXd::Zero(mesh_.size());
    if (covers_.empty()) return shares;
    std::sort(covers_.begin(), covers_.end(), [](const Cover& a, const Cover& b) {
      return a.box.min().x() < b.box.min().x();
    });
    double widest = 0;
    for (const Cover& cover : covers_) widest = std::max(widest, cover.box.sizes().x());
    for (Index i = 0; i < mesh_.size(); ++i) shares[i] = share_of(i, widest);
    return shares;
  }

 private:
  void add_cover(std::span<const Vec3> outline, const Vec3& normal) {
    Cover& cover = covers_.emplace_back(
        Cover{std::vector<Vec3>(outline.begin(), outline.end()), normal, Box3()});
    for (const Vec3& corner : outline) cover.box.extend(corner);
  }

  void add_solids(const std::vector<std::int32_t>& one_sided) {
    const SurfacePieces pieces = find_surface_pieces(mesh_, one_sided, thickness_);
    for (const SurfacePiece& piece : pieces.pieces) {
      if (!piece.is_solid()) continue;
      for (const std::int32_t f : piece.facets) add_cover(pieces.outline(f), pieces.normal[f]);
    }
  }

  /// What stands on an outer plane covers the floor also where it has no face there.
  void add_caps() {
    const BlockingPatches blocking = find_blocking_patches(mesh_, thickness_);
    std::vector<std::int32_t> one_sided;
    for (const std::int32_t i : blocking.patches) {
      if (mesh_.twin[i] < 0) one_sided.push_back(i);
    }
    const SurfacePieces pieces = find_surface_pieces(mesh_, one_sided, thickness_);
    for (const SurfacePiece& piece : pieces.pieces) {
      if (piece.open_edges.empty()) continue;
      const auto body = find_body(pieces, piece, mesh_, thickness_);
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
      add_cover(triangle, plane.normal);
    }
  }

  [[nodiscard]] double share_of(Index i, double widest) const {
    ConvexPolygon patch;
    Box3 box;
    for (int k = 0; k < mesh_.n_corners(i); ++k) {
      patch.push_back(mesh_.corner(i, k));
      box.extend(patch[k]);
    }
    box.min().array() -= thickness_;
    box.max().array() += thickness_;
    // Covers may overlap each other, so each is taken away from what the others left.
    std::vector<ConvexPolygon> open{patch};
    const double first = box.min().x() - widest;
    auto cover = std::lower_bound(covers_.begin(), covers_.end(), first,
                                  [](const Cover& c, double x) { return c.box.min().x() < x; });
    for (; cover != covers_.end() && cover->box.min().x() <= box.max().x(); ++cover) {
      if (cover->normal.dot(mesh_.normal[i]) > -0.9 || !cover->box.intersects(box)) continue;
      if (!is_in_plane(i, *cover)) continue;
      std::vector<ConvexPolygon> left;
      for (const ConvexPolygon& part : open) subtract(part, *cover, left);
      open = std::move(left);
    }
    if (open.size() == 1 && open[0].size() == patch.size()) return 0;
    double area = 0;
    for (const ConvexPolygon& part : open) area += vector_area(part.points()).norm();
    return std::clamp(1 - area / mesh_.area[i], 0.0, 1.0);
  }

  [[nodiscard]] bool is_in_plane(Index i, const Cover& cover) const {
    const double offset = cover.normal.dot(cover.outline[0]);
    for (int k = 0; k < mesh_.n_corners(i); ++k) {
      if (std::abs(cover.normal.dot(mesh_.corner(i, k)) - offset) > thickness_) return false;
    }
    return true;
  }

  /// Appends the parts of a polygon outside a cover.
  void subtract(const ConvexPolygon& polygon, const Cover& cover,
                std::vector<ConvexPolygon>& parts) const {
    ConvexPolygon rest = polygon;
    const std::size_t first = parts.size();
    for (std::size_t k = 0; k < cover.outline.size(); ++k) {
      const Vec3& a = cover.outline[k];
      const Vec3& b = cover.outline[k + 1 < cover.outline.size() ? k + 1 : 0];
      const Vec3 inwards = cover.normal.cross(b - a).normalized();
      const ConvexPolygon outside = clip_to_half_space(rest.points(), a, -inwards, thickness_);
      rest = clip_to_half_space(rest.points(), a, inwards, thickness_);
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
  std::vector<Cover> covers_;
};

}  // namespace

BlockerSet make_blockers(const PatchMesh& mesh, double thickness) {
  return Builder(mesh, thickness).build();
}

Eigen::VectorXd covered_shares(const PatchMesh& mesh, double thickness) {
  return CoverFinder(centered(mesh), thickness).find();
}

}  // namespace radiosity
