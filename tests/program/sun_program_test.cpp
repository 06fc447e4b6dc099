// Scenes with a sun, as a user would run them.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "tests/support/messages.h"
#include "tests/support/program.h"

namespace {

using namespace radiosity::test;
using Json = nlohmann::json;

class Sun : public Program {
 protected:
  /// A plate of 4 m² that looks up, and above its one half a sheet that turns its back to the sun.
  std::string write_scene(const std::string& head, const std::string& material) const {
    return write_file("plate.json", "{" + head + R"(, "materials": {"m": {)" + material +
                                        R"(}}, "surfaces": [
      {"name": "plate", "material": "m", "polygons": [[[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0]]]},
      {"name": "sheet", "material": "m", "polygons": [[[0, 0, 1], [0, 2, 1], [1, 2, 1], [1, 0, 1]]]}],
      "sun": {"direction": [0, 0, -1], "irradiance": 500},
      "camera": {"position": [1, -5, 4], "look_at": [1, 1, 0], "up": [0, 0, 1]}})");
  }
};

TEST_F(Sun, IsInTheEnergyAndInWhatArrives) {
  const std::string scene = write_scene(R"("bands": "grey")", R"("reflectance": 0.4)");
  const Json json = solve({scene, "--patches", "7", "--quantity", "irradiance", "--quantity",
                           "incident", "--quantity", "absorbed"});
  const Json& energy = json["energy"];
  EXPECT_EQ(energy["emitted"][0], 0);
  EXPECT_NEAR(energy["incident"][0].get<double>(), 1000, 1e-9);
  // The iteration's residual is 1e-6 at most.
  EXPECT_NEAR(energy["absorbed"][0].get<double>() + energy["escaped"][0].get<double>(), 1000, 1e-2);
  const auto mean = [&](const char* quantity, int surface) {
    return json["quantities"][quantity]["surfaces"][surface]["mean"][0].get<double>();
  };
  EXPECT_NEAR(mean("incident", 0), 250, 1e-9);
  EXPECT_EQ(mean("incident", 1), 0);
  EXPECT_GT(mean("irradiance", 0), 250);
  EXPECT_GT(mean("irradiance", 1), 0);
  EXPECT_NEAR(mean("absorbed", 0), 0.6 * mean("irradiance", 0), 1e-9);
  const Outcome text = run({"solve", scene});
  EXPECT_EQ(text.exit_code, 0);
  expect_contains(text.out, "emitted, W  from the sun, W  absorbed, W  escaped, W");
  EXPECT_EQ(text.err.find("no surface emits"), std::string::npos) << text.err;
}

TEST_F(Sun, ShinesInAllBandsAndPictures) {
  const std::string scene = write_scene(R"("bands": "rgb")", R"("reflectance": 0.4)");
  const Json json = solve({scene, "-o", result("a.csv"), "-o", result("a.png"), "--gather",
                           "--width", "16", "--height", "16", "-o", result("a.vtp")});
  for (int band = 0; band < 3; ++band) {
    EXPECT_NEAR(json["energy"]["incident"][band].get<double>(), 1000, 1e-9);
  }
  EXPECT_EQ(results().size(), 3U);
  EXPECT_EQ(
      run({"render", scene, "-o", result("b.png"), "--width", "16", "--height", "16"}).exit_code,
      0);
}

TEST_F(Sun, IsToldFromInfrared) {
  const std::string scene = write_scene(
      R"("bands": "solar-infrared")",
      R"("solar": {"absorptivity": 0.3}, "infrared": {"emissivity": 0.9}, "temperature": 300)");
  const Json json = solve({scene, "-o", result("a.csv"), "-o", result("a.vtp")});
  double solar = 0;
  for (const Json& surface : json["surfaces"]) {
    solar += surface["solar_absorbed"].get<double>();
    EXPECT_NEAR(
        surface["net_heat"].get<double>(),
        surface["infrared_net_heat"].get<double>() - surface["solar_absorbed"].get<double>(), 1e-9);
    EXPECT_EQ(surface["net_heat_by_band"].size(), 2U);
  }
  const Json& energy = json["energy"];
  EXPECT_EQ(energy["incident"][1], 0);
  EXPECT_EQ(energy["emitted"][0], 0);
  EXPECT_GT(energy["emitted"][1], 0);
  EXPECT_LE(solar, energy["absorbed"][0].get<double>() * (1 + 1e-9));  // backs take the rest
  expect_contains(run({"solve", scene}).out, "W  solar absorbed, W  infrared, W");
}

TEST_F(Sun, IsRefusedOrWarnedOfPlainly) {
  const std::string below = write_file("below.json", R"({"bands": "grey",
      "materials": {"m": {"reflectance": 0.5}},
      "surfaces": [{"name": "a", "material": "m",
                    "polygons": [[[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]]}],
      "sun": {"azimuth_deg": 0, "elevation_deg": -10, "irradiance": 1}})");
  const Outcome outcome = run({"solve", below});
  EXPECT_EQ(outcome.exit_code, 0);
  expect_contains(outcome.err, "the sun is not above the horizon (elevation_deg -10)");
  expect_contains(outcome.err, "no light of sun or luminaires reaches a surface's emitting side");
}

}  // namespace
