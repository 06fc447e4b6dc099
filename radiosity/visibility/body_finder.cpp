#include "radiosity/visibility/body_finder.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "radiosity/base/disjoint_sets.h"
#include "radiosity/scene/winding.h"
#include "radiosity/visibility/polytope.h"

namespace radiosity {
namespace {

/// Bodies with more faces are given simpler ones around and within.
constexpr std::size_t kManyFaces = 16;
/// Inner bodies smaller than this share of the outer one hide too little.
constexpr double kLeastInner = 0.25;

class BodyFinder {
 public:
  BodyFinder(const SurfacePieces& pieces, const SurfacePiece& piece, const VertexBlocks& vertices,
             double thickness)
      : pieces_(pieces), piece_(piece), vertices_(vertices), thickness_(thickness) {}

  std::optional<FoundBody> find() {
    // Closed, but flat: sheets back to back, which may have holes.
    if (piece_.open_edges.empty() && piece_.volume == 0) return std::nullopt;
    if (piece_.facets.size() < 3 || !find_faces()) return std::nullopt;
    if (!piece_.open_edges.empty() && !add_cap()) return std::nullopt;
    if (body_.faces.size() < 4 || body_.faces.size() > Blocker::kMostFaces) return std::nullopt;
    if (!is_convex()) return std::nullopt;
    add_edges();
    for (const Blocker::Edge& edge : body_.edges) {
      body_.corners.push_back(edge.start);
      body_.corners.push_back(edge.end);
    }
    std::sort(body_.corners.begin(), body_.corners.end(), [](const Vec3& a, const Vec3& b) {
      return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
    });
    body_.corners.erase(std::unique(body_.corners.begin(), body_.corners.end()),
                        body_.corners.end());
    for (const Vec3& corner : body_.corners) body_.box.extend(corner);
    set_sphere(body_);
    FoundBody result{std::move(body_), {}};
    if (!piece_.open_edges.empty()) {
      for (const std::int32_t h : piece_.open_edges) result.cap.push_back(pieces_.corners[h]);
    }
    return result;
  }

 private:
  [[nodiscard]] bool is_in(const HalfSpace& plane, std::span<const Vec3> points) const {
    return std::all_of(points.begin(), points.end(), [&](const Vec3& point) {
      return std::abs(plane.normal.dot(point) - plane.offset) <= thickness_;
    });
  }

  [[nodiscard]] HalfSpace plane_of(std::int32_t facet) const {
    const Vec3& normal = pieces_.normal[facet];
    const std::span<const Vec3> outline = pieces_.outline(facet);
    double offset = 0;
    for (const Vec3& corner : outline) offset += normal.dot(corner);
    return {normal, offset / static_cast<double>(outline.size())};
  }

  [[nodiscard]] bool are_coplanar(std::int32_t f, std::int32_t g) const {
    return pieces_.normal[f].dot(pieces_.normal[g]) > 0.5 &&
           is_in(plane_of(f), pieces_.outline(g)) && is_in(plane_of(g), pieces_.outline(f));
  }

  /// Facets that are coplanar across an edge make one face of the body. False if they are too many
  /// or not in one plane after all.
  bool find_faces() {
    std::map<std::int32_t, Index> place;
    for (std::size_t k = 0; k < piece_.facets.size(); ++k) {
      place[piece_.facets[k]] = static_cast<Index>(k);
    }
    DisjointSets sets(static_cast<Index>(piece_.facets.size()));
    for (const std::int32_t f : piece_.facets) {
      for (std::int32_t h = pieces_.first_corner[f]; h < pieces_.first_corner[f + 1]; ++h) {
        if (pieces_.neighbor[h] < 0) continue;
        const std::int32_t g = pieces_.facet[pieces_.neighbor[h]];
        if (sets.find(place[f]) != sets.find(place[g]) && are_coplanar(f, g)) {
          sets.join(place[f], place[g]);
        }
      }
    }
    for (const std::vector<Index>& set : sets.sets()) {
      if (body_.faces.size() >= Blocker::kMostFaces) return false;
      Vec3 sum = Vec3::Zero();
      for (const Index k : set) sum += vector_area(pieces_.outline(piece_.facets[k]));
      const Vec3 normal = sum.normalized();
      double low = 1e300;
      double high = -1e300;
      for (const Index k : set) {
        face_of_[piece_.facets[k]] = static_cast<int>(body_.faces.size());
        for (const Vec3& corner : pieces_.outline(piece_.facets[k])) {
          low = std::min(low, normal.dot(corner));
          high = std::max(high, normal.dot(corner));
        }
      }
      if (high - low > 2 * thickness_) return false;
      body_.faces.push_back({normal, 0.5 * (low + high)});
      area_ -= sum;
    }
    return true;
  }

