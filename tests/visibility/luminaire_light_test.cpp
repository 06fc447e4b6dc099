// Luminaires: flux in closed form and kept in rooms, lux at points, shadows against segments one by
// one.
#include "radiosity/visibility/luminaire_light.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "meshing/patches/patches.h"
#include "radiosity/base/parallel.h"
#include "radiosity/polygon/gauss.h"
#include "radiosity/polygon/point_to_polygon.h"
#include "radiosity/scene/luminaire_points.h"
#include "radiosity/visibility/coverage.h"
#include "radiosity/visibility/incident_light.h"
#include "tests/support/scene_families.h"
#include "tests/support/scene_variations.h"
#include "tests/support/shapes.h"

namespace radiosity {
namespace {

using test::add_box;
using test::add_grid;
using test::Facing;

using Type = PhotometricWeb::Type;

double uniform(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// Angles that are spaced unevenly from `low` to `high`.
std::vector<double> uneven_angles(int n, double low, double high, std::mt19937_64& random) {
  std::vector<double> angles{low};
  for (int k = 1; k < n; ++k) angles.push_back(angles.back() + uniform(random, 0.2, 1));
  for (double& angle : angles) angle = low + (angle - low) * (high - low) / (angles.back() - low);
  angles.back() = high;
  return angles;
}

/// Any intensities, all around for type C, in front of the plane z = 0 for B and A.
PhotometricWeb random_web(Type type, std::mt19937_64& random) {
  PhotometricWeb web;
  web.type = type;
  const bool is_c = type == Type::c;
  web.polar = uneven_angles(4 + static_cast<int>(random() % 20), 0, kPi, random);
  web.azimuth = uneven_angles(3 + static_cast<int>(random() % 15), is_c ? 0 : -kPi / 2,
                              is_c ? 2 * kPi : kPi / 2, random);
  web.intensity.resize(static_cast<Index>(web.polar.size()),
                       static_cast<Index>(web.azimuth.size()));
  for (double& value : web.intensity.reshaped()) value = uniform(random, 0, 100);
  if (is_c) web.intensity.rightCols(1) = web.intensity.leftCols(1);
  return web;
}

PhotometricWeb isotropic_web(double candela) {
  return {Type::c, {0, kPi}, {0}, Eigen::MatrixXd::Constant(2, 1, candela)};
}

/// ∫ I dΩ cell by cell by a rule that is exact to rounding for what is bilinear times a sine.
double flux_by_rule(const PhotometricWeb& web) {
  constexpr int kOrder = 12;
  const PolarAxes axes = polar_axes(web.type);
  double sum = 0;
  for (std::size_t i = 1; i < web.polar.size(); ++i) {
    for (std::size_t j = 1; j < web.azimuth.size(); ++j) {
      const double height = web.polar[i] - web.polar[i - 1];
      const double width = web.azimuth[j] - web.azimuth[j - 1];
      for (const GaussPoint& u : gauss_rule(kOrder)) {
        for (const GaussPoint& v : gauss_rule(kOrder)) {
          const double polar = web.polar[i - 1] + u.x * height;
          const double azimuth = web.azimuth[j - 1] + v.x * width;
          const Vec3 across = std::cos(azimuth) * axes.zero + std::sin(azimuth) * axes.quarter;
          const Vec3 direction = std::cos(polar) * axes.pole + std::sin(polar) * across;
          sum += u.weight * v.weight * height * width * std::sin(polar) * intensity(web, direction);
        }
      }
    }
  }
  return sum;
}

TEST(PhotometricWeb, HasTheFluxOfItsInterpolant) {
  std::mt19937_64 random(1);
  EXPECT_NEAR(flux(isotropic_web(1)), 4 * kPi, 1e-14);
  for (const Type type : {Type::c, Type::b, Type::a}) {
    for (int k = 0; k < 20; ++k) {
      const PhotometricWeb web = random_web(type, random);
      EXPECT_NEAR(flux(web), flux_by_rule(web), 1e-12 * flux(web));
    }
  }
  // I0 (1 - 2γ/π) down to the horizon: 2π I0 (1 - 2/π).
  const PhotometricWeb cone{Type::c, {0, kPi / 2}, {0}, Eigen::Vector2d(1, 0)};
  EXPECT_NEAR(flux(cone), 2 * kPi * (1 - 2 / kPi), 1e-14);
  EXPECT_NEAR(downward_flux(isotropic_web(1)), 2 * kPi, 1e-14);
}

TEST(PhotometricWeb, OfManyAnglesHasTheFluxOfACosine) {
  // The interpolant is off by Δ²/8 of the second derivative: Δ²/12 relative in the flux.
  constexpr int kAngles = 9001;
  PhotometricWeb web{Type::c, {}, {0}, Eigen::MatrixXd(kAngles, 1)};
  for (int k = 0; k < kAngles; ++k) {
    web.polar.push_back(kPi / 2 * k / (kAngles - 1));
    web.intensity(k, 0) = 100 / kPi * std::cos(web.polar.back());
  }
  const double step = kPi / 2 / (kAngles - 1);
  EXPECT_NEAR(flux(web), 100 * (1 - step * step / 12), 100 * 1e-12);
}

TEST(PhotometricWeb, HasDirectionsByType) {
  // The peak at V = 30° upwards, H = 20° to the right, alone of types B and A.
  const double v = kPi / 6;
  const double h = kPi / 9;
  const auto with_peak = [](Type type, double polar, double azimuth) {
    PhotometricWeb web{type, {0, polar, kPi}, {-kPi / 2, azimuth, kPi / 2}, {}};
    web.intensity = Eigen::Matrix3d::Zero();
    web.intensity(1, 1) = 7;
    return web;
  };
  const PhotometricWeb b = with_peak(Type::b, kPi / 2 + h, v);
  const Vec3 b_way(std::sin(h), std::cos(h) * std::sin(v), -std::cos(h) * std::cos(v));
  EXPECT_NEAR(intensity(b, 3 * b_way), 7, 1e-12);
  const PhotometricWeb a = with_peak(Type::a, kPi / 2 + v, h);
  const Vec3 a_way(std::cos(v) * std::sin(h), std::sin(v), -std::cos(v) * std::cos(h));
  EXPECT_NEAR(intensity(a, a_way), 7, 1e-12);
  EXPECT_EQ(intensity(a, -a_way), 0);
}

TEST(WebFlux, OfAnIsotropicSourceIsTheSolidAngle) {
  std::mt19937_64 random(2);
  const WebFlux web(isotropic_web(1));
  for (int k = 0; k < 200; ++k) {
    std::vector<Vec3> triangle;
    const Vec3 center = std::pow(10, uniform(random, -2, 1)) * test::random_unit(random);
    for (int corner = 0; corner < 3; ++corner) {
      triangle.push_back(center + test::random_unit(random));
    }
    if (vector_area(triangle).dot(triangle[0]) > 0) std::swap(triangle[0], triangle[1]);
    const Vec3 a = triangle[0].normalized();
    const Vec3 b = triangle[1].normalized();
    const Vec3 c = triangle[2].normalized();
    // Van Oosterom & Strackee 1983
    const double angle =
        2 * std::atan2(std::abs(a.dot(b.cross(c))), 1 + a.dot(b) + b.dot(c) + c.dot(a));
    EXPECT_NEAR(web.through(triangle), angle, 1e-9) << k;
  }
}

TEST(WebFlux, IsThatOfPointsInThePolygon) {
  constexpr int kSteps = 400;
  std::mt19937_64 random(3);
  for (const Type type : {Type::c, Type::b, Type::a}) {
    for (int k = 0; k < 3; ++k) {
      const PhotometricWeb web = random_web(type, random);
      const Vec3 corner = 2 * test::random_unit(random) - Vec3(0, 0, 0.5);
      const Vec3 u = test::random_unit(random);
      const Vec3 v = test::random_unit(random);
      std::vector<Vec3> polygon{corner, corner + u, corner + u + v, corner + v};
      const bool is_seen = u.cross(v).dot(corner) < 0;
      if (!is_seen) std::reverse(polygon.begin(), polygon.end());
      const double height = std::abs(u.cross(v).dot(corner));
      double sum = 0;
      for (int a = 0; a < kSteps; ++a) {
        for (int b = 0; b < kSteps; ++b) {
          const Vec3 x = corner + (a + 0.5) / kSteps * u + (b + 0.5) / kSteps * v;
          sum += intensity(web, x) * height / std::pow(x.norm(), 3) / kSteps / kSteps;
        }
      }
      // Midpoints are off by some 1/n² of the greatest value, 100 cd, with kinks between.
      EXPECT_NEAR(WebFlux(web).through(polygon), sum, 10 * 100.0 / kSteps / kSteps);
    }
  }
}

/// A grey scene with one web, to which luminaires are added.
Scene luminaire_scene(const PhotometricWeb& web) {
  Scene scene;
  scene.bands = {.kind = Bands::Kind::grey, .wavelengths = {}};
  Photometry photometry;
  photometry.web = web;
  scene.photometries.push_back(photometry);
  return scene;
}

void add_luminaire(Scene& scene, const Vec3& position, const Eigen::Matrix3d& axes) {
  Luminaire luminaire;
  luminaire.position = position;
  luminaire.axes = axes;
  luminaire.watts_per_lumen = Eigen::VectorXd::Ones(1);
  scene.luminaires.push_back(luminaire);
}

Eigen::Matrix3d random_axes(std::mt19937_64& random) {
  return Eigen::AngleAxisd(uniform(random, -3, 3), test::random_unit(random)).toRotationMatrix();
}

double total_flux(const PatchMesh& mesh, const Eigen::MatrixXd& irradiance) {
  return irradiance.col(0).dot(Eigen::Map<const Eigen::VectorXd>(mesh.area.data(), mesh.size()));
}

double lux_at(const Scene& scene, const PatchMesh& mesh, const Vec3& x, const Vec3& normal) {
  Eigen::VectorXd value = Eigen::VectorXd::Zero(1);
  LuminaireLight(scene, mesh).add(x, normal, value);
  return value[0];
}

void move_mesh(PatchMesh& mesh, const Eigen::Isometry3d& motion) {
  for (Vec3& vertex : mesh.vertices) vertex = motion * vertex;
  for (Vec3& centroid : mesh.centroid) centroid = motion * centroid;
  for (Vec3& normal : mesh.normal) normal = motion.linear() * normal;
}

TEST(LuminaireLight, GivesTheLuxOfItsCandela) {
  PatchMesh floor;
  add_grid(floor, Vec3(-2, -2, 0), Vec3(4, 0, 0), Vec3(0, 4, 0), 3, 3);
  Scene scene = luminaire_scene(isotropic_web(100 / (4 * kPi)));
  add_luminaire(scene, Vec3(0, 0, 1), Eigen::Matrix3d::Identity());
  const Vec3 up(0, 0, 1);
  EXPECT_NEAR(lux_at(scene, floor, Vec3::Zero(), up), 7.957747154594767, 1e-12);
  EXPECT_NEAR(lux_at(scene, floor, Vec3(1, 0, 0), up), 7.957747154594767 / std::sqrt(8), 1e-12);
  EXPECT_EQ(lux_at(scene, floor, Vec3(1, 0, 0), -up), 0);
  scene.luminaires[0].dimming = 0.25;
  scene.luminaires[0].lumens = 800;
  EXPECT_NEAR(lux_at(scene, floor, Vec3::Zero(), up), 2 * 7.957747154594767, 1e-12);
}

// CIE 171:2006, 5.2: I = I0 cos γ at 3 m, E = I0 h²/d⁴. The web has the points' angles.
TEST(LuminaireLight, OfACosineIsTheClosedFormOfCie171) {
  const std::vector<Eigen::Vector2d> points{{0, 0},  {.5, 0},   {1, 0}, {1.5, 0}, {.5, .5},
                                            {1, .5}, {1.5, .5}, {1, 1}, {1.5, 1}, {1.5, 1.5}};
  PhotometricWeb web{Type::c, {}, {0}, {}};
  for (const Eigen::Vector2d& x : points) web.polar.push_back(std::atan(x.norm() / 3));
  web.polar.push_back(kPi / 2);
  std::sort(web.polar.begin(), web.polar.end());
  web.polar.erase(std::unique(web.polar.begin(), web.polar.end()), web.polar.end());
  web.intensity.resize(static_cast<Index>(web.polar.size()), 1);
  for (std::size_t k = 0; k < web.polar.size(); ++k) {
    web.intensity(static_cast<Index>(k), 0) = 1000 * std::cos(web.polar[k]);
  }
  std::mt19937_64 random(4);
  PatchMesh floor;
  add_grid(floor, Vec3(-2, -2, 0), Vec3(4, 0, 0), Vec3(0, 4, 0), 4, 4);
  for (int turn = 0; turn < 3; ++turn) {
    Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
    if (turn > 0) {
      motion.rotate(random_axes(random));
      motion.translation() = 10 * test::random_unit(random);
    }
    PatchMesh moved = floor;
    move_mesh(moved, motion);
    Scene scene = luminaire_scene(web);
    add_luminaire(scene, motion * Vec3(0, 0, 3), motion.linear());
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Vec3 x(points[k].x(), points[k].y(), 0);
      const double found = lux_at(scene, moved, motion * x, motion.linear() * Vec3(0, 0, 1));
      const double distance2 = x.squaredNorm() + 9;
      EXPECT_NEAR(found, 1000 * 9 / square(distance2), 1e-9);
    }
  }
}

TEST(LuminaireLight, KeepsItsFluxInClosedRooms) {
  std::mt19937_64 random(5);
  for (int k = 0; k < 12; ++k) {
    PatchMesh mesh;
    add_box(mesh, Vec3(0, 0, 0), Vec3(4, 3, 2.5), 1 + k % 4, Facing::inwards);
    add_box(mesh, Vec3(1, 1, 0.2), Vec3(2, 1.7, 0.9), 1 + k % 3, Facing::outwards);
    add_box(mesh, Vec3(2.5, 0.5, 0), Vec3(3, 1.5, 1.2), 2, Facing::outwards);
    Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
    if (k % 2 == 1) {
      motion.rotate(random_axes(random));
      motion.translation() = 20 * test::random_unit(random);
    }
    move_mesh(mesh, motion);
    const Type type = k % 3 == 0 ? Type::c : k % 3 == 1 ? Type::b : Type::a;
    Scene scene = luminaire_scene(random_web(type, random));
    double expected = 0;
    for (int n = 0; n < 2; ++n) {
      const Vec3 position(uniform(random, 0.1, 3.9), uniform(random, 0.1, 2.9),
                          uniform(random, 1.3, 2.4));
      add_luminaire(scene, motion * position, n == 0 ? motion.linear() : random_axes(random));
      expected += flux(scene.photometries[0].web);
    }
    const Eigen::MatrixXd irradiance = LuminaireLight(scene, mesh).irradiance().irradiance;
    EXPECT_NEAR(total_flux(mesh, irradiance), expected, 1e-8 * expected) << k;
  }
}

TEST(LuminaireLight, OnTheCeilingGivesDownwards) {
  for (const double below : {0.0, 1e-4}) {
    PatchMesh mesh;
    add_box(mesh, Vec3(0, 0, 0), Vec3(4, 3, 2.5), 3, Facing::inwards);
    Scene scene = luminaire_scene(isotropic_web(1));
    add_luminaire(scene, Vec3(4.0 / 3, 1.2, 2.5 - below), Eigen::Matrix3d::Identity());
    // Mounted, half of it goes into what it is mounted on and nothing beyond.
    add_box(mesh, Vec3(0, 0, 3), Vec3(4, 3, 5), 2, Facing::inwards);
    const Eigen::MatrixXd irradiance = LuminaireLight(scene, mesh).irradiance().irradiance;
    const double expected = below > 0 ? 4 * kPi : 2 * kPi;
    EXPECT_NEAR(total_flux(mesh, irradiance), expected, 1e-9) << below;
    EXPECT_NEAR(lux_at(scene, mesh, Vec3(4.0 / 3, 1.2, 0), Vec3(0, 0, 1)), 1 / square(2.5 - below),
                1e-12);
    EXPECT_EQ(lux_at(scene, mesh, Vec3(2, 1, 4), Vec3(0, 0, -1)), 0);
  }
}

// A Lambertian opening of many points is an area source: the form factor from a point to it.
TEST(LuminaireLight, OfManyPointsIsAnAreaSource) {
  constexpr int kAngles = 901;
  PhotometricWeb web{Type::c, {}, {0}, Eigen::MatrixXd(kAngles, 1)};
  for (int k = 0; k < kAngles; ++k) {
    web.polar.push_back(kPi / 2 * k / (kAngles - 1));
    web.intensity(k, 0) = std::cos(web.polar.back());
  }
  PatchMesh floor;
  add_grid(floor, Vec3(-2, -2, 0), Vec3(4, 0, 0), Vec3(0, 4, 0), 1, 1);
  Scene scene = luminaire_scene(web);
  scene.photometries[0].along_c0 = 1.2;
  scene.photometries[0].along_c90 = 0.6;
  add_luminaire(scene, Vec3(0.1, 0, 1), Eigen::Matrix3d::Identity());
  const double area = 1.2 * 0.6;
  const std::vector<Vec3> opening{Vec3(-0.5, -0.3, 1), Vec3(-0.5, 0.3, 1), Vec3(0.7, 0.3, 1),
                                  Vec3(0.7, -0.3, 1)};
  const Vec3 x(0.3, 0.2, 0);
  const double expected = kPi / area * point_to_polygon(x, Vec3(0, 0, 1), opening);
  double earlier = 0;
  for (const int n : {4, 8, 16, 32}) {
    scene.luminaires[0].divisions = {2 * n, n};
    const double off = lux_at(scene, floor, x, Vec3(0, 0, 1)) - expected;
    // Midpoints: an error of order 2 in the points' distance.
    if (n > 4) {
      EXPECT_NEAR(earlier / off, 4, 0.2) << n;
    }
    earlier = off;
  }
  EXPECT_NEAR(earlier, 0, 2e-4 * expected);
  // Round ones: all points within the disc, their mean distance from its centre 2/3 of the radius.
  scene.photometries[0].along_c90 = 1.2;
  scene.photometries[0].is_round = true;
  scene.luminaires[0].divisions = {32, 32};
  double sum = 0;
  for (const Vec3& point : luminaire_points(scene.luminaires[0], scene.photometries[0])) {
    const double distance = (point - scene.luminaires[0].position).norm();
    EXPECT_LT(distance, 0.6);
    sum += distance / 32 / 32;
  }
  EXPECT_NEAR(sum, 0.4, 1e-3);
}

// A cupboard on the floor, closed all around or open below: what it covers of the floor takes no
// part in the exchange of light, and gets none of a lamp within it.
TEST(LuminaireLight, WithinASolidLightsNothing) {
  for (const bool has_bottom : {true, false}) {
    PatchMesh mesh;
    add_box(mesh, Vec3(0, 0, 0), Vec3(3, 3, 2.5), 3, Facing::inwards);
    const Vec3 x(1, 0, 0);
    const Vec3 y(0, 1, 0);
    const Vec3 z(0, 0, 1.2);
    const Vec3 low(1, 1, 0);
    add_grid(mesh, low + z, x, y, 1, 1);
    add_grid(mesh, low, x, z, 1, 1);
    add_grid(mesh, low, z, y, 1, 1);
    add_grid(mesh, low + x, y, z, 1, 1);
    add_grid(mesh, low + y, z, x, 1, 1);
    if (has_bottom) add_grid(mesh, low, y, x, 1, 1);
    for (const Vec3& position : {Vec3(1.4, 1.6, 0.7), Vec3(1.5, 1.5, 1.19)}) {
      Scene scene = luminaire_scene(isotropic_web(100));
      add_luminaire(scene, position, Eigen::Matrix3d::Identity());
      // But for what rounding leaves beside edges.
      const Eigen::MatrixXd within = LuminaireLight(scene, mesh).irradiance().irradiance;
      EXPECT_LT(total_flux(mesh, within), 1e-9) << has_bottom;
      // Above it, it lights all of the room.
      scene.luminaires[0].position.z() = 2;
      const double flux = total_flux(mesh, LuminaireLight(scene, mesh).irradiance().irradiance);
      EXPECT_NEAR(flux, 100 * 4 * kPi, 1e-6);
    }
  }
}

TEST(LuminaireLight, TurnsWithItsAxes) {
  // All light towards C = 90°, γ = 45°; what that is follows from aim and turn.
  PhotometricWeb web{Type::c, {0, kPi / 4, kPi / 2}, {0, kPi / 2, kPi, 3 * kPi / 2, 2 * kPi}, {}};
  web.intensity = Eigen::MatrixXd::Zero(3, 5);
  web.intensity(1, 1) = 10;
  const Vec3 up(0, 0, 1);
  const Vec3 east(1, 0, 0);
  const auto toward = [&](const Eigen::Matrix3d& axes, const Vec3& way) {
    return intensity(web, axes.transpose() * way);
  };
  EXPECT_NEAR(toward(aimed_axes(-up, 0, up, east), Vec3(0, 1, -1)), 10, 1e-12);
  EXPECT_NEAR(toward(aimed_axes(-up, kPi / 2, up, east), Vec3(-1, 0, -1)), 10, 1e-12);
  EXPECT_NEAR(toward(aimed_axes(Vec3(1, 0, 0), 0, up, east), Vec3(1, 0, 1)), 10, 1e-12);
  EXPECT_NEAR(toward(aimed_axes(Vec3(0, 1, 0), kPi / 2, up, east), Vec3(-1, 1, 0)), 10, 1e-12);
  EXPECT_NEAR(toward(aimed_axes(-up, Vec3(0, 3, 1)), Vec3(-1, 0, -1)), 10, 1e-12);
  std::mt19937_64 random(6);
  for (int k = 0; k < 20; ++k) {
    const Eigen::Matrix3d axes = aimed_axes(test::random_unit(random), k, up, east);
    EXPECT_TRUE((axes * axes.transpose()).isIdentity(1e-14));
    EXPECT_NEAR(axes.determinant(), 1, 1e-14);
  }
}

/// A segment from a light against each patch, in double precision.
enum class Segment { free, blocked, grazing };

Segment segment_to(const PatchMesh& mesh, const Vec3& light, const Vec3& x) {
  constexpr double kGrazing = 1e-7;  // m; scenes have some 1 m
  Segment result = Segment::free;
  for (Index i = 0; i < mesh.size(); ++i) {
    const Vec3& normal = mesh.normal[i];
    const double start = normal.dot(light - mesh.centroid[i]);
    const double end = normal.dot(x - mesh.centroid[i]);
    if (std::abs(end) < 1e-9 || std::abs(start) < 1e-9) continue;
    const bool is_crossed = start * end < 0;
    if (!is_crossed && std::min(std::abs(start), std::abs(end)) > kGrazing) continue;
    const Vec3 there = light + start / (start - end) * (x - light);
    double inside = 1e9;
    for (int k = 0; k < mesh.n_corners(i); ++k) {
      const Vec3& a = mesh.corner(i, k);
      const Vec3& b = mesh.corner(i, (k + 1) % mesh.n_corners(i));
      inside = std::min(inside, normal.dot((b - a).normalized().cross(there - a)));
    }
    const bool is_close = std::abs(start) < kGrazing || std::abs(end) < kGrazing;
    if (inside < -kGrazing && !is_close) continue;
    if (inside < kGrazing || is_close) {
      result = Segment::grazing;
    } else {
      return Segment::blocked;
    }
  }
  return result;
}

class LuminairesAmongFamilies : public testing::TestWithParam<test::Family> {};

TEST_P(LuminairesAmongFamilies, ReachWhatSegmentsReach) {
  constexpr int kPoints = 100;
  for (const std::uint64_t seed : {1, 2}) {
    const test::FamilyScene family = test::vary(test::make_family_scene(GetParam(), seed),
                                                {.is_turned = seed == 2, .seed = seed});
    const PatchMesh mesh = meshing::make_patches(family.scene, {.n_patches = 150});
    const Box3 box = bounds(mesh);
    std::mt19937_64 random(seed);
    Scene scene = luminaire_scene(isotropic_web(1));
    const Vec3 place(uniform(random, 0.2, 0.8), uniform(random, 0.2, 0.8),
                     uniform(random, 0.2, 0.8));
    const Vec3 position = box.min() + place.cwiseProduct(box.sizes());
    add_luminaire(scene, position, random_axes(random));
    const LuminaireLight light(scene, mesh);
    const Eigen::MatrixXd irradiance = light.irradiance().irradiance;
    const Coverage coverage = find_coverage(mesh, plane_thickness(mesh));
    const Index step = std::max<Index>(1, mesh.size() / 40);
    for (Index i = 0; i < mesh.size(); i += step) {
      const Vec3& normal = mesh.normal[i];
      if (normal.dot(position - mesh.centroid[i]) < 1e-6) {
        EXPECT_LE(irradiance(i, 0), 1e-3);
        continue;
      }
      double sum = 0;
      double squares = 0;
      double most = 0;
      int n_grazing = 0;
      for (int k = 0; k < kPoints; ++k) {
        std::vector<Vec3> corners;
        for (int c = 0; c < mesh.n_corners(i); ++c) corners.push_back(mesh.corner(i, c));
        if (corners.size() == 4) {
          const double first =
              0.5 * (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm();
          corners.erase(corners.begin() + (uniform(random, 0, mesh.area[i]) > first ? 1 : 3));
        }
        double u = uniform(random, 0, 1);
        double v = uniform(random, 0, 1);
        if (u + v > 1) {
          u = 1 - u;
          v = 1 - v;
        }
        const Vec3 x = corners[0] + u * (corners[1] - corners[0]) + v * (corners[2] - corners[0]);
        const Vec3 way = position - x;
        const double free = std::max(0., normal.dot(way)) / std::pow(way.norm(), 3);
        most = std::max(most, free);
        const Segment segment = segment_to(mesh, position, x);
        n_grazing += segment == Segment::grazing ? 1 : 0;
        if (segment != Segment::grazing) {
          Eigen::VectorXd value = Eigen::VectorXd::Zero(1);
          light.add(x, normal, value);
          EXPECT_NEAR(value[0], segment == Segment::free ? free : 0, 1e-12 * (1 + free))
              << family.name << ", patch " << i;
        }
        const double lit = segment == Segment::free ? free : 0;
        sum += lit;
        squares += lit * lit;
      }
      // What a solid covers is not lit by a light within it, either.
      if (coverage.is_covered(static_cast<std::int32_t>(i))) {
        EXPECT_EQ(irradiance(i, 0), 0);
        continue;
      }
      // Nothing or all of a patch that is nowhere near the light: exactly.
      const double mean = sum / kPoints;
      const double sigma = std::sqrt(std::max(0., squares / kPoints - mean * mean) / kPoints);
      // 4.5 standard errors, and room for skewness and for grazing points.
      EXPECT_NEAR(irradiance(i, 0), mean, 4.5 * sigma + (6.0 + n_grazing) / kPoints * most)
          << family.name << ", patch " << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, LuminairesAmongFamilies, testing::ValuesIn(test::kFamilies));

TEST(LuminaireLight, IsTheSameHoweverTheSceneIsDivided) {
  std::mt19937_64 random(8);
  for (const test::Family family : test::kFamilies) {
    const test::FamilyScene original = test::make_family_scene(family, 3);
    Scene scene = luminaire_scene(random_web(Type::c, random));
    const Vec3 place = Vec3(0.41, 0.53, 0.47);
    double coarse = 0;
    for (const int n_patches : {10, 300}) {
      const PatchMesh mesh = meshing::make_patches(original.scene, {.n_patches = n_patches});
      scene.luminaires.clear();
      const Box3 box = bounds(mesh);
      add_luminaire(scene, box.min() + place.cwiseProduct(box.sizes()),
                    Eigen::Matrix3d::Identity());
      const double sum = total_flux(mesh, LuminaireLight(scene, mesh).irradiance().irradiance);
      if (n_patches == 10) {
        coarse = sum;
      } else {
        EXPECT_NEAR(sum, coarse, 1e-8 * flux(scene.photometries[0].web)) << original.name;
      }
    }
  }
}

TEST(LuminaireLight, IsTheSameAtAnyNumberOfThreads) {
  std::mt19937_64 random(9);
  const auto family = test::make_family_scene(test::Family::furniture, 5);
  const PatchMesh mesh = meshing::make_patches(family.scene, {.n_patches = 1000});
  Scene scene = luminaire_scene(random_web(Type::c, random));
  add_luminaire(scene, bounds(mesh).center(), random_axes(random));
  const LuminaireLight light(scene, mesh);
  const ThreadLimit one(1);
  const Eigen::MatrixXd alone = light.irradiance().irradiance;
  const ThreadLimit four(4);
  EXPECT_EQ(alone, light.irradiance().irradiance);
}

// A lamp that hangs down a wall, on it, lights the wall's front however the wall is turned: its
// axis is in the plane but for rounding.
TEST(LuminaireLight, HangsDownAWall) {
  Scene scene;
  scene.bands.kind = Bands::Kind::grey;
  scene.materials = {{"black", Eigen::VectorXd::Zero(1), {}}};
  scene.surfaces = {{"wall", 0}};
  Photometry photometry;
  photometry.web = isotropic_web(100);
  scene.photometries = {photometry};
  scene.luminaires = {Luminaire{}};
  scene.luminaires[0].watts_per_lumen = Eigen::VectorXd::Ones(1);
  for (int k = 0; k < 24; ++k) {
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(0.1 + 0.27 * k, Vec3::UnitZ()).toRotationMatrix();
    PatchMesh wall;
    wall.surface_names = {"wall"};
    for (const Vec3& corner : {Vec3(0, -1, 0), Vec3(0, 1, 0), Vec3(0, 1, 2.5), Vec3(0, -1, 2.5)}) {
      wall.vertices.emplace_back(turn * corner);
    }
    wall.add_patch({0, 1, 2, 3}, 0, 0);  // faces the turned +x
    scene.luminaires[0].position = turn * Vec3(0, 0.3, 1.7);
    const LuminaireLight light(scene, wall);
    for (const double x : {2., -2.}) {
      Eigen::VectorXd irradiance = Eigen::VectorXd::Zero(1);
      light.add(turn * Vec3(x, 0.3, 1.7), turn * Vec3(-x, 0, 0).normalized(), irradiance);
      EXPECT_NEAR(irradiance[0], x > 0 ? 25 : 0, 1e-12) << k;
    }
  }
}

// The lux on a plate at 2 m from a lamp that is tilted by any angle about any line, whose table is
// linear between 0, 60 and 90 degrees.
TEST(LuminaireLight, FollowsTheTiltOfItsLamps) {
  Scene scene;
  scene.bands.kind = Bands::Kind::grey;
  scene.materials = {{"black", Eigen::VectorXd::Zero(1), {}}};
  scene.surfaces = {{"plate", 0}};
  Photometry photometry;
  photometry.web = isotropic_web(100);
  photometry.tilt = {1, {0, kPi / 3, kPi / 2}, {1, 0.7, 0.6}};
  scene.photometries = {photometry};
  Luminaire luminaire;
  luminaire.watts_per_lumen = Eigen::VectorXd::Ones(1);
  scene.luminaires = {luminaire};
  PatchMesh far;
  far.surface_names = {"plate"};
  far.vertices = {{0, 0, -9}, {0, 1, -9}, {1, 0, -9}};
  far.add_patch({0, 1, 2, -1}, 0, 0);
  const auto lux = [&](double tilt, double turn, const Vec3& up, double lumens) {
    const Vec3 east = usual_north(up).cross(up);
    const Vec3 down = Eigen::AngleAxisd(turn, up) * Eigen::AngleAxisd(tilt, east) * -up;
    scene.luminaires[0].axes = aimed_axes(down, 0.4, up, east);
    scene.luminaires[0].up = up;
    scene.luminaires[0].lumens = lumens;
    Eigen::VectorXd irradiance = Eigen::VectorXd::Zero(1);
    LuminaireLight(scene, far).add({0, 0, 2}, {0, 0, -1}, irradiance);
    return irradiance[0];
  };
  for (const Vec3& up : {Vec3(0, 0, 1), Vec3(0, 1, 0), Vec3(0.6, 0, 0.8)}) {
    for (const double turn : {0., 1., 4.}) {
      EXPECT_NEAR(lux(0, turn, up, 0), 25, 1e-12);
      EXPECT_NEAR(lux(kPi / 6, turn, up, 0), 25 * 0.85, 1e-12);
      EXPECT_NEAR(lux(kPi / 2.4, turn, up, 0), 25 * 0.65, 1e-12);
      EXPECT_NEAR(lux(kPi / 2, turn, up, 0), 25 * 0.6, 1e-12);
      EXPECT_NEAR(lux(2.5, turn, up, 0), 25 * 0.6, 1e-12);  // beyond the table
      EXPECT_NEAR(lux(kPi / 3, turn, up, 800 * kPi), 50 * 0.7, 1e-12);
    }
  }
}

}  // namespace
}  // namespace radiosity
