#include <algorithm>
#include <cmath>

#include "meshing/base/text.h"
#include "meshing/base/triangulate.h"
#include "meshing/inspect/findings.h"
#include "radiosity/base/box_tree.h"

namespace meshing {
namespace {

using radiosity::Box3;
using radiosity::BoxTree;
using radiosity::Index;
using radiosity::Vec3;

/// Sine of the angle up to which they are parallel.
constexpr double kParallel = 1e-3;
/// Overlap, relative to the smaller area, from which it is more than rounding.
constexpr double kOverlap = 1e-5;

using ConvexPolygon = std::vector<Vec2>;

double area(const ConvexPolygon& polygon) {
  double twice = 0;
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    twice += signed_area2(polygon[0], polygon[k - 1], polygon[k]);
  }
  return twice / 2;
}

/// The part of `polygon` to the left of the line from a to b (Sutherland & Hodgman 1974).
ConvexPolygon clip(const ConvexPolygon& polygon, const Vec2& a, const Vec2& b) {
  ConvexPolygon kept;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec2& p = polygon[k];
    const Vec2& q = polygon[(k + 1) % polygon.size()];
    const double left_p = signed_area2(a, b, p);
    const double left_q = signed_area2(a, b, q);
    if (left_p >= 0) kept.push_back(p);
    if ((left_p > 0 && left_q < 0) || (left_p < 0 && left_q > 0)) {
      kept.emplace_back(p + left_p / (left_p - left_q) * (q - p));
    }
  }
  return kept;
}

double overlap_area(ConvexPolygon polygon, const ConvexPolygon& other) {
  for (std::size_t k = 0; k < other.size() && !polygon.empty(); ++k) {
    polygon = clip(polygon, other[k], other[(k + 1) % other.size()]);
  }
  return area(polygon);
}

class OverlapFinder {
 public:
  explicit OverlapFinder(const ExaminedScene& examined)
      : examined_(examined), pieces_(examined.polygons.size()), findings_(examined.scene) {}

  std::vector<Finding> run();

 private:
  void cut_into_convex_pieces(Index i);
  [[nodiscard]] std::vector<ConvexPolygon> pieces_in(const PlaneFrame& frame, Index i) const;
  [[nodiscard]] bool are_coplanar(Index a, Index b) const;
  [[nodiscard]] bool have_same_outline(Index a, Index b) const;
  [[nodiscard]] double relative_overlap(Index a, Index b) const;
  [[nodiscard]] double least_overlap(Index a, Index b) const;
  void report(Index a, Index b, double overlap);

  const ExaminedScene& examined_;
  std::vector<std::vector<Triangle>> pieces_;  // of polygons that are not convex as they are
  FindingList findings_;
};

std::vector<Finding> OverlapFinder::run() {
  std::vector<Box3> boxes;
  const Vec3 margin = Vec3::Constant(examined_.thickness);
  for (Index i = 0; i < examined_.polygons.size(); ++i) {
    Box3 box;
    if (examined_.is_usable(i)) {
      for (const std::int32_t v : examined_.polygons.polygon(i)) {
        box.extend(examined_.polygons.vertices[v]);
      }
      cut_into_convex_pieces(i);
    } else {
      box.extend(Vec3(examined_.bounds.max() + Vec3::Constant(examined_.size)));  // meets nothing
    }
    boxes.push_back(box);
  }
  const BoxTree tree(boxes);
  std::vector<std::int32_t> others;
  for (Index i = 0; i < examined_.polygons.size(); ++i) {
    if (!examined_.is_usable(i)) continue;
    others.clear();
    tree.for_each_meeting(Box3(boxes[i].min() - margin, boxes[i].max() + margin),
                          [&](std::int32_t j) {
                            if (j < i && examined_.is_usable(j)) others.push_back(j);
                          });
    std::sort(others.begin(), others.end());
    for (const std::int32_t j : others) {
      if (!are_coplanar(i, j) || have_same_outline(i, j)) continue;
      const double overlap = relative_overlap(i, j);
      if (overlap > least_overlap(i, j)) report(i, j, overlap);
    }
  }
  return findings_.take();
}

void OverlapFinder::cut_into_convex_pieces(Index i) {
  const PolygonKind kind = examined_.shapes[i].kind;
  if (kind == PolygonKind::triangle || kind == PolygonKind::planar_quad) return;
  const std::vector<Vec3> points = examined_.points(i);
  const PlaneFrame frame(points);
  std::vector<Vec2> flat;
  for (const Vec3& p : points) flat.push_back(frame.to_plane(p));
  if (auto triangles = clip_ears(flat)) pieces_[i] = std::move(*triangles);
}

