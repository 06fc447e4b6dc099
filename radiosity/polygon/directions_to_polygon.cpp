#include "radiosity/polygon/directions_to_polygon.h"

#include <algorithm>
#include <cmath>

#include "radiosity/polygon/gauss.h"

namespace radiosity {
namespace {

constexpr int kArcOrder = 8;
/// Parts of arcs that come this close to the axis are not divided further: what they add is as
/// small as their distance.
constexpr double kShortestPart = 1e-4;
/// Below this angle the series of the integrand has more digits.
constexpr double kSmallAngle = 3e-3;

/// (θ - sinθ cosθ) / (2 sin²θ).
double cap_share(double angle, double sine, double cosine) {
  if (angle < kSmallAngle) return angle / 3 * (1 + 2 * square(angle) / 15);
  return (angle - sine * cosine) / (2 * sine * sine);
}

/// ∫ of that from `start` to `end`, 0 <= start <= end, along a great circle whose point nearest to
/// the axis is at 0 and whose normal has the cosine `tilt` with the axis.
double integral_from_nearest(double start, double end, double tilt) {
  const double reach = std::sqrt(std::max(0.0, 1 - tilt * tilt));
  double sum = 0;
  while (start < end) {
    // Beyond the ends of a part its analytic continuation has no singularity nearer than its
    // length.
    const double distance = std::max(kShortestPart, std::hypot(start, tilt));
    const double stop = std::min(end, start + distance);
    for (const GaussPoint& node : gauss_rule(kArcOrder)) {
      const double s = start + node.x * (stop - start);
      const double sine = std::hypot(tilt, reach * std::sin(s));
      const double cosine = reach * std::cos(s);
      sum += node.weight * (stop - start) * cap_share(std::atan2(sine, cosine), sine, cosine);
    }
    start = stop;
  }
  return sum;
}

}  // namespace

double solid_angle(std::span<const Vec3> polygon) {
  double sum = 0;
  const Vec3 a = polygon[0].normalized();
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    const Vec3 b = polygon[k - 1].normalized();
    const Vec3 c = polygon[k].normalized();
    sum += 2 * std::atan2(a.dot(b.cross(c)), 1 + a.dot(b) + b.dot(c) + c.dot(a));
  }
  return std::abs(sum);
}

Vec3 light_vector(std::span<const Vec3> polygon) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3 a = polygon[k].normalized();
    const Vec3 b = polygon[k + 1 < polygon.size() ? k + 1 : 0].normalized();
    const Vec3 across = a.cross(b);
    const double sine = across.norm();
    if (sine > 0) sum -= 0.5 * std::atan2(sine, a.dot(b)) / sine * across;
  }
  return sum;
}

double cylinder_integral(std::span<const Vec3> polygon, const Vec3& axis) {
  double sum = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3 a = polygon[k].normalized();
    const Vec3 b = polygon[k + 1 < polygon.size() ? k + 1 : 0].normalized();
    const Vec3 across = a.cross(b);
    const double sine = across.norm();
    if (!(sine > 0)) continue;
    const Vec3 normal = across / sine;
    const double tilt = axis.dot(normal);
    if (tilt == 0) continue;
    // Places along the circle, from the point nearest to the axis on.
    const double start = std::atan2(-axis.dot(normal.cross(a)), axis.dot(a));
    const double end = start + std::atan2(sine, a.dot(b));
    double part = 0;
    if (start >= 0) {
      part = integral_from_nearest(start, end, tilt);
    } else if (end <= 0) {
      part = integral_from_nearest(-end, -start, tilt);
    } else {
      part = integral_from_nearest(0, -start, tilt) + integral_from_nearest(0, end, tilt);
    }
    sum -= tilt * part;
  }
  return sum;
}

}  // namespace radiosity
