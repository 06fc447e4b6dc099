// Daylight at points and in the hours of a year: laws, and one way beside the other.
#include "study/daylight.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "radiosity/base/error.h"
#include "radiosity/visibility/incident_light.h"
#include "radiosity/visibility/sky_light.h"
#include "study/daylight_year.h"

namespace {

using namespace radiosity;

Eigen::VectorXd one(double value) { return Eigen::VectorXd::Constant(1, value); }

void add_quad(Scene& scene, const Vec3& a, const Vec3& u, const Vec3& v, int material) {
  const auto first = static_cast<std::int32_t>(scene.vertices.size());
  scene.vertices.insert(scene.vertices.end(), {a, a + u, a + u + v, a + v});
  Surface surface;
  surface.name = "s" + std::to_string(scene.surfaces.size());
  surface.material = material;
  scene.surfaces.push_back(surface);
  scene.add_polygon(std::array{first, first + 1, first + 2, first + 3},
                    static_cast<std::int32_t>(scene.surfaces.size()) - 1);
}

/// A box of 2 x 1 x 1 m below a sky, without its wall x = 0, which is a pane if it shall be glazed.
Scene open_box(double reflectance, double ground, bool is_glazed = false) {
  Scene scene;
  scene.bands.kind = Bands::Kind::grey;
  Material wall;
  wall.reflectance = one(reflectance);
  Material glass = wall;
  glass.reflectance = one(0);
  glass.glazing = Glazing{1.52, one(0.9)};
  scene.materials = {wall, glass};
  const Vec3 x(2, 0, 0);
  const Vec3 y(0, 1, 0);
  const Vec3 z(0, 0, 1);
  add_quad(scene, Vec3::Zero(), x, y, 0);
  add_quad(scene, z, y, x, 0);
  add_quad(scene, Vec3::Zero(), z, x, 0);
  add_quad(scene, y, x, z, 0);
  add_quad(scene, x, z, y, 0);
  if (is_glazed) add_quad(scene, Vec3::Zero(), y, z, 1);
  Sky sky;
  sky.distribution = cie_sky(5);
  sky.zenith_radiance = one(1);
  sky.ground_reflectance = one(ground);
  scene.sky = sky;
  return scene;
}

const std::vector<study::DaylightPoint> kPoints = {{Vec3(0.3, 0.5, 0), Vec3::UnitZ()},
                                                   {Vec3(1.7, 0.4, 0.5), Vec3::UnitZ()},
                                                   {Vec3(1, 0.6, 0.2), Vec3(-1, 0, 0)}};

study::SkyHour hour_of(int type, double azimuth, double height, double diffuse, double direct) {
  study::SkyHour hour;
  hour.distribution = cie_sky(type);
  hour.towards_sun = -sun_direction(azimuth, height, Vec3::UnitZ(), Vec3::UnitY());
  hour.diffuse = diffuse;
  hour.direct = direct;
  return hour;
}

study::Study assembled(Scene scene, double max_edge) {
  return study::assemble(std::move(scene), {.patches = {.max_edge = max_edge}, .tolerance = 1e-4});
}

TEST(SkyParts, CoverTheSky) {
  for (const auto& [asked, made] : {std::pair{145, 144}, {577, 576}, {4, 4}, {10, 16}}) {
    const study::SkyParts parts = study::make_sky_parts(Vec3(1, 2, -2).normalized(), asked);
    ASSERT_EQ(parts.size(), made);
    double solid_angle = 0;
    double section = 0;
    for (Index k = 0; k < parts.size(); ++k) {
      solid_angle += parts.solid_angles[k];
      section += parts.sections[k];
    }
    EXPECT_NEAR(solid_angle, 2 * kPi, 1e-11);
    EXPECT_NEAR(section, kPi, 1e-11);
  }
}

TEST(DaylightFactors, KnowNoOtherLight) {
  Scene scene = open_box(0.5, 0.2);
  scene.sun = Sun{-Vec3::UnitZ(), one(800)};
  scene.materials[0].emission = {Emission::Kind::exitance, one(50)};
  scene.photometries.emplace_back();
  scene.luminaires.emplace_back();
  const Scene by_day = study::daylight_scene(scene);
  EXPECT_FALSE(by_day.sun);
  EXPECT_TRUE(by_day.luminaires.empty());
  for (const Surface& surface : by_day.surfaces) EXPECT_EQ(surface.emission_factor, 0);
}

TEST(DaylightFactors, AddUpToOneInAWhiteFurnace) {
  Scene scene = open_box(1, 1);
  const study::Study box =
      study::run(study::daylight_scene(scene), {.patches = {.max_edge = 0.25}, .tolerance = 1e-4});
  const auto factors = study::daylight_factors(box, kPoints, {"s0"}, one(1));
  for (const study::DaylightFactor& there : factors) {
    // Means over patches are good to 1e-3, which more light of the same error is added to.
    EXPECT_NEAR(there.total(), 1, 3e-3);
  }
  EXPECT_EQ(factors[1].sky + factors[1].external + factors[1].internal, factors[1].total());
  EXPECT_THROW(study::daylight_factors(box, kPoints, {"none"}, one(1)), SceneError);
  scene.sky->zenith_radiance = one(0);
  EXPECT_THROW(study::daylight_scene(scene), SceneError);
  scene.sky.reset();
  EXPECT_THROW(study::daylight_scene(scene), SceneError);
}

TEST(DaylightYear, AWhiteFurnaceStaysEvenAllDay) {
  const study::Study box = assembled(open_box(1, 1), 0.25);
  const auto coefficients = study::daylight_coefficients(box, kPoints, one(1));
  const std::vector<study::SkyHour> hours = {hour_of(5, 1, 0.5, 100, 0), hour_of(5, 2, 0.5, 37, 0)};
  const Eigen::MatrixXd light =
      study::irradiance_in_hours(box, coefficients, kPoints, hours, one(1));
  for (Index p = 0; p < light.cols(); ++p) {
    EXPECT_NEAR(light(0, p), 100, 0.5);  // a rule of four points a patch
    EXPECT_NEAR(light(1, p) / light(0, p), 0.37, 1e-12);
  }
}

TEST(DaylightYear, ApproachesDaylightFactorsWithMoreParts) {
  for (const int type : {16, 10}) {
    for (const bool is_glazed : {type == 16}) {
      Scene scene = open_box(0.5, 0.3, is_glazed);
      const study::SkyHour hour = hour_of(type, -2.2, 0.6, 1, 0);
      scene.sky->distribution = hour.distribution;
      scene.sky->towards_sun = hour.towards_sun;
      const study::Study solved = study::run(study::daylight_scene(scene),
                                             {.patches = {.max_edge = 0.5}, .tolerance = 1e-4});
      const auto factors = study::daylight_factors(solved, kPoints, {}, one(1));
      const study::Study box = assembled(scene, 0.5);
      std::array<double, 2> worst = {0, 0};
      for (const int k : {0, 1}) {
        const auto coefficients =
            study::daylight_coefficients(box, kPoints, one(1), {.n_parts = k == 0 ? 17 : 145});
        const Eigen::MatrixXd light =
            study::irradiance_in_hours(box, coefficients, kPoints, std::array{hour}, one(1));
        for (Index p = 0; p < light.cols(); ++p) {
          const double whole = factors[static_cast<std::size_t>(p)].total();
          worst[k] = std::max(worst[k], std::abs(light(0, p) / whole - 1));
        }
      }
      // What an even part costs goes with its solid angle, a ninth, where the sky is smooth; 3e-3
      // is the rule on patches.
      EXPECT_LT(worst[1], worst[0] / 4 + 3e-3) << type << " " << is_glazed;
      EXPECT_LT(worst[1], 0.03) << type << " " << is_glazed;
    }
  }
}

TEST(DaylightYear, TheSunIsExactWhereNothingReflects) {
  for (const bool is_glazed : {false, true}) {
    Scene scene = open_box(0, 0, is_glazed);
    const study::Study box = assembled(scene, 0.5);
    const auto coefficients = study::daylight_coefficients(box, kPoints, one(1), {.n_parts = 37});
    std::vector<study::SkyHour> hours;
    for (int k = 0; k < 40; ++k) hours.push_back(hour_of(5, 0.16 * k, 0.05 + 0.03 * k, 0, 800));
    const Eigen::MatrixXd light =
        study::irradiance_in_hours(box, coefficients, kPoints, hours, one(1));
    int n_lit = 0;
    for (std::size_t h = 0; h < hours.size(); ++h) {
      scene.sky.reset();
      scene.sun = Sun{-hours[h].towards_sun, one(800)};
      const IncidentLight sun(scene, box.mesh);
      for (std::size_t p = 0; p < kPoints.size(); ++p) {
        Eigen::VectorXd expected = Eigen::VectorXd::Zero(1);
        sun.add(kPoints[p].position, kPoints[p].normal, expected);
        EXPECT_NEAR(light(static_cast<Index>(h), static_cast<Index>(p)), expected[0], 1e-9);
        n_lit += expected[0] > 0 ? 1 : 0;
      }
    }
    EXPECT_GT(n_lit, 5);
  }
}

}  // namespace