/// Counter-clockwise in the frame, whichever way the polygon faces.
std::vector<ConvexPolygon> OverlapFinder::pieces_in(const PlaneFrame& frame, Index i) const {
  ConvexPolygon all;
  for (const std::int32_t v : examined_.polygons.polygon(i)) {
    all.push_back(frame.to_plane(examined_.polygons.vertices[v]));
  }
  std::vector<ConvexPolygon> result;
  for (const Triangle& t : pieces_[i]) result.push_back({all[t[0]], all[t[1]], all[t[2]]});
  if (result.empty()) result.push_back(std::move(all));
  for (ConvexPolygon& piece : result) {
    if (area(piece) < 0) std::reverse(piece.begin(), piece.end());
  }
  return result;
}

bool OverlapFinder::are_coplanar(Index a, Index b) const {
  const Vec3 normal = examined_.normal(a);
  if (normal.cross(examined_.normal(b)).norm() > kParallel) return false;
  const Vec3& origin = examined_.polygons.vertices[examined_.polygons.polygon(a)[0]];
  const std::span<const std::int32_t> corners = examined_.polygons.polygon(b);
  return std::all_of(corners.begin(), corners.end(), [&](std::int32_t v) {
    return std::abs((examined_.polygons.vertices[v] - origin).dot(normal)) <= examined_.thickness;
  });
}

/// Those are reported as duplicates.
bool OverlapFinder::have_same_outline(Index a, Index b) const {
  const std::span<const std::int32_t> corners_a = examined_.polygons.polygon(a);
  const std::span<const std::int32_t> corners_b = examined_.polygons.polygon(b);
  return corners_a.size() == corners_b.size() &&
         std::is_permutation(corners_a.begin(), corners_a.end(), corners_b.begin());
}

/// Common area relative to the smaller polygon's.
double OverlapFinder::relative_overlap(Index a, Index b) const {
  const PlaneFrame frame(examined_.points(a));
  const std::vector<ConvexPolygon> pieces_a = pieces_in(frame, a);
  const std::vector<ConvexPolygon> pieces_b = pieces_in(frame, b);
  double common = 0;
  for (const ConvexPolygon& piece_a : pieces_a) {
    for (const ConvexPolygon& piece_b : pieces_b) common += overlap_area(piece_a, piece_b);
  }
  const double smaller =
      std::min(examined_.shapes[a].vector_area.norm(), examined_.shapes[b].vector_area.norm());
  return common * frame.unit() * frame.unit() / smaller;
}

/// What the smaller polygon may overlap the other along its edges for the sake of rounding,
/// relative to its area.
double OverlapFinder::least_overlap(Index a, Index b) const {
  const PolygonShape& shape_a = examined_.shapes[a];
  const PolygonShape& shape_b = examined_.shapes[b];
  const PolygonShape& smaller =
      shape_a.vector_area.norm() < shape_b.vector_area.norm() ? shape_a : shape_b;
  constexpr double kSides = 2;  // of the length of its extent at most, in a convex polygon
  return std::max(kOverlap,
                  kSides * smaller.extent * examined_.thickness / smaller.vector_area.norm());
}

void OverlapFinder::report(Index a, Index b, double overlap) {
  const bool same_side = examined_.normal(a).dot(examined_.normal(b)) > 0 ||
                         examined_.is_two_sided(a) || examined_.is_two_sided(b);
  const bool emits = examined_.emits(a) || examined_.emits(b);
  // The message belongs to the light if there is one: that is the one to move.
  if (!examined_.emits(a) && examined_.emits(b)) std::swap(a, b);
  const std::string what = "it lies in the plane of " + polygon_name(examined_.scene, b) +
                           " and overlaps it (" + number(100 * std::min(overlap, 1.0)) +
                           " % of the smaller one)";
  if (!same_side) {
    findings_.add(Finding::Kind::coplanar_overlap,
                  emits ? Finding::Severity::warning : Finding::Severity::note, a,
                  what + ", facing the other way" +
                      (emits ? "; it shines into it where they touch" : "; they hide each other"));
    return;
  }
  findings_.add(Finding::Kind::coplanar_overlap, Finding::Severity::serious, a,
                what + ", facing the same way; cut a hole there or move one of them");
}

}  // namespace

std::vector<Finding> find_coplanar_overlaps(const ExaminedScene& examined) {
  return OverlapFinder(examined).run();
}

}  // namespace meshing
