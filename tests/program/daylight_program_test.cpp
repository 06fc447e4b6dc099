// Daylight factors, as a user would ask for them.

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/messages.h"
#include "tests/support/program.h"

namespace {

using namespace radiosity::test;
using Json = nlohmann::json;

constexpr double kPi = 3.14159265358979323846;

class Daylight : public Program {
 protected:
  /// A unit box without its lid, or with one that is glazed, of one reflectance below a uniform sky
  /// and a ground.
  std::string box(double reflectance, double ground, const std::string& sky_head,
                  const std::string& lid = "") const {
    return write_file("box.json", R"({"bands": "grey", "materials": {"m": {"reflectance": )" +
                                      std::to_string(reflectance) +
                                      R"(}, "glass": {"reflectance": 0,
        "glazing": {"transmittance": 0.5}}},
      "surfaces": [{"name": "floor", "material": "m",
        "polygons": [[[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]]},
       {"name": "walls", "material": "m", "polygons": [
        [[0, 0, 0], [0, 0, 1], [1, 0, 1], [1, 0, 0]], [[1, 0, 0], [1, 0, 1], [1, 1, 1], [1, 1, 0]],
        [[1, 1, 0], [1, 1, 1], [0, 1, 1], [0, 1, 0]], [[0, 1, 0], [0, 1, 1], [0, 0, 1], [0, 0, 0]]]})" +
                                      lid + R"(],
      "sky": {)" + sky_head + R"(, "ground_reflectance": )" +
                                      std::to_string(ground) + "}}");
  }
  Json daylight(Arguments arguments) const {
    arguments.insert(arguments.begin(), "daylight");
    arguments.emplace_back("--json");
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return Json::parse(outcome.out);
  }
  struct Hour {
    int hour;
    std::string direct;  // lx
    std::string diffuse;
  };
  /// A weather file of hours of a midsummer's day.
  std::string weather(const std::vector<Hour>& hours) const {
    std::string text = "LOCATION,Nowhere,-,-,made up,0,50.0,15.0,1.0,100\nDATA PERIODS,1,1\n";
    for (const Hour& hour : hours) {
      text += "2001,6,21," + std::to_string(hour.hour) +
              ",60,?9,20,10,50,101300,0,1300,300,500,300,150,50000," + hour.direct + "," +
              hour.diffuse + ",4000,180,2,5\n";
    }
    return write_file("made.epw", text);
  }
  static constexpr const char* kUniform = R"("type": 5, "horizontal_illuminance": 5000)";
  static constexpr const char* kLid = R"(, {"name": "lid", "material": "glass",
        "polygons": [[[0, 0, 1], [0, 1, 1], [1, 1, 1], [1, 0, 1]]]})";
};

TEST_F(Daylight, SkyComponentInClosedForm) {
  // Form factor from the middle of the floor to the opening: four corner rectangles of 0.5 x 0.5.
  const double x = 0.5;
  const double p = std::sqrt(1 + x * x);
  const double factor = 4 * 2 * x / p * std::atan(x / p) / (2 * kPi);
  const std::string points = write_file("points.csv", "x,y,z\n0.5,0.5,0\n0.2,0.7,0\n");
  const Json open = daylight({box(0, 0.5, kUniform), "--points", points});
  EXPECT_NEAR(open["horizontal_illuminance"].get<double>(), 5000, 1e-4);
  EXPECT_NEAR(open["points"][0]["sky"].get<double>(), factor, 1e-12);
  EXPECT_EQ(open["points"][0]["external"], 0);
  EXPECT_EQ(open["points"][0]["internal"], 0);
  EXPECT_EQ(open["measured"], 2);
  const Json glazed = daylight({box(0, 0.5, kUniform, kLid), "--points", points});
  for (int k = 0; k < 2; ++k) {
    EXPECT_NEAR(glazed["points"][k]["sky"].get<double>(),
                0.5 * open["points"][k]["sky"].get<double>(), 2e-6);
  }
}

TEST_F(Daylight, AddsUpToOneInAWhiteFurnace) {
  // Where all that surrounds a scene is as bright as a white surface in it, everything is.
  const std::string points = write_file(
      "points.csv", "0.5,0.5,0\n0.3,0.4,0.5,0,0,-1\n0.3,0.4,0.9,1,1,0.2\n0.3,0.4,0.6,0,0,1\n");
  const Json json = daylight({box(1, 1, kUniform), "--points", points, "--max-edge", "0.25", "-o",
                              result("factors.csv"), "--outdoors", "wa*"});
  for (const Json& point : json["points"]) {
    // Unobstructed form factors to 1e-6 or so, and means over patches of the sky to 1e-3.
    EXPECT_NEAR(point["daylight_factor"].get<double>(), 1, 5e-3) << point;
    EXPECT_NEAR(point["daylight_factor"].get<double>(),
                point["sky"].get<double>() + point["external"].get<double>() +
                    point["internal"].get<double>(),
                1e-14);
  }
  EXPECT_EQ(json["points"][0]["internal"], 0) << "the floor sees walls only";
  EXPECT_GT(json["points"][1]["internal"].get<double>(), 0.4);
  EXPECT_EQ(results().size(), 1U);
}

