#pragma once

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "radiosity/base/geometry.h"

namespace radiosity {

/// Relative error of the form factors to patches so far away that FinalGather interpolates them.
inline constexpr double kInterpolationTolerance = 1e-4;

/// A rectangle in a plane: center ± half_u ± half_v, m.
struct Rectangle {
  Vec3 center;
  Vec3 half_u;
  Vec3 half_v;
  /// Half of the diagonal, m.
  [[nodiscard]] double radius() const {
    return std::sqrt(half_u.squaredNorm() + half_v.squaredNorm());
  }
};

/// The smallest rectangle around a convex polygon that has a side along one of its edges. (Freeman
/// & Shapira 1975)
Rectangle bounding_rectangle(std::span<const Vec3> polygon, const Vec3& normal);

/// Interpolates form factors from points in a rectangle by polynomials on Chebyshev nodes.
class RectangleInterpolation {
 public:
  static constexpr int kLargestOrder = 6;
  static constexpr int kMostNodes = kLargestOrder * kLargestOrder;

  /// `order` nodes a direction, 2 to kLargestOrder.
  RectangleInterpolation(const Rectangle& rectangle, int order);

  [[nodiscard]] int n_nodes() const { return order_ * order_; }
  [[nodiscard]] Vec3 node(int k) const;

  /// The weights of the nodes' values at a point of the rectangle, the first n_nodes().
  [[nodiscard]] std::array<double, kMostNodes> weights(const Vec3& point) const;

  /// Nodes a direction with which the form factor to a polygon is interpolated with a relative
  /// error of at most `tolerance`, if its nearest point is `distance_ratio` times the rectangle's
  /// radius away from its centre; 0 if kLargestOrder is too few. The kernel varies no faster than
  /// r⁻⁴, for whose expansion about the centre the remainder of Chebyshev interpolation holds,
  /// twice for each direction.
  [[nodiscard]] static int least_order(double distance_ratio, double tolerance);

 private:
  Rectangle rectangle_;
  int order_;
};

}  // namespace radiosity
