#include "meshing/base/polygon_shape.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace meshing {
namespace {

using radiosity::Vec3;

/// Length of the cross product at a corner, relative to the squared extent, down to which the
/// corner counts as straight rather than reflex.
constexpr double kStraight = 1e-10;

/// Deviation of a planar quad whose coordinates were rounded, relative to how far these are off:
/// four corners, each off its place by √3 of that. Its corners are then within a quarter of the
/// deviation of its mean plane.
constexpr double kQuadPrecisions = 7;
/// Likewise of a corner from the mean plane of any polygon.
constexpr double kPolygonPrecisions = 4;

/// Twice the area of the largest triangle of the fan about corner 0. Unlike the vector area it
/// does not cancel in a bow tie.
double largest_fan_triangle(std::span<const Vec3> polygon) {
  double largest = 0;
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    const Vec3 cross = (polygon[k - 1] - polygon[0]).cross(polygon[k] - polygon[0]);
    largest = std::max(largest, cross.norm());
  }
  return largest;
}

PolygonKind quad_kind(std::span<const Vec3> quad, const PolygonShape& shape, double precision) {
  const Vec3 normal = shape.vector_area.normalized();
  const double straight = kStraight * shape.extent * shape.extent;
  int n_reflex = 0;
  for (int k = 0; k < 4; ++k) {
    const Vec3 cross = (quad[k] - quad[(k + 3) % 4]).cross(Vec3(quad[(k + 1) % 4] - quad[k]));
    if (cross.dot(normal) < -straight) ++n_reflex;
  }
  if (n_reflex > 1) return PolygonKind::self_crossing;
  const double diagonal = std::max((quad[2] - quad[0]).norm(), (quad[3] - quad[1]).norm());
  const bool is_planar =
      shape.deviation <= std::max(kPlanarQuad * diagonal, kQuadPrecisions * precision);
  if (n_reflex == 1) {
    return is_planar ? PolygonKind::planar_polygon : PolygonKind::non_planar_polygon;
  }
  return is_planar ? PolygonKind::planar_quad : PolygonKind::non_planar_quad;
}

/// Largest distance of a corner from the plane through the mean corner, normal to `vector_area`.
double polygon_deviation(std::span<const Vec3> polygon, const Vec3& vector_area) {
  const Vec3 normal = vector_area.normalized();
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : polygon) mean += p - polygon[0];
  mean /= static_cast<double>(polygon.size());
  double largest = 0;
  for (const Vec3& p : polygon) {
    largest = std::max(largest, std::abs((p - polygon[0] - mean).dot(normal)));
  }
  return largest;
}

}  // namespace

double quad_deviation(std::span<const Vec3> quad) {
  constexpr double kNoPlane = 1e-3;  // relative to the area of the quad
  const double volume = (quad[1] - quad[0]).cross(quad[2] - quad[0]).dot(quad[3] - quad[0]);
  std::array<double, 4> twice_area{};
  for (int k = 0; k < 4; ++k) {  // of the triangle without corner k
    const Vec3& a = quad[(k + 1) % 4];
    twice_area[k] = (quad[(k + 2) % 4] - a).cross(quad[(k + 3) % 4] - a).norm();
  }
  const double total = *std::max_element(twice_area.begin(), twice_area.end());
  double largest = 0;
  for (const double t : twice_area) {
    if (t > kNoPlane * total) largest = std::max(largest, std::abs(volume) / t);
  }
  return largest;
}

PolygonShape polygon_shape(std::span<const Vec3> polygon, double precision) {
  PolygonShape shape;
  if (polygon.size() < 3) return shape;
  radiosity::Box3 box;
  for (const Vec3& p : polygon) box.extend(p);
  shape.extent = box.diagonal().norm();
  shape.vector_area = radiosity::vector_area(polygon);

  const double zero = kZeroArea * shape.extent * shape.extent;
  if (shape.vector_area.norm() <= zero) {
    const bool parts_cancel = polygon.size() > 3 && largest_fan_triangle(polygon) > 4 * zero;
    shape.kind = parts_cancel ? PolygonKind::self_crossing : PolygonKind::zero_area;
  } else if (polygon.size() == 3) {
    shape.kind = PolygonKind::triangle;
  } else if (polygon.size() == 4) {
    shape.deviation = quad_deviation(polygon);
    shape.kind = quad_kind(polygon, shape, precision);
  } else {
    shape.deviation = polygon_deviation(polygon, shape.vector_area);
    const double planar = std::max(kPlanarQuad * shape.extent, kPolygonPrecisions * precision);
    shape.kind =
        shape.deviation > planar ? PolygonKind::non_planar_polygon : PolygonKind::planar_polygon;
  }
  return shape;
}

}  // namespace meshing