TEST_F(Daylight, OfAWorkPlane) {
  const Outcome outcome = run({"daylight", box(0.3, 0.2, kUniform), "--height", "0.5", "--border",
                               "0.1", "--spacing", "0.25", "-o", result("plane.csv")});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_contains(outcome.out, "16 measured, 0 in solids");
  expect_contains(outcome.out, "5000 lx on an open horizontal surface");
}

TEST_F(Daylight, IsInSolveAndPictures) {
  const Outcome outcome =
      run({"solve", box(0.3, 0.2, kUniform), "--patches", "50", "--quantity", "illuminance", "-o",
           result("a.csv"), "-o", result("a.png"), "--gather", "--width", "16", "--height", "16"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err.find("no surface emits"), std::string::npos) << outcome.err;
}

TEST_F(Daylight, InTheHoursOfAYear) {
  const std::string points = write_file("points.csv", "0.5,0.5,0\n0.3,0.4,0.5\n");
  const std::string scene = box(0.4, 0.2, kUniform);
  const auto arguments = [&](const std::string& weather) {
    return Arguments{"daylight-year", scene,       "--weather", weather, "--points",
                     points,          "--patches", "40",        "-o",    result("hours.csv")};
  };
  const Json json = [&] {
    Arguments all = arguments(weather({{12, "30000", "15000"},
                                       {13, "0", "9000"},
                                       {14, "999900", "9000"},
                                       {17, "0", "0"},
                                       {23, "0", "0"}}));
    all.emplace_back("--json");
    const Outcome outcome = run(all);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return Json::parse(outcome.out);
  }();
  EXPECT_EQ(json["hours"], 3) << "one lacks a value, one is not counted";
  EXPECT_EQ(json["sky_parts"], 144);
  const double mean = json["points"][0]["mean"].get<double>();
  EXPECT_GT(mean, 1000);
  EXPECT_LT(mean, 30000);
  EXPECT_NEAR(json["points"][0]["autonomy"].get<double>(), 2. / 3, 1e-12);
  EXPECT_EQ(json["warnings"].size(), 2U);
  const std::string table = contents(result("hours.csv"));
  EXPECT_EQ(table.substr(0, table.find('\n')), "month,day,hour,E_0,E_1");
  expect_contains(table, "\n6,21,17,0,0");
  expect_error(run(arguments("none.epw")), 1, "none.epw");
  expect_error(run(arguments(weather({{23, "0", "0"}}))), 1, "no hour from 8 to 18");
  Arguments turned = arguments(weather({{12, "30000", "15000"}}));
  turned.insert(turned.end(), {"--north", "0,0,1"});
  expect_error(run(turned), 1, "--north");
}

TEST_F(Daylight, BadInputIsTold) {
  const std::string good = box(0.3, 0.2, kUniform);
  expect_error(run({"daylight", good, "--outdoors", "tree*"}), 1, "'tree*'");
  expect_error(run({"daylight", good, "-o", result("a.png")}), 2, ".csv");
  expect_error(run({"daylight", good, "--points", "none.csv"}), 1, "none.csv");
  const auto points = [&](const std::string& content) {
    return run({"daylight", good, "--points", write_file("points.csv", content)});
  };
  expect_error(points("x,y,z\n"), 1, "has no points");
  expect_error(points("1,2\n"), 1, "points.csv:1");
  expect_error(points("1,2,3\n1,2,up\n"), 1, "points.csv:2");
  expect_error(points("1,2,3,0,0,0\n"), 1, "normal is 0");
  expect_error(run({"daylight", box(0.3, 0.2, R"("type": 5, "zenith_radiance": 0)")}), 1, "dark");
  expect_error(run({"daylight", std::string(RADIOSITY_SCENES) + "/furnace-cube.json"}), 1,
               "\"sky\"");
  expect_error(run({"daylight", box(0.3, 0.2, R"("type": 17, "zenith_radiance": 1)")}), 1,
               "1 to 16");
}

}  // namespace