  bool add_cap() {
    const Vec3 normal = area_.normalized();
    std::vector<Vec3> rim;
    double offset = -1e300;
    for (const std::int32_t h : piece_.open_edges) {
      rim.push_back(pieces_.corners[h]);
      offset = std::max(offset, normal.dot(rim.back()));
    }
    const HalfSpace plane{normal, offset};
    if (normal.squaredNorm() == 0 || !is_in(plane, rim)) return false;
    if (!vertices_.are_all_behind(normal, offset + thickness_)) return false;
    // A face that the cap goes on in would end at an edge that is none.
    const bool goes_on = std::any_of(
        body_.faces.begin(), body_.faces.end(),
        [&](const HalfSpace& face) { return face.normal.dot(normal) > 0.5 && is_in(face, rim); });
    if (goes_on) return false;
    cap_ = static_cast<int>(body_.faces.size());
    body_.faces.push_back(plane);
    return true;
  }

  /// A closed surface on the border of a convex body is all of it.
  [[nodiscard]] bool is_convex() const {
    for (const HalfSpace& face : body_.faces) {
      for (const std::int32_t f : piece_.facets) {
        for (const Vec3& corner : pieces_.outline(f)) {
          if (face.normal.dot(corner) > face.offset + thickness_) return false;
        }
      }
    }
    return true;
  }

  /// Where two faces meet there is one edge, of however many parts.
  void add_edges() {
    std::map<std::pair<int, int>, std::size_t> edge_of;
    for (const std::int32_t f : piece_.facets) {
      const int left = face_of_.at(f);
      for (std::int32_t h = pieces_.first_corner[f]; h < pieces_.first_corner[f + 1]; ++h) {
        const std::int32_t opposite = pieces_.neighbor[h];
        const int right = opposite < 0 ? cap_ : face_of_.at(pieces_.facet[opposite]);
        if (left == right || (opposite >= 0 && left > right)) continue;
        const Vec3& start = pieces_.corners[h];
        const Vec3& end = pieces_.corners[pieces_.next(h)];
        const auto [place, is_new] = edge_of.try_emplace({left, right}, body_.edges.size());
        if (is_new) {
          body_.edges.push_back({start, end, left, right});
          continue;
        }
        Blocker::Edge& edge = body_.edges[place->second];
        const Vec3 way = end - start;
        if (way.dot(start - edge.start) < 0) edge.start = start;
        if (way.dot(end - edge.end) > 0) edge.end = end;
      }
    }
  }

  const SurfacePieces& pieces_;
  const SurfacePiece& piece_;
  const VertexBlocks& vertices_;
  double thickness_;
  Blocker body_;
  std::map<std::int32_t, int> face_of_;  // per facet
  Vec3 area_ = Vec3::Zero();             // of what is missing
  int cap_ = -1;
};

}  // namespace

std::optional<FoundBody> find_body(const SurfacePieces& pieces, const SurfacePiece& piece,
                                   const VertexBlocks& vertices, double thickness) {
  std::optional<FoundBody> found = BodyFinder(pieces, piece, vertices, thickness).find();
  if (!found || found->blocker.faces.size() <= kManyFaces) return found;
  Blocker& body = found->blocker;
  if (std::optional<Blocker> outer = enclosing_polytope(body.corners)) {
    if (piece.is_solid()) {
      if (auto inner = find_inner_body(pieces, piece, *outer)) body.inner.push_back(*inner);
    }
    body.outer.push_back(std::move(*outer));
  }
  return found;
}

std::optional<Blocker> find_inner_body(const SurfacePieces& pieces, const SurfacePiece& piece,
                                       const Blocker& outer) {
  Vec3 center = Vec3::Zero();
  double volume = 0;
  for (const std::int32_t f : piece.facets) {
    const std::span<const Vec3> outline = pieces.outline(f);
    for (std::size_t k = 2; k < outline.size(); ++k) {
      const Vec3 a = outline[0] - outer.center;
      const Vec3 b = outline[k - 1] - outer.center;
      const Vec3 c = outline[k] - outer.center;
      const double part = a.dot(b.cross(c)) / 6;
      volume += part;
      center += part / 4 * (a + b + c);
    }
  }
  if (!(volume > 0)) return std::nullopt;
  center = outer.center + center / volume;
  if (winding_number(pieces, piece, center) != 1) return std::nullopt;
  // The least size at which some face of the shrunk body leaves a facet outside, for every facet.
  double factor = 1;
  for (const std::int32_t f : piece.facets) {
    double best = 0;
    for (const HalfSpace& face : outer.faces) {
      const double reach = face.offset - face.normal.dot(center);
      double least = 1e300;
      for (const Vec3& corner : pieces.outline(f)) {
        least = std::min(least, face.normal.dot(corner - center));
      }
      best = std::max(best, least / reach);
    }
    factor = std::min(factor, best);
    if (factor < kLeastInner) return std::nullopt;
  }
  return shrunk(outer, center, factor);
}

}  // namespace radiosity
