#include "radiosity/visible_polygon.h"

#include <algorithm>
#include <vector>

#include "radiosity/exchange_area.h"
#include "radiosity/shaft.h"

namespace radiosity {
namespace {

/// Pieces with more corners are divided, since each further cut may add one.
constexpr std::size_t kMostCorners = 8;

/// The set that an occluder hides from a point, as half-spaces normal · x > offset: the planes
/// through the point and the occluder's edges, and the occluder's own plane.
std::vector<HalfSpace> shadow_of(const Occluder& occluder, const Vec3& point, double thickness) {
  const double height = occluder.normal.dot(point) - occluder.offset;
  std::vector<HalfSpace> planes;
  if (std::abs(height) <= thickness) return planes;  // seen edge-on it hides nothing
  const double side = height > 0 ? 1 : -1;
  planes.push_back({-side * occluder.normal, -side * occluder.offset});
  const std::size_t n = occluder.corners.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Vec3 a = occluder.corners[k] - point;
    const Vec3 b = occluder.corners[k + 1 < n ? k + 1 : 0] - point;
    const Vec3 inwards = -side * a.cross(b);
    const double length = inwards.norm();
    if (length > 0) planes.push_back({inwards / length, inwards.dot(point) / length});
  }
  return planes;
}

bool is_beyond(const ConvexPolygon& piece, const HalfSpace& plane) {
  return std::all_of(piece.begin(), piece.end(),
                     [&](const Vec3& corner) { return plane.normal.dot(corner) <= plane.offset; });
}

void add_piece(const ConvexPolygon& piece, std::vector<ConvexPolygon>& pieces) {
  if (piece.size() < 3) return;
  if (piece.size() <= kMostCorners) {
    pieces.push_back(piece);
    return;
  }
  const std::size_t half = piece.size() / 2;
  ConvexPolygon first;
  ConvexPolygon second;
  for (std::size_t k = 0; k <= half; ++k) first.push_back(piece[k]);
  for (std::size_t k = half; k < piece.size(); ++k) second.push_back(piece[k]);
  second.push_back(piece[0]);
  pieces.push_back(first);
  pieces.push_back(second);
}

/// Appends the parts of `piece` outside the shadow to `pieces`.
void cut(const ConvexPolygon& piece, const std::vector<HalfSpace>& shadow,
         std::vector<ConvexPolygon>& pieces) {
  const bool is_untouched =
      shadow.empty() || std::any_of(shadow.begin(), shadow.end(), [&](const HalfSpace& plane) {
        return is_beyond(piece, plane);
      });
  if (is_untouched) {
    add_piece(piece, pieces);
    return;
  }
  ConvexPolygon rest = piece;
  for (const HalfSpace& plane : shadow) {
    const Vec3 on_plane = plane.offset * plane.normal;
    add_piece(clip_to_half_space(rest.points(), on_plane, -plane.normal, 0), pieces);
    rest = clip_to_half_space(rest.points(), on_plane, plane.normal, 0);
    if (rest.empty()) return;
  }
}

}  // namespace

double visible_point_to_polygon(const Vec3& point, const Vec3& normal, const ConvexPolygon& target,
                                std::span<const Occluder* const> occluders, double thickness) {
  std::vector<ConvexPolygon> pieces{target};
  std::vector<ConvexPolygon> next;
  for (const Occluder* occluder : occluders) {
    const std::vector<HalfSpace> shadow = shadow_of(*occluder, point, thickness);
    next.clear();
    for (const ConvexPolygon& piece : pieces) cut(piece, shadow, next);
    pieces.swap(next);
    if (pieces.empty()) return 0;
  }
  double sum = 0;
  for (const ConvexPolygon& piece : pieces) sum += point_to_polygon(point, normal, piece.points());
  return sum;
}

}  // namespace radiosity
