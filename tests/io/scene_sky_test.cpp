// Skies, glazing and weather of JSON scenes: what is read, what is written, what is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "io/scene/epw_file.h"
#include "io/scene/scene_file.h"
#include "io/scene/scene_writer.h"
#include "radiosity/base/error.h"
#include "radiosity/solve/quantity.h"
#include "radiosity/visibility/sky_light.h"
#include "tests/support/scratch_files.h"

namespace {

using namespace radiosity;

class SceneSky : public ScratchFiles {
 protected:
  std::filesystem::path scene(const std::string& sky, const std::string& head = "",
                              const std::string& material = R"("reflectance": 0.5)") const {
    return file("sky.json", "{" + head + R"("materials": {"m": {)" + material +
                                R"(}}, "surfaces": [{"name": "s", "material": "m",
      "polygons": [[[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]]}])" +
                                (sky.empty() ? "" : R"(, "sky": )" + sky) + "}");
  }
  /// A weather file of the hours given, of one place.
  std::filesystem::path weather(const std::vector<std::string>& hours) const {
    std::string text =
        "LOCATION,Nowhere,-,-,made up,0,50.0,10.0,1.0,100\n"
        "DESIGN CONDITIONS,0\nTYPICAL/EXTREME PERIODS,0\nGROUND TEMPERATURES,0\n"
        "HOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0\nCOMMENTS 1,made for this project\nCOMMENTS 2,\n"
        "DATA PERIODS,1,1,Data,Sunday,1/1,12/31\n";
    for (const std::string& hour : hours) text += hour + "\n";
    return file("made.epw", text);
  }
  static std::string hour(int month, int day, int hour, const std::string& direct,
                          const std::string& diffuse) {
    return "2001," + std::to_string(month) + "," + std::to_string(day) + "," +
           std::to_string(hour) + ",60,?9,20,10,50,101300,0,1300,300,500," + direct + "," +
           diffuse + ",50000,80000,15000,4000,180,2,5,5,20,7777,9,999,0,0,0,0,0,0,0";
  }
};

TEST_F(SceneSky, AmountsAreOfTheZenithOrOfAnOpenPlane) {
  const Scene zenith = io::read_scene(scene(R"({"type": 16, "zenith_radiance": 20})"));
  ASSERT_TRUE(zenith.sky);
  EXPECT_EQ(zenith.sky->zenith_radiance, Eigen::Vector3d::Constant(20));
  EXPECT_EQ(zenith.sky->ground_reflectance, Eigen::Vector3d::Constant(0.2));
  const Scene lux = io::read_scene(
      scene(R"({"type": 16, "horizontal_illuminance": 10000, "ground_reflectance": 0.1})"));
  const Eigen::VectorXd weights = luminous_weights(lux.bands);
  EXPECT_NEAR(weights.dot(horizontal_irradiance(*lux.sky)), 10000, 1e-4);
  EXPECT_EQ(lux.sky->ground_reflectance[0], 0.1);
  const Scene luminance = io::read_scene(scene(R"({"type": 5, "zenith_luminance": 3000})"));
  EXPECT_NEAR(weights.dot(luminance.sky->zenith_radiance), 3000, 1e-9);
  const Scene watts = io::read_scene(
      scene(R"({"type": 12, "horizontal_irradiance": 120, "azimuth_deg": 90, "elevation_deg": 30})",
            R"("bands": "solar-infrared", )", R"("solar": {"absorptivity": 0.2},
            "infrared": {"emissivity": 0.9})"));
  EXPECT_NEAR(horizontal_irradiance(*watts.sky)[0], 120, 1e-5);
  EXPECT_EQ(watts.sky->zenith_radiance[1], 0);
  EXPECT_NEAR(watts.sky->towards_sun.x(), std::cos(kPi / 6), 1e-12);
}

TEST_F(SceneSky, TheSunIsGivenOnce) {
  const char* sun = R"("sun": {"azimuth_deg": 180, "elevation_deg": 45, "irradiance": 1}, )";
  const Scene both = io::read_scene(scene(R"({"type": 12, "zenith_radiance": 1})", sun));
  EXPECT_NEAR(both.sky->towards_sun.dot(-both.sun->direction), 1, 1e-15);
  EXPECT_CONTAINS(error_of(scene(R"({"type": 12, "zenith_radiance": 1, "azimuth_deg": 1,
                                  "elevation_deg": 2})",
                                 sun)),
                  "\"sun\"");
  const Scene by_time = io::read_scene(
      scene(R"({"type": 12, "zenith_radiance": 1, "latitude": 39.742476, "longitude": -105.1786,
                "time": "2003-10-17T12:30:30-07:00"})"));
  EXPECT_NEAR(std::asin(by_time.sky->towards_sun.z()) * 180 / kPi, 39.872, 0.01);
}

