#include "radiosity/polygon/exchange_area.h"
#include "radiosity/polygon/point_to_polygon.h"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

#include "apps/validation/reference/built_scenes.h"
#include "apps/validation/reference/known_factors.h"
#include "radiosity/polygon/contour_integral.h"
#include "radiosity/polygon/polygon_quadrature.h"

namespace radiosity {
namespace {

using Polygon = std::vector<Vec3>;

TEST(ExchangeArea, EqualsClosedFormsOfUnoccludedPolygons) {
  int n_cases = 0;
  for (const auto& known : apps::validation::read_known_factors(RADIOSITY_TEST_DATA)) {
    if (known.polygon1.empty()) continue;
    const Polygon& a = known.polygon1;
    const Polygon& b = known.polygon2;
    EXPECT_NEAR(exchange_area(a, b) / known.exchange_area, 1, 1e-10) << known.name;
    EXPECT_NEAR(exchange_area(b, a) / known.exchange_area, 1, 1e-10) << known.name;
    ++n_cases;
  }
  EXPECT_GE(n_cases, 16);
}

TEST(ExchangeArea, PentagonAndSquare) {
  const Polygon pentagon{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0.5, 2, 0}, {0, 1, 0}};
  const Polygon square{{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}};
  // tests/data/form-factors.json: EES F3D_poly test case C.
  EXPECT_NEAR(exchange_area(pentagon, square) / (1.5 * 0.15412431824856255839), 1, 1e-10);
}

TEST(ExchangeArea, RowsOfClosedPrismsSumToOne) {
  for (const int n : {3, 4, 5, 8, 12}) {
    for (const double height : {0.01, 0.3, 1.0, 20.0}) {
      const auto faces =
          apps::validation::prism_inside(apps::validation::regular_polygon(n, 1, 0, true), height);
      for (std::size_t i = 0; i < faces.size(); ++i) {
        double sum = 0;
        for (std::size_t j = 0; j < faces.size(); ++j) {
          if (i != j) sum += exchange_area(faces[i], faces[j]);
        }
        EXPECT_NEAR(sum / vector_area(faces[i]).norm(), 1, 1e-10) << n << " " << height << " " << i;
      }
    }
  }
}

TEST(ExchangeArea, OctahedronAndPrismClosedForms) {
  const auto known = apps::validation::read_known_factors(RADIOSITY_TEST_DATA);
  const auto& octahedron = apps::validation::known_factor(known, "regular octahedron interior");
  const std::array<Vec3, 6> v{Vec3(1, 0, 0),  Vec3(-1, 0, 0), Vec3(0, 1, 0),
                              Vec3(0, -1, 0), Vec3(0, 0, 1),  Vec3(0, 0, -1)};
  const Polygon face{v[0], v[4], v[2]};  // inward: seen from the centre counter-clockwise
  const Polygon edge{v[2], v[4], v[1]};
  const Polygon vertex{v[1], v[4], v[3]};
  const Polygon opposite{v[1], v[5], v[3]};
  const double area = vector_area(face).norm();
  const auto inward = [](Polygon p) {
    if (vector_area(p).dot(p[0]) > 0) std::swap(p[1], p[2]);
    return p;
  };
  const auto factor = [&](const Polygon& to) {
    return exchange_area(inward(face), inward(to)) / area;
  };
  EXPECT_NEAR(factor(edge) / octahedron.value("F_adjacent_edge"), 1, 1e-10);
  EXPECT_NEAR(factor(vertex) / octahedron.value("F_sharing_vertex"), 1, 1e-10);
  EXPECT_NEAR(factor(opposite) / octahedron.value("F_opposite"), 1, 1e-10);
}

Polygon random_polygon(std::mt19937_64& random, const Vec3& center, double size) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0.5, 1);
  const Vec3 u = Vec3(normal(random), normal(random), normal(random)).normalized();
  const Vec3 w = Vec3(normal(random), normal(random), normal(random)).normalized();
  const Vec3 v = w.cross(u).normalized();
  const int n = normal(random) > 0 ? 3 : 4;
  Polygon polygon;
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * kPi * (k + 0.4 * uniform(random)) / n;
    polygon.push_back(center + size * (std::cos(angle) * u + std::sin(angle) * v));
  }
  return polygon;
}

/// High-order quadrature of the point-to-polygon factor over polygon a, for separated pairs.
double reference_by_quadrature(const Polygon& a, const Polygon& b) {
  const Vec3 normal = vector_area(a).normalized();
  double sum = 0;
  for_each_quadrature_point(
      a, 24, [&](const Vec3& x, double weight) { sum += weight * point_to_polygon(x, normal, b); });
  return sum;
}

TEST(ExchangeArea, EveryRungKeepsItsTolerance) {
  std::mt19937_64 random(42);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const double tolerance : {1e-3, 1e-6, 1e-9}) {
    int n_checked = 0;
    for (int trial = 0; trial < 4000; ++trial) {
      const double size = std::pow(10, -2 * uniform(random));
      const double distance = (1 + size) * std::pow(10, 0.2 + 1.8 * uniform(random));
      const Vec3 direction = Vec3(normal(random), normal(random), normal(random)).normalized();
      const Polygon a = random_polygon(random, Vec3::Zero(), 1);
      const Polygon b = random_polygon(random, distance * direction, size);
      // Only pairs that wholly face each other: the reference is smooth then.
      const Vec3 na = vector_area(a);
      const Vec3 nb = vector_area(b);
      bool is_facing = true;
      for (const Vec3& x : b) is_facing &= na.dot(x - a[0]) > 0;
      for (const Vec3& x : a) is_facing &= nb.dot(x - b[0]) > 0;
      if (!is_facing) continue;
      const double expected = reference_by_quadrature(b, a);
      ++n_checked;
      EXPECT_NEAR(exchange_area(a, b, tolerance) / expected, 1, tolerance)
          << "distance " << distance << " size " << size;
    }
    EXPECT_GT(n_checked, 300);
  }
}

