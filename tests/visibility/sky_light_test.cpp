// Light of the sky: closed forms, the standard's values, openings and panes by independent
// quadrature, and the leftover of all form factors from a point.
#include "radiosity/visibility/sky_light.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <random>

#include "meshing/patches/patches.h"
#include "radiosity/base/error.h"
#include "radiosity/compressed/make_transport.h"
#include "radiosity/exchange/point_factors.h"
#include "radiosity/polygon/gauss.h"
#include "radiosity/polygon/point_to_polygon.h"
#include "radiosity/scene/solar_position.h"
#include "radiosity/solve/conditions.h"
#include "radiosity/visibility/incident_light.h"
#include "radiosity/visibility/visibility.h"
#include "tests/support/scene_families.h"
#include "tests/support/shapes.h"

namespace radiosity {
namespace {

constexpr double kDegree = kPi / 180;
/// E_h / L_z with the sun 60° high (own values; type 5 is π, type 16 is 7π/9).
constexpr std::array<double, 16> kHorizontal = {2.449540874, 2.086023206, 2.769987826, 2.315419106,
                                                kPi,         2.584160407, 2.421225261, 2.328379948,
                                                3.459323366, 3.170260466, 2.989060798, 3.190572787,
                                                3.025853071, 3.216956768, 3.015856249, 7 * kPi / 9};

Eigen::VectorXd one(double value) { return Eigen::VectorXd::Constant(1, value); }

Sky make_sky(int type, const Vec3& up = Vec3::UnitZ(), double azimuth = 0,
             double height = 60 * kDegree) {
  Sky sky;
  sky.distribution = cie_sky(type);
  sky.up = up;
  sky.towards_sun = -sun_direction(azimuth, height, up, usual_north(up));
  sky.zenith_radiance = one(1);
  sky.ground_reflectance = one(0);
  return sky;
}

/// A grey scene with that sky, of nothing yet.
Scene scene_with(const Sky& sky) {
  Scene scene;
  scene.bands.kind = Bands::Kind::grey;
  Material black;
  black.reflectance = one(0);
  scene.materials.push_back(black);
  scene.sky = sky;
  return scene;
}

void add_quad(Scene& scene, const Vec3& a, const Vec3& u, const Vec3& v, int material = 0) {
  const auto first = static_cast<std::int32_t>(scene.vertices.size());
  scene.vertices.insert(scene.vertices.end(), {a, a + u, a + u + v, a + v});
  scene.surfaces.push_back({"s" + std::to_string(scene.surfaces.size()), material});
  scene.add_polygon(std::array{first, first + 1, first + 2, first + 3},
                    static_cast<std::int32_t>(scene.surfaces.size()) - 1);
}

/// A black box without the part of its ceiling between the corners low and high of the unit
/// square, all of it moved by `motion`; the ceiling's rest is four quads.
Scene box_with_opening(const Sky& sky, const Eigen::Isometry3d& motion, double low, double high) {
  Scene scene = scene_with(sky);
  const Vec3 x = Vec3::UnitX();
  const Vec3 y = Vec3::UnitY();
  const Vec3 z = Vec3::UnitZ();
  add_quad(scene, Vec3::Zero(), x, y);
  add_quad(scene, Vec3::Zero(), z, x);
  add_quad(scene, x, z, y);
  add_quad(scene, x + y, z, -x);
  add_quad(scene, y, z, -y);
  add_quad(scene, z, low * y, x);
  add_quad(scene, Vec3(0, high, 1), (1 - high) * y, x);
  add_quad(scene, Vec3(0, low, 1), (high - low) * y, low * x);
  add_quad(scene, Vec3(high, low, 1), (high - low) * y, (1 - high) * x);
  for (Vec3& vertex : scene.vertices) vertex = motion * vertex;
  return scene;
}

/// ∫ L τ cosθ cosθ' / r² dA over a parallelogram, by a product rule of 32 points a direction on
/// each of 8 x 8 parts.
template <typename Factor>
double over_opening(const Sky& sky, const Vec3& point, const Vec3& normal, const Vec3& a,
                    const Vec3& u, const Vec3& v, const Factor& factor) {
  constexpr int kParts = 8;
  const Vec3 across = u.cross(v);
  double sum = 0;
  for (int i = 0; i < kParts; ++i) {
    for (int k = 0; k < kParts; ++k) {
      for (const GaussPoint& s : gauss_rule(kMaxGaussOrder)) {
        for (const GaussPoint& t : gauss_rule(kMaxGaussOrder)) {
          const Vec3 way = a + (i + s.x) / kParts * u + (k + t.x) / kParts * v - point;
          const Vec3 direction = way.normalized();
          const double cosine = std::abs(across.normalized().dot(direction));
          sum += s.weight * t.weight / (kParts * kParts) * across.norm() * cosine /
                 way.squaredNorm() * normal.dot(direction) * sky.ratio(direction) * factor(cosine);
        }
      }
    }
  }
  return sum;
}

TEST(Sky, StandardTypesHaveTheirHorizontalIlluminance) {
  for (int type = 1; type <= 16; ++type) {
    for (const Vec3& up : {Vec3(0, 0, 1), Vec3(0, 1, 0), Vec3(1, -2, 2).normalized().eval()}) {
      const Sky sky = make_sky(type, up, 0.4 * type);
      EXPECT_NEAR(horizontal_ratio(sky) / kHorizontal[type - 1], 1, 1e-8) << type;
      EXPECT_NEAR(sky.ratio(up), 1, 1e-14);
    }
  }
  EXPECT_THROW(cie_sky(0), SceneError);
  EXPECT_THROW(cie_sky(17), SceneError);
}

TEST(Sky, DependsOnTheAnglesFromZenithAndSunAlone) {
  const Sky sky = make_sky(12);
  const Vec3 towards_sun = sky.towards_sun;
  // Of what is as far from the zenith, the part towards the sun is brighter, by the formula.
  const double cos_zenith = towards_sun.z();
  const double opposite = 2 * cos_zenith * cos_zenith - 1;  // cosine between sun and its opposite
  const double chi = std::acos(opposite);
  const double f =
      1 + 10 * (std::exp(-3 * chi) - std::exp(-3 * kPi / 2)) + .45 * opposite * opposite;
  const double f_sun = 1 + 10 * (1 - std::exp(-3 * kPi / 2)) + .45;
  const Vec3 other(-towards_sun.x(), -towards_sun.y(), towards_sun.z());
  EXPECT_NEAR(sky.ratio(other) / sky.ratio(towards_sun), f / f_sun, 1e-12);
}

TEST(Sky, PerezIsThatOfItsAuthors) {
  // gendaylit -ang 60 0 -W 700 150: epsilon 5.0600, delta 0.1223
  EXPECT_NEAR(sky_clearness(150, 700, 30 * kDegree), 5.06, 5e-5);
  const SkyDistribution sky = perez_sky(5.06, 0.1223, 30 * kDegree);
  EXPECT_NEAR(sky.a, -0.960276, 2e-6);
  EXPECT_NEAR(sky.b, -0.217961, 2e-6);
  EXPECT_NEAR(sky.c, 16.411853, 2e-5);
  EXPECT_NEAR(sky.d, -3.922889, 2e-6);
  EXPECT_NEAR(sky.e, 0.642466, 5e-6);
  EXPECT_NEAR(sky_brightness(150, 0, 1367), 150. / 1367, 1e-4);
  // Every range of clearness gives a sky that is somewhere.
  for (const double clearness : {1.0, 1.1, 1.3, 1.7, 2.2, 3.5, 5.0, 9.0}) {
    Sky all_weather = make_sky(5);
    all_weather.distribution = perez_sky(clearness, 0.2, 30 * kDegree);
    EXPECT_GT(horizontal_ratio(all_weather), 0) << clearness;
  }
}

TEST(Sky, SunStandsWhereAlmanacsSay) {
  // Reda & Andreas 2004 (SPA), 17 October 2003, 12:30:30 in Golden, Colorado, without refraction.
  const SolarPosition sun =
      solar_position({39.742476 * kDegree, -105.1786 * kDegree, 2003, 10, 17, 19 + 30.5 / 60});
  EXPECT_NEAR(sun.elevation / kDegree, 39.87205, 0.01);
  EXPECT_NEAR(sun.azimuth / kDegree, 194.34024, 0.01);
  // At the solstice it culminates at 90° - latitude + obliquity, in the south.
  const SolarPosition june = solar_position({50 * kDegree, 0, 2026, 6, 21, 12.03});
  EXPECT_NEAR(june.elevation / kDegree, 90 - 50 + 23.44, 0.02);
  EXPECT_NEAR(june.azimuth / kDegree, 180, 0.5);
}

TEST(SkyLight, UniformSkyAndGroundOnTiltedPlanes) {
  Sky sky = make_sky(5);
  sky.ground_reflectance = one(0.4);
  Scene scene = scene_with(sky);
  add_quad(scene, Vec3(50, 50, 0), Vec3(0.1, 0, 0), Vec3(0, 0.1, 0));
  const PatchMesh mesh = meshing::make_patches(scene);
  const SkyLight light(scene, mesh);
  for (const double tilt : {0., 0.3, kPi / 2, 2., kPi}) {
    // The plate is seen edge-on and hides nothing.
    const SkyIrradiance there = light.at(Vec3::Zero(), Vec3(std::sin(tilt), 0, std::cos(tilt)));
    EXPECT_NEAR(there.sky[0], kPi * (1 + std::cos(tilt)) / 2, 1e-12) << tilt;
    EXPECT_NEAR(there.ground[0], 0.4 * kPi * (1 - std::cos(tilt)) / 2, 1e-12) << tilt;
  }
}

TEST(SkyLight, EvenLightIsWhatFormFactorsLeaveOver) {
  // A ground of reflectance 1 below a uniform sky is as bright as that: E = π L F(sky).
  std::mt19937_64 random(20261127);
  int n = 0;
  for (const test::Family family : test::kFamilies) {
    Scene scene = test::make_family_scene(family, 3).scene;
    Sky sky = make_sky(5, test::random_unit(random));
    sky.ground_reflectance = one(1);
    sky.zenith_radiance = Eigen::VectorXd::Constant(scene.bands.count(), 1);
    sky.ground_reflectance = Eigen::VectorXd::Constant(scene.bands.count(), 1);
    scene.sky = sky;
    const PatchMesh mesh = meshing::make_patches(scene, {.n_patches = 60});
    const SkyLight light(scene, mesh);
    std::uniform_int_distribution<Index> any(0, mesh.size() - 1);
    for (int k = 0; k < 4; ++k) {
      const Index i = any(random);
      const Vec3 point = mesh.centroid[i];
      const double expected = kPi * point_factors(mesh, point, mesh.normal[i]).sky;
      // Some hundred pieces with a few roundings each; silhouettes that coincide leave slivers.
      EXPECT_NEAR(light.at(point, mesh.normal[i]).sum()[0], expected, 1e-9)
          << test::family_name(family) << " patch " << i;
      n += expected > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(n, 20);
}

TEST(SkyLight, ThroughAnOpeningAsIntegratedOverIt) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(0.1, 0.9);
  for (const int type : {1, 4, 9, 12, 15, 16}) {
    Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
    motion.translate(Vec3(3, -8, 2));
    motion.rotate(Eigen::AngleAxisd(0.3 * type, Vec3::UnitZ()));
    // The sun may be seen through the opening, where the sky has its peak.
    const Sky sky = make_sky(type, Vec3::UnitZ(), 0.5 * type, (40 + 3 * type) * kDegree);
    const Scene scene = box_with_opening(sky, motion, 0.25, 0.75);
    const PatchMesh mesh = meshing::make_patches(scene, {.max_edge = 0.6});
    const SkyLight light(scene, mesh);
    for (int k = 0; k < 3; ++k) {
      const Vec3 point = motion * Vec3(uniform(random), uniform(random), 0);
      const SkyIrradiance there = light.at(point, Vec3::UnitZ());
      const double expected =
          over_opening(sky, point, Vec3::UnitZ(), motion * Vec3(0.25, 0.25, 1),
                       motion.linear() * Vec3(0, 0.5, 0), motion.linear() * Vec3(0.5, 0, 0),
                       [](double) { return 1; });
      // Over the peak of the sky the product rule itself is off by 1e-6.
      EXPECT_NEAR(there.sky[0], expected, 3e-6 * horizontal_ratio(sky)) << type;
      EXPECT_LE(there.error, 1e-6 * horizontal_ratio(sky) * 2 * kPi / kPi);
      EXPECT_EQ(there.ground[0], 0);
    }
  }
}

TEST(SkyLight, PatchesHaveTheMeanOfTheirPoints) {
  const Sky sky = make_sky(9, Vec3::UnitZ(), 1.1);
  const Scene scene = box_with_opening(sky, Eigen::Isometry3d::Identity(), 0.3, 0.6);
  const PatchMesh mesh = meshing::make_patches(scene, {.max_edge = 0.5});
  const PatchMesh finer = meshing::make_patches(scene, {.max_edge = 0.126});
  const PatchSkyIrradiance coarse = SkyLight(scene, mesh).on_patches();
  const PatchSkyIrradiance fine = SkyLight(scene, finer).on_patches();
  // The same light by polygon, whatever the patches.
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(scene.n_polygons());
  Eigen::VectorXd errors = Eigen::VectorXd::Zero(scene.n_polygons());
  for (Index i = 0; i < mesh.size(); ++i) {
    sums[mesh.polygon[i]] += mesh.area[i] * coarse.irradiance(i, 0);
    errors[mesh.polygon[i]] += mesh.area[i] * coarse.error[i];
  }
  for (Index i = 0; i < finer.size(); ++i) {
    sums[finer.polygon[i]] -= finer.area[i] * fine.irradiance(i, 0);
    errors[finer.polygon[i]] += finer.area[i] * fine.error[i];
  }
  for (Index p = 0; p < sums.size(); ++p) {
    EXPECT_LE(std::abs(sums[p]), errors[p] + 1e-12) << p;
  }
  // All that comes in through the opening arrives: the sky's E_h times its area.
  double arrived = 0;
  for (Index i = 0; i < finer.size(); ++i) arrived += finer.area[i] * fine.irradiance(i, 0);
  const double outside = horizontal_ratio(sky) * (0.3 * 0.3);
  EXPECT_NEAR(arrived, outside, errors.sum() + 1e-6);
  EXPECT_LT(errors.sum(), 2e-3 * outside);
}

TEST(SkyLight, EnvironmentIsAnEvenSkyAndGround) {
  Sky sky = make_sky(5);
  sky.ground_reflectance = one(1);
  const Scene scene = box_with_opening(sky, Eigen::Isometry3d::Identity(), 0.2, 0.9);
  const PatchMesh mesh = meshing::make_patches(scene, {.max_edge = 0.3});
  const PatchSkyIrradiance light = SkyLight(scene, mesh).on_patches();
  const Visibility visibility(mesh);
  const auto transport = make_transport(mesh, visibility, {.closed = Closed::no});
  const Eigen::MatrixXd expected = environment_irradiance(*transport, one(kPi));
  for (Index i = 0; i < mesh.size(); ++i) {
    // Nothing stands between patches of a convex room: their factors are exact to 1e-9 or so each.
    EXPECT_NEAR(light.irradiance(i, 0), expected(i, 0), light.error[i] + 1e-6) << i;
  }
  EXPECT_TRUE(incident_irradiance(scene, mesh).isApprox(light.irradiance, 1e-15));
}

TEST(Glazing, FresnelByTheAngle) {
  const Glazing glass{.refractive_index = 1.52, .transmittance = one(0.96)};
  const double r = std::pow(0.52 / 2.52, 2);
  EXPECT_NEAR(glass.at(1, 0), 0.96 * (1 - r) / (1 + r), 1e-15);
  EXPECT_EQ(glass.at(-1, 0), glass.at(1, 0));
  EXPECT_NEAR(glass.at(0, 0), 0, 1e-15);
  EXPECT_LT(glass.at(0.3, 0), glass.at(0.5, 0));
  // At Brewster's angle one polarisation passes whole.
  const double brewster = std::atan(1.52);
  const double s = std::pow((1 - 1.52 * 1.52) / (1 + 1.52 * 1.52), 2);
  EXPECT_NEAR(glass.at(std::cos(brewster), 0), 0.96 * 0.5 * (1 + (1 - s) / (1 + s)), 1e-14);
  const Glazing even{.transmittance = one(0.7)};
  EXPECT_EQ(even.at(0.1, 0), 0.7);
  const Glazing thick{.refractive_index = 1.5, .transmittance = one(0.5), .is_by_thickness = true};
  const double refracted = std::sqrt(1 - 0.75 / 2.25);
  Glazing thin = thick;
  thin.is_by_thickness = false;
  EXPECT_NEAR(thick.at(0.5, 0) / thin.at(0.5, 0), std::pow(0.5, 1 / refracted - 1), 1e-14);
}

/// The box with its opening closed by a pane, and one above it if there are two.
Scene glazed_box(const Sky& sky, int n_panes) {
  Scene scene = box_with_opening(sky, Eigen::Isometry3d::Identity(), 0.25, 0.75);
  Material glass = scene.materials.front();
  glass.glazing = Glazing{1.52, one(0.96)};
  scene.materials.push_back(glass);
  for (int k = 0; k < n_panes; ++k) {
    // The second is wider, so that nothing passes beside it.
    const double wide = 4. * k;
    add_quad(scene, Vec3(0.25 - wide, 0.25 - wide, 1 + 0.1 * k), Vec3(0, 0.5 + 2 * wide, 0),
             Vec3(0.5 + 2 * wide, 0, 0), 1);
  }
  return scene;
}

TEST(Glazing, PanesPassTheSkyByTheirAngle) {
  const Sky sky = make_sky(11, Vec3::UnitZ(), 2.);
  const Vec3 point(0.3, 0.8, 0);
  const Glazing glass{1.52, one(0.96)};
  for (const int n_panes : {1, 2}) {
    const Scene scene = glazed_box(sky, n_panes);
    const PatchMesh mesh = meshing::make_patches(scene, {.max_edge = 3});
    const double expected =
        over_opening(sky, point, Vec3::UnitZ(), Vec3(0.25, 0.25, 1), Vec3(0, 0.5, 0),
                     Vec3(0.5, 0, 0), [&](double c) { return std::pow(glass.at(c, 0), n_panes); });
    EXPECT_NEAR(SkyLight(scene, mesh).at(point, Vec3::UnitZ()).sky[0], expected, 1e-5) << n_panes;
  }
}

TEST(Glazing, PanesPassTheSunByItsAngle) {
  Sky sky = make_sky(5);
  sky.zenith_radiance = one(0);
  for (const int n_panes : {1, 2}) {
    Scene glazed = glazed_box(sky, n_panes);
    Scene open = box_with_opening(sky, Eigen::Isometry3d::Identity(), 0.25, 0.75);
    const Vec3 direction = Vec3(0.2, -0.3, -1).normalized();
    for (Scene* scene : {&glazed, &open}) {
      scene->sky.reset();
      scene->sun = Sun{direction, one(800)};
    }
    const PatchMesh glazed_mesh = meshing::make_patches(glazed, {.max_edge = 0.3});
    const PatchMesh open_mesh = meshing::make_patches(open, {.max_edge = 0.3});
    const Eigen::MatrixXd with = incident_irradiance(glazed, glazed_mesh);
    const Eigen::MatrixXd without = incident_irradiance(open, open_mesh);
    const double tau = std::pow(Glazing{1.52, one(0.96)}.at(direction.z(), 0), n_panes);
    for (Index i = 0; i < open_mesh.size(); ++i) {
      EXPECT_NEAR(with(i, 0), tau * without(i, 0), 1e-9) << i;
    }
    EXPECT_GT(without.topRows(open_mesh.size()).maxCoeff(), 500);
    const IncidentLight light(glazed, glazed_mesh);
    Eigen::VectorXd there = Eigen::VectorXd::Zero(1);
    light.add(Vec3(0.7, 0.2, 0), Vec3::UnitZ(), there);
    EXPECT_NEAR(there[0], 800 * tau * -direction.z(), 1e-9);
  }
}

}  // namespace
}  // namespace radiosity