TEST_F(SceneSky, AllWeatherBringsItsSun) {
  const Scene read =
      io::read_scene(scene(R"({"perez": {"direct_normal": 700, "diffuse_horizontal": 150},
                "azimuth_deg": 180, "elevation_deg": 60})",
                           R"("bands": "grey", )"));
  ASSERT_TRUE(read.sun);
  EXPECT_EQ(read.sun->irradiance[0], 700);
  EXPECT_NEAR(horizontal_irradiance(*read.sky)[0], 150, 1e-5);
  EXPECT_EQ(read.sky->distribution.kind, SkyDistribution::Kind::perez);
}

TEST_F(SceneSky, OfAnHourOfWeather) {
  (void)weather(
      {hour(6, 21, 12, "600", "200"), hour(6, 21, 13, "9999", "200"), hour(12, 21, 23, "0", "10")});
  const auto of_hour = [&](int month, int h) {
    return scene(R"({"weather": {"file": "made.epw", "month": )" + std::to_string(month) +
                     R"(, "day": 21, "hour": )" + std::to_string(h) + "}}",
                 R"("bands": "grey", )");
  };
  const Scene noon = io::read_scene(of_hour(6, 12));
  ASSERT_TRUE(noon.sun);
  EXPECT_EQ(noon.sun->irradiance[0], 600);
  EXPECT_NEAR(horizontal_irradiance(*noon.sky)[0], 200, 1e-5);
  // 11:30 by the clock of 15° east is 11:08 by the sun at 10° east: 13° before noon.
  EXPECT_NEAR(std::asin(noon.sky->towards_sun.z()) * 180 / kPi, 61.57, 0.1);
  EXPECT_EQ(noon.warnings.size(), 2U);
  EXPECT_CONTAINS(noon.warnings[0], "has 3 hours");
  EXPECT_CONTAINS(noon.warnings[1], "1 hours have no direct");
  EXPECT_EQ(noon.files.size(), io::read_scene(scene("")).files.size() + 1);
  EXPECT_CONTAINS(error_of(of_hour(6, 13)), "no direct normal radiation");
  EXPECT_CONTAINS(error_of(of_hour(6, 14)), "no hour 14");
  EXPECT_CONTAINS(error_of(of_hour(12, 23)), "not above the horizon");
}

TEST_F(SceneSky, WeatherFilesWithFaults) {
  const auto fault = [&](const std::filesystem::path& path) -> std::string {
    try {
      (void)io::read_epw(path);
    } catch (const SceneError& thrown) {
      return thrown.what();
    }
    return "";
  };
  EXPECT_CONTAINS(fault(weather({"2001,6,21,12,60,?"})), "made.epw:9: has 6 fields");
  EXPECT_CONTAINS(fault(weather({hour(6, 21, 12, "much", "200")})), "is \"much\"");
  EXPECT_CONTAINS(fault(weather({hour(6, 21, 12, "-3", "200")})), "no negative");
  EXPECT_CONTAINS(fault(weather({hour(13, 21, 12, "3", "200")})), "out of range");
  EXPECT_CONTAINS(fault(weather({})), "no hours");
  EXPECT_CONTAINS(fault(file("other.epw", "hello\n")), "LOCATION");
}

TEST_F(SceneSky, BadInputIsTold) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {R"({"type": 0, "zenith_radiance": 1})", "1 to 16"},
      {R"({"type": 17, "zenith_radiance": 1})", "1 to 16"},
      {R"({"type": 2.5, "zenith_radiance": 1})", "1 to 16"},
      {R"({"type": 5})", "expected one of zenith_radiance"},
      {R"({"type": 12, "zenith_radiance": 1, "latitude": 50, "longitude": 0,
           "time": "2026-02-31T12:00Z"})",
       "expected a time like"},
      {R"({"weather": {"file": "made.epw", "month": 6, "day": 21, "hour": 12.5}})",
       "12.5 is no whole number"},
      {R"({"type": 5, "zenith_radiance": -1})", "zenith_radiance"},
      {R"({"type": 5, "zenith_radiance": 1e308})", "zenith of 1e+308 W/(m² sr), expected at most"},
      {R"({"type": 5, "horizontal_illuminance": 1e305})", "expected at most 1e+100"},
      {R"({"type": 5, "zenith_luminance": -1})", "no negative number"},
      {R"({"type": 5, "zenith_radiance": 1, "horizontal_irradiance": 1})", "both"},
      {R"({"type": 5, "perez": {}, "zenith_radiance": 1})", "expected one of type"},
      {R"({"zenith_radiance": 1})", "expected one of type"},
      {R"({"type": 12, "zenith_radiance": 1})", "depends on the sun"},
      {R"({"type": 12, "zenith_radiance": 1, "azimuth_deg": 0, "elevation_deg": -3})",
       "not above the horizon"},
      {R"({"type": 12, "zenith_radiance": 1, "azimuth_deg": 0})", "elevation_deg"},
      {R"({"type": 12, "zenith_radiance": 1, "latitude": 50, "longitude": 10,
           "time": "noon"})",
       "expected a time like"},
      {R"({"type": 12, "zenith_radiance": 1, "latitude": 95, "longitude": 10,
           "time": "2026-06-21T12:00Z"})",
       "[-90, 90]"},
      {R"({"type": 5, "zenith_radiance": 1, "ground_reflectance": 1.2})", "ground_reflectance"},
      {R"({"perez": {"direct_normal": 700, "diffuse_horizontal": 150}})", "needs the sun"},
      {R"({"perez": {"direct_normal": 700, "diffuse_horizontal": 0}, "azimuth_deg": 0,
           "elevation_deg": 50})",
       "needs diffuse light"},
      {R"({"type": 5, "zenith_radiance": 1, "sunny": true})", "sunny"},
      {R"({"distribution": {"form": "cie", "a": 1, "b": 1, "c": 0, "d": 0, "e": 0},
           "zenith_radiance": 1})",
       "infinitely bright"}};
  for (const auto& [sky, told] : cases) {
    const std::string message = error_of(scene(sky));
    EXPECT_CONTAINS(message, "sky.json");
    EXPECT_CONTAINS(message, told);
  }
  EXPECT_CONTAINS(error_of(scene(R"({"type": 5, "zenith_radiance": 1})",
                                 R"("environment": {"radiance": 1}, )")),
                  "environment");
  EXPECT_CONTAINS(error_of(scene(R"({"type": 5, "zenith_radiance": 1})",
                                 R"("symmetry": {"mirror": ["x=5"]}, )")),
                  "symmetry");
  EXPECT_CONTAINS(
      error_of(scene(R"({"type": 5, "zenith_luminance": 1})", R"("bands": [500, 600], )")),
      "needs \"bands\"");
  EXPECT_CONTAINS(
      error_of(scene(R"({"weather": {"file": "none.epw", "month": 1, "day": 1, "hour": 12}})")),
      "none.epw");
}

