#include "radiosity/picture/patch_interpolation.h"

#include <algorithm>
#include <cmath>

#include "radiosity/polygon/convex_hull.h"

namespace radiosity {
namespace {

/// The smallest root in [0, 1] of a t² + b t + c = 0, allowing for rounding at the ends.
double root_in_unit_interval(double a, double b, double c) {
  const double discriminant = std::sqrt(std::max(0.0, b * b - 4 * a * c));
  const double q = -0.5 * (b + std::copysign(discriminant, b));
  const double first = q != 0 ? c / q : 0;
  const double second = a != 0 ? q / a : first;
  const auto distance = [](double t) { return std::abs(t - 0.5); };
  return std::clamp(distance(first) <= distance(second) ? first : second, 0.0, 1.0);
}

/// Coordinates (s, t) in [0, 1]² of a point in a planar convex quad a, b, c, d, such that it is
/// (1-t) ((1-s) a + s b) + t ((1-s) d + s c).
Point2 quad_coordinates(const Point2& a, const Point2& b, const Point2& c, const Point2& d,
                        const Point2& x) {
  // With e = b - a, f = d - a, g = a - b + c - d the point is a + s e + t f + s t g; the cross
  // product with e + t g removes s and leaves a quadratic in t.
  const Point2 e = b - a;
  const Point2 f = d - a;
  const Point2 g = a - b + c - d;
  const Point2 h = x - a;
  const double t = root_in_unit_interval(cross2(f, g), cross2(f, e) - cross2(h, g), -cross2(h, e));
  const Point2 side = e + t * g;
  const double s = side.dot(h - t * f) / side.squaredNorm();
  return {std::clamp(s, 0.0, 1.0), t};
}

Eigen::RowVectorXd mix(const Eigen::RowVectorXd& a, const Eigen::RowVectorXd& b, double t) {
  return a + t * (b - a);
}

}  // namespace

Eigen::RowVectorXd interpolate(const PatchMesh& mesh, const Eigen::MatrixXd& corners, Index i,
                               const Vec3& point) {
  const Vec3 axis = mesh.normal[i].unitOrthogonal();
  const Vec3 other_axis = mesh.normal[i].cross(axis);
  const auto flat = [&](const Vec3& x) -> Point2 {
    const Vec3 offset = x - mesh.corner(i, 0);
    return {offset.dot(axis), offset.dot(other_axis)};
  };
  const Point2 x = flat(point);
  const Point2 b = flat(mesh.corner(i, 1));
  const Point2 c = flat(mesh.corner(i, 2));
  const auto value = [&](int k) { return Eigen::RowVectorXd(corners.row(4 * i + k)); };
  if (mesh.n_corners(i) == 4) {
    const Point2 st = quad_coordinates(Point2::Zero(), b, c, flat(mesh.corner(i, 3)), x);
    return mix(mix(value(0), value(1), st[0]), mix(value(3), value(2), st[0]), st[1]);
  }
  const double whole = cross2(b, c);
  const double at_b = std::clamp(cross2(x, c) / whole, 0.0, 1.0);
  const double at_c = std::clamp(cross2(b, x) / whole, 0.0, 1.0 - at_b);
  return value(0) + at_b * (value(1) - value(0)) + at_c * (value(2) - value(0));
}

}  // namespace radiosity
