#include "radiosity/polygon/directions_to_polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "radiosity/polygon/gauss.h"
#include "radiosity/polygon/point_to_polygon.h"
#include "tests/support/shapes.h"

namespace radiosity {
namespace {

using Triangle = std::array<Vec3, 3>;

/// ∫ f(u) dω over a triangle that faces the origin, by Gauss' rules in its parts.
double over_directions(const Triangle& triangle, const std::function<double(const Vec3&)>& f,
                       int halvings = 4) {
  const auto& [a, b, c] = triangle;
  if (halvings > 0) {
    const Vec3 ab = 0.5 * (a + b);
    const Vec3 bc = 0.5 * (b + c);
    const Vec3 ca = 0.5 * (c + a);
    double sum = 0;
    for (const Triangle& part : {Triangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) {
      sum += over_directions(part, f, halvings - 1);
    }
    return sum;
  }
  const Vec3 area = (b - a).cross(c - a);
  double sum = 0;
  for (const GaussPoint& radial : gauss_jacobi_rule(8)) {
    for (const GaussPoint& along : gauss_rule(8)) {
      const Vec3 x = a + radial.x * ((1 - along.x) * (b - a) + along.x * (c - a));
      sum +=
          radial.weight * along.weight * -area.dot(x) / std::pow(x.norm(), 3) * f(x.normalized());
    }
  }
  return sum;
}

/// A triangle that faces the origin and has no corner below a plane through it.
Triangle random_triangle(std::mt19937_64& random, const Vec3& above) {
  std::uniform_real_distribution<double> distance(0.5, 3);
  for (;;) {
    Triangle triangle;
    for (Vec3& corner : triangle) {
      corner = test::random_unit(random);
      if (corner.dot(above) < 0) corner = -corner;
      corner *= distance(random);
    }
    const Vec3 area = vector_area(triangle);
    if (area.dot(triangle[0]) > 0) std::swap(triangle[1], triangle[2]);
    // Seen too much from the side the reference has few digits.
    if (std::abs(area.dot(triangle[0])) > 0.2) return triangle;
  }
}

// The integrands are smooth over parts a sixteenth of the triangle wide, but for sinθ, which has a
// corner on the axis; triangles near it are for the other tests.
constexpr double kReferenceError = 1e-8;
constexpr double kNearAxis = 0.1;

TEST(DirectionsToPolygon, AreIntegratedAsByQuadrature) {
  std::mt19937_64 random(31);
  int n_tested = 0;
  for (int k = 0; k < 30; ++k) {
    const Vec3 axis = test::random_unit(random);
    const Triangle triangle = random_triangle(random, axis);
    EXPECT_NEAR(solid_angle(triangle), over_directions(triangle, [](const Vec3&) { return 1; }),
                kReferenceError);
    const Vec3 vector = light_vector(triangle);
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(vector[i], over_directions(triangle, [&](const Vec3& u) { return u[i]; }),
                  kReferenceError);
    }
    EXPECT_NEAR(axis.dot(vector), kPi * point_to_polygon(Vec3::Zero(), axis, triangle), 1e-13);
    double nearest = 1;
    const double expected = over_directions(triangle, [&](const Vec3& u) {
      const double sine = u.cross(axis).norm();
      nearest = std::min(nearest, sine);
      return sine;
    });
    if (nearest < kNearAxis) continue;
    ++n_tested;
    EXPECT_NEAR(cylinder_integral(triangle, axis), expected, kReferenceError);
  }
  EXPECT_GT(n_tested, 8);
}

// A ceiling of radius R at height h: θ from 0 to t, ∫ sinθ dω = π (t - sin t cos t); a polygon of
// many corners has it but for the share that its area lacks, 2 π² / (3 n²).
TEST(DirectionsToPolygon, HaveTheClosedFormOfADisc) {
  constexpr int kCorners = 2000;
  for (const double angle : {0.01, 0.3, 1.0, 1.5}) {
    std::vector<Vec3> disc;
    for (int k = 0; k < kCorners; ++k) {
      const double azimuth = -2 * kPi * k / kCorners;  // its lower side looks down
      disc.emplace_back(std::tan(angle) * std::cos(azimuth), std::tan(angle) * std::sin(azimuth),
                        1);
    }
    const double expected = kPi * (angle - std::sin(angle) * std::cos(angle));
    const double lost = 2 * kPi * kPi / (3.0 * kCorners * kCorners);
    EXPECT_NEAR(cylinder_integral(disc, Vec3::UnitZ()), expected, 2 * lost * expected);
    EXPECT_NEAR(solid_angle(disc), 2 * kPi * (1 - std::cos(angle)), 2 * lost * 2 * kPi);
  }
}

// What is added up of parts is the whole, wherever it is cut, through the axis, too.
TEST(DirectionsToPolygon, AddUp) {
  const auto square = [](double x0, double x1, double y0, double y1) {
    return std::array<Vec3, 4>{Vec3(x0, y0, 1), Vec3(x0, y1, 1), Vec3(x1, y1, 1), Vec3(x1, y0, 1)};
  };
  const Vec3 z = Vec3::UnitZ();
  const double whole = cylinder_integral(square(-1, 2, -1.5, 1), z);
  for (const double cut : {-0.9, -1e-3, -1e-9, 0.0, 1e-7, 0.2}) {
    EXPECT_NEAR(cylinder_integral(square(-1, cut, -1.5, 1), z) +
                    cylinder_integral(square(cut, 2, -1.5, 1), z),
                whole, 1e-11);
  }
}

}  // namespace
}  // namespace radiosity
