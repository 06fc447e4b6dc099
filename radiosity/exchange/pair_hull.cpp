#include "radiosity/exchange/pair_hull.h"

#include <cmath>

namespace radiosity {

PairHull::PairHull(const ConvexPolygon& source, const ConvexPolygon& target, double thickness) {
  const Vec3 from = bounding_disc(source.points()).center;
  const Vec3 way = bounding_disc(target.points()).center - from;
  const double length = way.norm();
  const Vec3 along = length > 0 ? Vec3(way / length) : Vec3(Vec3::UnitX());
  const Vec3 u = along.unitOrthogonal();
  const Vec3 v = along.cross(u);
  find_planes(source, target, along, u, v, thickness);
}

__attribute__((target_clones("arch=x86-64-v3", "default"))) bool PairHull::misses(
    const Box3& box) const {
  const double x = box.min().x() + box.max().x();
  const double y = box.min().y() + box.max().y();
  const double z = box.min().z() + box.max().z();
  const double wide = box.max().x() - box.min().x();
  const double deep = box.max().y() - box.min().y();
  const double high = box.max().z() - box.min().z();
  int n_beyond = 0;
  for (int k = 0; k < kPlanes; ++k) {
    const double center = x_[k] * x + y_[k] * y + z_[k] * z;
    const double reach = std::abs(x_[k]) * wide + std::abs(y_[k]) * deep + std::abs(z_[k]) * high;
    n_beyond += center - reach >= 2 * offset_[k] ? 1 : 0;
  }
  return n_beyond > 0;
}

__attribute__((target_clones("arch=x86-64-v3", "default"))) void PairHull::find_planes(
    const ConvexPolygon& source, const ConvexPolygon& target, const Vec3& along, const Vec3& u,
    const Vec3& v, double thickness) {
  constexpr double kHalf = 0.70710678118654752;
  constexpr std::array<double, kPlanes> kCosine{1, kHalf, 0, -kHalf, -1, -kHalf, 0, kHalf};
  constexpr std::array<double, kPlanes> kSine{0, kHalf, 1, kHalf, 0, -kHalf, -1, -kHalf};
  // The highest corner of each polygon in each direction, and how far along the line it is.
  struct Highest {
    std::array<double, kPlanes> height;
    std::array<double, kPlanes> place;
  };
  const auto find_highest = [&](const ConvexPolygon& polygon, Highest& highest) {
    for (int k = 0; k < kPlanes; ++k) highest.height[k] = -1e300;
    for (const Vec3& corner : polygon) {
      const double a = u.dot(corner);
      const double b = v.dot(corner);
      const double c = along.dot(corner);
      for (int k = 0; k < kPlanes; ++k) {
        const double height = kCosine[k] * a + kSine[k] * b;
        const bool is_higher = height > highest.height[k];
        highest.height[k] = is_higher ? height : highest.height[k];
        highest.place[k] = is_higher ? c : highest.place[k];
      }
    }
  };
  Highest of_source;
  Highest of_target;
  find_highest(source, of_source);
  find_highest(target, of_target);
  std::array<double, kPlanes> slope;
  for (int k = 0; k < kPlanes; ++k) {
    const double run = of_target.place[k] - of_source.place[k];
    slope[k] = run > 0 ? (of_target.height[k] - of_source.height[k]) / run : 0;
    offset_[k] = -1e300;
  }
  for (const ConvexPolygon* polygon : {&source, &target}) {
    for (const Vec3& corner : *polygon) {
      const double a = u.dot(corner);
      const double b = v.dot(corner);
      const double c = along.dot(corner);
      for (int k = 0; k < kPlanes; ++k) {
        const double height = kCosine[k] * a + kSine[k] * b - slope[k] * c;
        offset_[k] = height > offset_[k] ? height : offset_[k];
      }
    }
  }
  for (int k = 0; k < kPlanes; ++k) {
    x_[k] = kCosine[k] * u.x() + kSine[k] * v.x() - slope[k] * along.x();
    y_[k] = kCosine[k] * u.y() + kSine[k] * v.y() - slope[k] * along.y();
    z_[k] = kCosine[k] * u.z() + kSine[k] * v.z() - slope[k] * along.z();
    offset_[k] -= thickness * std::sqrt(1 + slope[k] * slope[k]);
  }
}

}  // namespace radiosity
