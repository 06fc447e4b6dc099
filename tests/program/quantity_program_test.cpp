// `solve --quantity`, as a user would run it.

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/program.h"

namespace {

using namespace radiosity::test;
using Json = nlohmann::json;

class Quantities : public Program {
 protected:
  /// A square that emits 1 W/(m² sr) in each of these bands (JSON) and reflects nothing.
  std::string write_lamp(const std::string& bands) const {
    return write_file(
        "lamp.json",
        R"({"bands": )" + bands +
            R"(, "materials": {"lamp": {"reflectance": 0, "radiance": 1}}, "surfaces": [
               {"name": "lamp", "material": "lamp",
                "polygons": [[[0, 0, 0], [1, 0, 0], [1, 2, 0], [0, 2, 0]]]}]})");
  }
};

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

// In the furnace B = H = 2 M_e = 2 π L in each band.
TEST_F(Quantities, OfAFurnaceAreKnown) {
  const Json json = solve({write_cube(0.5, 1), "--closed", "yes", "--patches", "300",  //
                           "--quantity", "luminance", "--quantity", "illuminance", "--quantity",
                           "luminous-flux", "--quantity", "power", "--quantity", "net-flux"});
  const Json& all = json["quantities"];
  // The default tolerance, 1e-2, bounds the relative error of the result.
  const auto near = [](const Json& value, double expected) {
    EXPECT_NEAR(value.get<double>(), expected, 1e-2 * expected);
  };
  ASSERT_EQ(all["luminance"]["surfaces"].size(), 1U);
  const Json& luminance = all["luminance"]["total"];
  EXPECT_EQ(all["luminance"]["unit"], "cd/m²");
  for (const char* key : {"mean", "min", "max"}) near(luminance[key], 2 * 179);
  EXPECT_EQ(luminance, [&] {
    Json surface = all["luminance"]["surfaces"][0];
    surface.erase("name");
    return surface;
  }());
  near(all["illuminance"]["total"]["mean"], 2 * M_PI * 179);
  near(all["luminous-flux"]["total"]["sum"], 6 * 2 * M_PI * 179);
  ASSERT_EQ(all["power"]["total"]["sum"].size(), 3U);
  near(all["power"]["total"]["sum"][1], 6 * 2 * M_PI);
  EXPECT_FALSE(all["power"]["total"].contains("mean"));
  EXPECT_EQ(all["net-flux"]["unit"], "W/m²");
  EXPECT_NEAR(all["net-flux"]["total"]["mean"][0].get<double>(), 0, 1e-2 * 2 * M_PI);
}

TEST_F(Quantities, OfWavelengthsAreIntegralsOverTheVisible) {
  std::string bands = "[";
  for (int nm = 360; nm <= 830; nm += 5) bands += std::to_string(nm) + (nm < 830 ? ", " : "]");
  const Json json = solve(
      {write_lamp(bands), "--as-is", "--quantity", "luminous-exitance", "--quantity", "radiance"});
  EXPECT_TRUE(json["warnings"].empty());
  const Json& all = json["quantities"];
  EXPECT_NEAR(all["luminous-exitance"]["total"]["mean"].get<double>(), 683 * 106.857 * M_PI, 5);
  EXPECT_EQ(all["radiance"]["unit"], "W/(m² sr nm)");
  ASSERT_EQ(all["radiance"]["total"]["mean"].size(), 95U);
  EXPECT_NEAR(all["radiance"]["total"]["mean"][94].get<double>(), 1, 1e-12);
}

TEST_F(Quantities, StandAfterTheOtherColumns) {
  const Json json = solve({write_cube(0.5, 1), "--as-is", "--quantity", "illuminance", "--quantity",
                           "radiance", "--quantity", "illuminance", "--quantity", "error", "-o",
                           result("a.csv"), "-o", result("a.vtp"), "-o", result("a.ply")});
  EXPECT_EQ(first_line(contents(result("a.csv"))),
            "patch,surface,polygon,x,y,z,area,B_0,B_1,B_2,H_0,H_1,H_2,error_0,error_1,error_2,"
            "net_0,net_1,net_2,illuminance,radiance_0,radiance_1,radiance_2,"
            "radiosity_error_0,radiosity_error_1,radiosity_error_2");
  const std::string vtp = contents(result("a.vtp"));
  for (const char* array : {"illuminance", "radiance", "radiosity_error"}) {
    EXPECT_NE(vtp.find("Name=\"" + std::string(array) + "\""), std::string::npos) << array;
  }
  EXPECT_EQ(results().size(), 3U);
  EXPECT_EQ(json["quantities"].size(), 3U);
}

TEST_F(Quantities, ShowInTheTable) {
  const Outcome outcome = run({"solve", write_lamp("\"grey\""), "--as-is", "--quantity",
                               "luminance", "--efficacy", "100", "--quantity", "power"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("luminance, cd/m²  area, m²  mean  min  max"), std::string::npos)
      << outcome.out;
  EXPECT_NE(outcome.out.find("  lamp                     2   100  100  100"), std::string::npos)
      << outcome.out;
  EXPECT_NE(outcome.out.find("  all              2  6.283"), std::string::npos) << outcome.out;
}

TEST_F(Quantities, RefuseAndWarnPlainly) {
  const std::string square = write_lamp("\"rgb\"");
  expect_error(
      run({"solve", square, "--quantity", "brightness"}), 2,
      "expected one of radiance, radiosity, irradiance, exitance, incident, absorbed, "
      "net-flux, power, "
      "reflectance, error, temperature, luminance, illuminance, luminous-exitance, luminous-flux");
  expect_error(run({"solve", square, "--efficacy", "0"}), 2, "expected a number above 0");
  EXPECT_NE(run({"solve", square, "--as-is", "--efficacy", "90", "--quantity", "power"})
                .err.find("warning: --efficacy has no effect without a photometric quantity"),
            std::string::npos);

  const Arguments luminance = {"--as-is", "--quantity", "luminance"};
  const auto solve_bands = [&](const std::string& bands) {
    Arguments arguments = {"solve", write_lamp(bands)};
    arguments.insert(arguments.end(), luminance.begin(), luminance.end());
    return run(arguments);
  };
  expect_error(solve_bands("[550]"), 1, "an integral over wavelengths, but the scene has only one");
  const Outcome narrow = solve_bands("[450, 550, 650]");
  EXPECT_EQ(narrow.exit_code, 0);
  EXPECT_NE(narrow.err.find("the bands cover 450 to 650 nm, not all of 400 to 700 nm"),
            std::string::npos)
      << narrow.err;
  const Outcome thermal = run({"solve", RADIOSITY_SCENES "/thermal-enclosure.json", "--patches",
                               "100", "--quantity", "illuminance"});
  EXPECT_NE(thermal.err.find("the scene emits by temperature"), std::string::npos) << thermal.err;
}

}  // namespace