TEST(ExchangeArea, NearlyParallelAndNearlyTouchingEdges) {
  // Splitting a polygon must not change the sum, however awkward the angle.
  for (const double angle : {1e-9, 1e-6, 1e-4, 1e-2}) {
    for (const double gap : {0.0, 1e-9, 1e-5, 1e-2}) {
      const Polygon floor{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
      const Vec3 low(-gap, 0, 0);
      const Vec3 turned(-gap - std::sin(angle), std::cos(angle), 0);
      const Vec3 up(0, 0, 1);
      const Polygon wall{low, turned, turned + up, low + up};
      const Polygon left{low, (low + turned) / 2, (low + turned) / 2 + up, low + up};
      const Polygon right{(low + turned) / 2, turned, turned + up, (low + turned) / 2 + up};
      const double whole = exchange_area(floor, wall);
      const double parts = exchange_area(floor, left) + exchange_area(floor, right);
      EXPECT_NEAR(whole / parts, 1, 1e-9) << angle << " " << gap;
      EXPECT_NEAR(whole, 0.2, 0.01);
    }
  }
}

TEST(ExchangeArea, EdgesThatLeaveACornerAtATinyAngle) {
  // From the origin an edge of the floor's triangle leaves the wall's at 2e-5.
  const Polygon floor{{0, 0, 0}, {0.5, 1e-5, 0}, {0, 1, 0}};
  const Polygon wall{{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}};
  const double expected = contour_exchange_area_adaptive(floor, wall, 1e-14).value;
  EXPECT_NEAR(exchange_area(floor, wall, 1e-9) / expected, 1, 1e-9);
  EXPECT_NEAR(contour_exchange_area(floor, wall).value / expected, 1, 1e-9);
}

TEST(ExchangeArea, BehindIsExactlyZeroAndHorizonIsClipped) {
  const Polygon floor{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const Polygon below{{0, 0, -1}, {1, 0, -1}, {1, 1, -1}, {0, 1, -1}};
  EXPECT_EQ(exchange_area(floor, below), 0);
  EXPECT_EQ(exchange_area(floor, floor), 0);
  const Polygon beside{{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}};
  EXPECT_EQ(exchange_area(floor, beside), 0);
  const Polygon wall{{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}};
  const Polygon sunk{{0, 0, -1}, {0, 1, -1}, {0, 1, 1}, {0, 0, 1}};
  EXPECT_NEAR(exchange_area(floor, sunk) / exchange_area(floor, wall), 1, 1e-10);
}

TEST(ExchangeArea, IsInvariantUnderScaleAndOffset) {
  const Polygon a{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const Polygon b{{0.2, 0.1, 0.7}, {0.3, 0.9, 1.1}, {1.2, 0.4, 0.9}};
  const double expected = exchange_area(a, b);
  for (const double scale : {1e-6, 1e6}) {
    Polygon sa;
    Polygon sb;
    for (const Vec3& p : a) sa.push_back(scale * p);
    for (const Vec3& p : b) sb.push_back(scale * p);
    EXPECT_NEAR(exchange_area(sa, sb) / (scale * scale * expected), 1, 1e-10);
  }
}

TEST(ExchangeArea, NeedleTriangles) {
  // A needle's factor must add up from that of its parts.
  const double thin = 1e-5;
  const Polygon square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  for (const double gap : {0.0, 0.1, 3.0}) {
    const Vec3 a(0, 0, gap);
    const Vec3 b(0, 1, gap);
    const Vec3 c(0, 0.3, gap + thin);
    const Vec3 middle = (a + b) / 2;
    const double whole = exchange_area(square, Polygon{a, b, c});
    const double parts =
        exchange_area(square, Polygon{a, middle, c}) + exchange_area(square, Polygon{middle, b, c});
    EXPECT_GT(whole, 0);
    EXPECT_NEAR(whole / parts, 1, 1e-8) << gap;
  }
}

TEST(PointToPolygon, EqualsClosedForm) {
  // tests/data/form-factors.json: element to parallel 1 x 1 rectangle, corner on the normal.
  const Polygon square{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}};
  EXPECT_NEAR(point_to_polygon(Vec3::Zero(), Vec3(0, 0, 1), square), 0.13853160599489299678, 1e-15);
  EXPECT_EQ(point_to_polygon(Vec3(0, 0, 2), Vec3(0, 0, -1), square), 0);
  EXPECT_EQ(point_to_polygon(Vec3::Zero(), Vec3(0, 0, -1), square), 0);
}

TEST(ImaginaryDilogarithm, EqualsItsPowerSeries) {
  for (const double x : {0.05, 0.3, 1.0, 4.0, 30.0}) {
    for (const double alpha : {1e-3, 0.5, 1.0, 1.5, 2.5, 3.14}) {
      double sum = 0;
      for (int n = 1; n <= 2000; ++n)
        sum += std::exp(-n * x) * std::sin(n * alpha) / (n * double(n));
      EXPECT_NEAR(imaginary_dilogarithm(x, alpha), sum, 1e-14) << x << " " << alpha;
    }
  }
}

}  // namespace
}  // namespace radiosity
