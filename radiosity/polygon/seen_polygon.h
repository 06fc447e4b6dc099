#pragma once

#include <array>

#include "radiosity/base/geometry.h"
#include "radiosity/polygon/convex_polygon.h"

namespace radiosity {

/// A convex polygon as a point sees it, to draw directions of equal density in solid angle from.
class SeenPolygon {
 public:
  SeenPolygon(const Vec3& point, const ConvexPolygon& polygon);

  [[nodiscard]] double solid_angle() const { return solid_angle_; }  ///< sr
  /// Maps the unit square to unit vectors towards the polygon, evenly in solid angle. (Arvo 1995,
  /// for each triangle of a fan)
  [[nodiscard]] Vec3 direction(double u, double v) const;

 private:
  /// A spherical triangle: its corners are the first one of the polygon and two that follow.
  struct Triangle {
    Vec3 b;
    Vec3 towards_c;    // from a, orthogonal to it
    double cosine_ab;  // of the arc
    double cosine;     // of the angle at a
    double sine;
    double before;  // solid angle of the triangles before, sr
    double solid_angle;
  };
  static constexpr std::size_t kMost = ConvexPolygon::kCapacity - 2;
  Vec3 a_;
  std::array<Triangle, kMost> triangles_;
  std::size_t n_triangles_ = 0;
  double solid_angle_ = 0;
};

}  // namespace radiosity