TEST_F(SceneSky, GlazingWithFaults) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {R"({})", "refractive_index"},
      {R"({"internal_transmittance": 0.9})", "refractive_index"},
      {R"({"refractive_index": 1.52})", "internal_transmittance"},
      {R"({"refractive_index": 1.52, "absorption": 3})", "thickness"},
      {R"({"refractive_index": 1.52, "thickness": 0.006})", "absorption"},
      {R"({"refractive_index": 1.52, "thickness": 0, "absorption": 3})", "more than 0"},
      {R"({"refractive_index": 0.9, "internal_transmittance": 0.9})", "more than 1"},
      {R"({"transmittance": 1.1})", "transmittance"},
      {R"({"transmittance": 0.5, "refractive_index": 1.5})", "nothing else"}};
  for (const auto& [glazing, told] : cases) {
    const std::string message =
        error_of(scene("", "", R"("reflectance": 0.1, "glazing": )" + glazing));
    EXPECT_CONTAINS(message, "sky.json");
    EXPECT_CONTAINS(message, told);
  }
}

TEST_F(SceneSky, WrittenScenesAreReadAgain) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {R"({"type": 16, "zenith_radiance": [3, 4, 5], "ground_reflectance": 0.3})", ""},
      {R"({"type": 13, "zenith_radiance": 1, "azimuth_deg": 77, "elevation_deg": 33})", ""},
      {R"({"type": 13, "zenith_radiance": 1, "azimuth_deg": 77, "elevation_deg": 33,
           "north": [0.6, 0.8, 0]})",
       ""},
      {R"({"type": 13, "zenith_radiance": 1})",
       R"("sun": {"direction": [0.5, 0.5, -1], "irradiance": 3}, )"},
      {R"({"perez": {"direct_normal": 100, "diffuse_horizontal": 150}, "azimuth_deg": 10,
           "elevation_deg": 20})",
       ""}};
  for (const auto& [sky, head] : cases) {
    for (const char* glazing :
         {R"({"transmittance": 0.5})",
          R"({"refractive_index": 1.52, "internal_transmittance": 0.96})",
          R"({"refractive_index": 1.52, "thickness": 0.006, "absorption": [3, 4, 5]})"}) {
      const Scene first = io::read_scene(
          scene(sky, head, R"("reflectance": 0.1, "glazing": )" + std::string(glazing)));
      const std::filesystem::path path = folder() / "again.json";
      io::write_scene(path, first);
      const Scene second = io::read_scene(path);
      ASSERT_TRUE(second.sky);
      EXPECT_EQ(second.sky->zenith_radiance, first.sky->zenith_radiance);
      EXPECT_EQ(second.sky->ground_reflectance, first.sky->ground_reflectance);
      EXPECT_EQ(second.sky->distribution.kind, first.sky->distribution.kind);
      EXPECT_EQ(second.sky->north, first.sky->north);
      EXPECT_EQ(second.sky->distribution.c, first.sky->distribution.c);
      EXPECT_TRUE(second.sky->towards_sun.isApprox(first.sky->towards_sun, 1e-15));
      const Glazing& a = *first.materials[0].glazing;
      const Glazing& b = *second.materials[0].glazing;
      EXPECT_EQ(a.refractive_index, b.refractive_index);
      EXPECT_EQ(a.transmittance, b.transmittance);
      EXPECT_EQ(a.is_by_thickness, b.is_by_thickness);
    }
  }
}

}  // namespace
