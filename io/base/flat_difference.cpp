#include "io/base/flat_difference.h"

namespace io {
namespace {

using radiosity::ConvexPolygon;
using radiosity::Vec3;

/// Appends what of `polygon` lies outside the hole, in pieces.
void cut_out(const ConvexPolygon& polygon, const ConvexPolygon& hole, const Vec3& normal,
             double thickness, std::vector<ConvexPolygon>& pieces) {
  const std::size_t n_before = pieces.size();
  ConvexPolygon rest = polygon;
  for (std::size_t k = 0; k < hole.size() && !rest.empty(); ++k) {
    const Vec3 outwards = (hole[(k + 1) % hole.size()] - hole[k]).cross(normal).normalized();
    ConvexPolygon beyond;
    ConvexPolygon within;
    split(rest, hole[k], outwards, thickness, beyond, within);
    if (!beyond.empty()) pieces.push_back(beyond);
    rest = within;
  }
  if (!rest.empty()) return;
  // The hole lies beside the polygon, which stays whole.
  pieces.resize(n_before);
  pieces.push_back(polygon);
}

/// Appends the polygon or, where it has too many corners to be cut by the lines of a hole, its
/// halves.
void add_with_room(const ConvexPolygon& polygon, std::vector<ConvexPolygon>& result) {
  constexpr std::size_t kMostCorners = 6;
  if (polygon.size() <= kMostCorners) {
    result.push_back(polygon);
    return;
  }
  const auto points = polygon.points();
  const std::size_t middle = polygon.size() / 2;
  ConvexPolygon second(points.subspan(middle));
  second.push_back(points[0]);
  add_with_room(ConvexPolygon(points.first(middle + 1)), result);
  add_with_room(second, result);
}

}  // namespace

std::vector<ConvexPolygon> flat_difference(const ConvexPolygon& polygon,
                                           std::span<const ConvexPolygon> holes, const Vec3& normal,
                                           double thickness) {
  std::vector<ConvexPolygon> pieces{polygon};
  for (const ConvexPolygon& hole : holes) {
    std::vector<ConvexPolygon> cut;
    for (const ConvexPolygon& piece : pieces) {
      std::vector<ConvexPolygon> small;
      add_with_room(piece, small);
      for (const ConvexPolygon& part : small) cut_out(part, hole, normal, thickness, cut);
    }
    pieces = std::move(cut);
  }
  return pieces;
}

}  // namespace io
