// `radiosity light`, as a user would run it.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>

#include "tests/support/program.h"

namespace {

using namespace radiosity::test;
using Json = nlohmann::json;

constexpr double kHalfTurn = 3.14159265358979323846;

class Light : public Program {
 protected:
  /// A black room of 4 x 4 x 3 m with a square of 1 m in the middle of its ceiling, 1000 cd/m².
  std::string write_room(const std::string& more = "", double reflectance = 0) const {
    return write_file("room.json", R"({"bands": "grey",
      "materials": {"wall": {"reflectance": )" +
                                       std::to_string(reflectance) + R"(},
                    "lamp": {"reflectance": 0, "radiance": 5.586592178770949}},
      "surfaces": [
        {"name": "floor", "material": "wall",
         "polygons": [[[0,0,0],[4,0,0],[4,4,0],[0,4,0]]]},
        {"name": "walls", "material": "wall", "polygons": [
          [[0,0,0],[0,0,3],[4,0,3],[4,0,0]], [[4,0,0],[4,0,3],[4,4,3],[4,4,0]],
          [[4,4,0],[4,4,3],[0,4,3],[0,4,0]], [[0,4,0],[0,4,3],[0,0,3],[0,0,0]]]},
        {"name": "ceiling", "material": "wall", "polygons": [
          [[0,0,3],[0,1.5,3],[4,1.5,3],[4,0,3]], [[0,2.5,3],[0,4,3],[4,4,3],[4,2.5,3]],
          [[0,1.5,3],[0,2.5,3],[1.5,2.5,3],[1.5,1.5,3]],
          [[2.5,1.5,3],[2.5,2.5,3],[4,2.5,3],[4,1.5,3]]]},
        {"name": "lamp", "material": "lamp",
         "polygons": [[[1.5,1.5,3],[1.5,2.5,3],[2.5,2.5,3],[2.5,1.5,3]]]}])" +
                                       more + "}");
  }

  Json light(const Arguments& more) const {
    Arguments arguments = {"light", "--json", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.exit_code == 0 ? Json::parse(outcome.out) : Json();
  }
};

/// What stands in a column of a table, line by line.
std::vector<double> column(const std::string& csv, const std::string& name) {
  std::istringstream lines(csv);
  std::string line;
  std::size_t index = 0;
  std::vector<double> values;
  for (bool is_first = true; std::getline(lines, line); is_first = false) {
    std::istringstream fields(line);
    std::string field;
    for (std::size_t k = 0; std::getline(fields, field, ','); ++k) {
      if (is_first && field == name) index = k;
      if (!is_first && k == index) values.push_back(field.empty() ? NAN : std::stod(field));
    }
  }
  return values;
}

// CIE 171:2006, 5.3: an area source of 1 m x 1 m in the ceiling; points G to J on the floor at x =
// 2 and A to F on the wall y = 0, by the closed form of a rectangle to a point.
TEST_F(Light, OfAnAreaSourceIsTheClosedForm) {
  const std::string floor =
      write_file("floor.csv", "x,y,z\n2,.25,0\n2,.75,0\n2,1.25,0\n2,1.75,0\n");
  const std::string wall = write_file("wall.csv",
                                      "# points A to F\nx,y,z,nx,ny,nz\n2,0,2.75,0,2,0\n"
                                      "2,0,2.25,0,2,0\n2,0,1.75,0,2,0\n2,0,1.25,0,2,0\n"
                                      "2,0,.75,0,2,0\n2,0,.25,0,2,0\n");
  const Json json = light({write_room(), "--patches", "60", "--points", floor, "--points", wall,
                           "-o", result("report")});
  ASSERT_EQ(json["grids"].size(), 2U);
  const auto on_floor = column(contents(result("report/floor.csv")), "illuminance");
  const auto on_wall = column(contents(result("report/wall.csv")), "illuminance");
  const std::vector<double> floor_exact = {61.424, 79.255, 95.667, 105.778};
  const std::vector<double> wall_exact = {32.677, 75.194, 81.323, 69.061, 53.404, 40.002};
  ASSERT_EQ(on_floor.size(), floor_exact.size());
  ASSERT_EQ(on_wall.size(), wall_exact.size());
  for (std::size_t k = 0; k < on_floor.size(); ++k) {
    EXPECT_NEAR(on_floor[k], floor_exact[k], 5e-4);  // the values have so many digits
  }
  for (std::size_t k = 0; k < on_wall.size(); ++k) EXPECT_NEAR(on_wall[k], wall_exact[k], 5e-4);
}

TEST_F(Light, WritesAReportAndFilesOfEachGrid) {
  const std::string scene = write_room(R"(, "name": "A room",
    "maintenance_factor": 0.8,
    "grids": [
      {"name": "work/plane", "surface": "floor", "offset": 0.75, "spacing": 0.8,
       "cylindrical": true, "required": {"Em": 20, "U0": 0.99, "UGR": 22}},
      {"name": "task", "corner": [1, 1, 0.8], "sides": [[2, 0, 0], [0, 1, 0]], "spacing": 0.5},
      {"name": "list", "points": [[1, 1, 1], [5, 1, 1]]}],
    "observers": [{"name": "desk", "position": [0.5, 2, 1.2], "look_at": [3, 2, 1.2], "UGR": 3}])",
                                       0.5);
  const Json json = light({scene, "--patches", "150", "-o", result("report")});
  for (const char* name :
       {"report.html", "report.json", "work-plane.csv", "work-plane.vtp", "work-plane.svg",
        "work-plane.png", "task.csv", "task.png", "list.csv", "list.vtp"}) {
    EXPECT_FALSE(contents(result(std::string("report/") + name)).empty()) << name;
  }
  EXPECT_EQ(Json::parse(contents(result("report/report.json"))), json);
  const Json& plane = json["grids"][0];
  EXPECT_EQ(plane["columns"], 4);
  EXPECT_EQ(plane["quantities"].size(), 2U);
  const Json& now = plane["quantities"][0]["new"];
  const Json& later = plane["quantities"][0]["maintained"];
  // All lamps have lost the same share, and light is linear, but for the iteration's tolerance.
  EXPECT_NEAR(later["Em"].get<double>(), 0.8 * now["Em"].get<double>(),
              1e-3 * now["Em"].get<double>());
  EXPECT_NEAR(now["Em"].get<double>(),
              now["Em_direct"].get<double>() + now["Em_indirect"].get<double>(), 1e-9);
  EXPECT_EQ(json["grids"][2]["outside"], 1);
  ASSERT_EQ(json["required"].size(), 4U);
  EXPECT_TRUE(json["required"][0]["met"].get<bool>());
  EXPECT_FALSE(json["required"][1]["met"].get<bool>());
  EXPECT_EQ(json["required"][3]["of"], "desk");
  EXPECT_EQ(json["observers"][0]["sources"].size(), 1U);
  const std::string html = contents(result("report/report.html"));
  for (const char* words : {"Lighting of A room", "2 of 4 requirements", "<svg", "UGR", "not met",
                            "Energy balance", "1 outside left out", "How right this is"}) {
    EXPECT_NE(html.find(words), std::string::npos) << words;
  }
  EXPECT_EQ(html.find("http://") == std::string::npos ||
                html.find("http://www.w3.org") != std::string::npos,
            true);
  const auto maintained = column(contents(result("report/task.csv")), "illuminance_maintained");
  EXPECT_EQ(maintained.size(), 8U);
}

// Lamps of one material age, those of another do not.
TEST_F(Light, AgesByMaterial) {
  const std::string scene = write_room();
  std::string text = contents(scene);
  text.replace(text.find("\"radiance\""), 0, "\"maintenance_factor\": 0.5, ");
  const std::string aged = write_file("aged.json", text);
  const Json json = light({aged, "--patches", "60", "--grid", "floor:1", "--maintenance-factor",
                           "0.5", "--spacing", "1"});
  const Json& quantity = json["grids"][0]["quantities"][0];
  EXPECT_NEAR(quantity["maintained"]["Em"].get<double>(),
              0.25 * quantity["new"]["Em"].get<double>(), 1e-9);
  EXPECT_EQ(json["maintenance_factors"]["lamp"], 0.25);
  EXPECT_EQ(json["grids"][0]["name"], "floor:1");
}

// A furnace: cylinders, half cylinders and planes all have the walls' exitance.
TEST_F(Light, OfAFurnaceIsTheSameOfAllKinds) {
  const Json json = light({write_cube(0.5, 1), "--grid", ".2,.2,.5,.6,0,0,0,.6,0", "--spacing",
                           ".3", "--cylindrical", "--vertical", "1,0,0", "--semi-cylindrical",
                           "0,1,0", "--patches", "100"});
  const double expected = 179 * kHalfTurn / (1 - 0.5);
  for (const Json& quantity : json["grids"][0]["quantities"]) {
    EXPECT_NEAR(quantity["new"]["Em"].get<double>(), expected, 1e-3 * expected) << quantity;
    EXPECT_NEAR(quantity["new"]["U0"].get<double>(), 1, 1e-3);
  }
  EXPECT_EQ(json["grids"][0]["quantities"].size(), 4U);
}

// Its luminance is its exitance over π, from wherever.
TEST_F(Light, OfAFurnaceIsOneLuminance) {
  const Json json =
      light({write_cube(0.5, 1), "--grid", ".2,.2,0,.6,0,0,0,.6,0", "--spacing", ".3", "--patches",
             "100", "--luminance-from", ".5,.4,.9", "--luminance-from", ".1,.1,.2"});
  ASSERT_EQ(json["grids"][0]["quantities"].size(), 3U);
  const Json& quantity = json["grids"][0]["quantities"][2];
  EXPECT_EQ(quantity["name"], "luminance 0.1,0.1,0.2");
  EXPECT_NEAR(quantity["new"]["Em"].get<double>(), 179 / (1 - 0.5), 1e-3 * 358);
}

// Luminaires of photometric files light, dazzle and age like lamps.
TEST_F(Light, OfLuminairesIsToldAndAges) {
  const Json json = light({RADIOSITY_SCENES "/office.json", "--patches", "300", "--grid",
                           "floor:0.75", "--spacing", "1", "--observer", "0.3,3,1.2,1,0,0",
                           "--maintenance-factor", "0.8", "-o", result("office")});
  const Json& quantity = json["grids"][0]["quantities"][0];
  const double fresh = quantity["new"]["Em"];
  EXPECT_GT(quantity["new"]["Em_direct"].get<double>(), 0.5 * fresh);
  EXPECT_NEAR(quantity["maintained"]["Em"].get<double>(), 0.8 * fresh, 1e-3 * fresh);
  const Json& observer = json["observers"][0];
  EXPECT_TRUE(observer["UGR"].is_number());
  EXPECT_GT(observer["sources"].size(), 3U);
  const std::string html = contents(result("office/report.html"));
  EXPECT_NE(html.find("<h2>Luminaires</h2>"), std::string::npos);
  EXPECT_NE(html.find("office-panel.ies"), std::string::npos);
}

// A diffuse opening of 0.6 x 1.2 m, 0.3 m above a point: π I / A of its exitance, times the form
// factor (Hamilton & Morgan 1952), and not I / d². One that reaches into a wall counts as a point.
TEST_F(Light, OfALargeOpeningIsThatOfItsArea) {
  std::string angles;
  std::string candela;
  for (int k = 0; k <= 90; ++k) {
    angles += std::to_string(k) + ' ';
    candela += std::to_string(std::max(0., 1000 * std::cos(k * kHalfTurn / 180))) + ' ';
  }
  (void)write_file("panel.ies", "IESNA91\nTILT=NONE\n1 -1 1 91 1 1 2 0.6 1.2 0\n1 1 9\n" + angles +
                                    "\n0\n" + candela + "\n");
  const std::string below = write_file("below.csv", "x,y,z\n1,1,1\n");
  const auto lux = [&](const std::string& position, const std::string& more) {
    const std::string scene = write_file("panel.json", R"({"bands": "grey",
      "materials": {"black": {"reflectance": 0}}, "surfaces": [
        {"name": "floor", "material": "black",
         "polygons": [[[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0]]]},
        {"name": "wall", "material": "black",
         "polygons": [[[0, 0, 0], [0, 2, 0], [0, 2, 2], [0, 0, 2]]]}], "luminaires": [
        {"name": "panel", "file": "panel.ies", "position": )" +
                                                           position + more + "}]}");
    const Outcome outcome = run({"light", scene, "--points", below, "--json"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const Json json = Json::parse(outcome.out);
    const Json& quantity = json["grids"][0]["quantities"][0]["new"];
    EXPECT_LT(quantity["Em_error"].get<double>(), 1e-4 * quantity["Em"].get<double>());
    return std::pair(quantity["Em"].get<double>(), outcome.err);
  };
  const double p = std::sqrt(2);
  const double q = std::sqrt(5);
  const double factor = 4 * (std::atan(2 / p) / p + 2 / q * std::atan(1 / q)) / (2 * kHalfTurn);
  const double expected = kHalfTurn * 1000 / (0.6 * 1.2) * factor;
  // Linear interpolation between degrees is off by (π/180)²/8.
  EXPECT_NEAR(lux("[1, 1, 1.3]", "").first, expected, 4e-5 * expected);
  EXPECT_NEAR(lux("[1, 1, 1.3]", R"(, "turn_deg": 90)").first, expected, 4e-5 * expected);
  EXPECT_NEAR(lux("[1, 1, 1.3]", R"(, "points": [1, 1])").first, 1000 / 0.09, 1e-6);
  const auto [point, told] = lux("[0.1, 1, 1.3]", "");
  EXPECT_NE(told.find("'panel', have a luminous opening that a surface cuts through"),
            std::string::npos)
      << told;
  EXPECT_NEAR(point, 1000 * 0.09 / 0.81, 0.01);
}

// Luminaires have factors of their own: of two alike, one above the other half of the plane, each
// loses its share.
TEST_F(Light, AgesByLuminaire) {
  write_file("lamp.ies", "IESNA91\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 9\n0 90\n0\n100 100\n");
  std::string scene;
  const auto mean = [&](const char* factors) {
    scene = write_file(
        "two.json",
        std::string(R"({"materials": {"black": {"reflectance": 0}}, "maintenance_factor": 0.9,
            "surfaces": [{"name": "floor", "material": "black",
              "polygons": [[[0, 0, 0], [4, 0, 0], [4, 2, 0], [0, 2, 0]]]}],
            "luminaires": [{"name": "a", "file": "lamp.ies", "position": [1, 1, 2])") +
            factors + R"(}, {"name": "b", "file": "lamp.ies", "position": [3, 1, 2]}]})");
    const Json json = light({scene, "--patches", "8", "--grid", "floor:0", "--spacing", "1"});
    EXPECT_EQ(json["maintenance_factors"]["b"], 0.9);
    return json["grids"][0]["quantities"][0];
  };
  const Json alike = mean("");
  const Json aged = mean(R"(, "maintenance_factor": 0.5)");
  const double fresh = alike["new"]["Em"];
  EXPECT_NEAR(alike["maintained"]["Em"].get<double>(), 0.9 * fresh, 1e-9 * fresh);
  EXPECT_NEAR(aged["new"]["Em"].get<double>(), fresh, 1e-12 * fresh);
  EXPECT_NEAR(aged["maintained"]["Em"].get<double>(), 0.9 * 0.75 * fresh, 1e-9 * fresh);
  EXPECT_NE(run({"light", scene, "--grid", "floor:0", "--patches", "8", "--quiet"})
                .out.find("0.45 to 0.9 of what lamps give when new"),
            std::string::npos);
}

TEST_F(Light, PrintsTables) {
  const Outcome outcome = run({"light", write_room(), "--patches", "60", "--quiet", "--grid",
                               "floor:0.75", "--observer", "0.5,2,1.2,1,0,0"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* words : {"U0", "floor:0.75", "Emin at, m", "observer", "UGR"}) {
    EXPECT_NE(outcome.out.find(words), std::string::npos) << outcome.out;
  }
}

TEST_F(Light, RefusesWhatItCannotMeasure) {
  const std::string room = write_room();
  const auto refuse = [&](const Arguments& more, int code, const std::string& words) {
    Arguments arguments = {"light", room, "--patches", "60", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_error(run(arguments), code, words);
  };
  refuse({}, 1, "there is nothing to measure");
  refuse({"--grid", "table:0.75"}, 1, "no surface \"table\"");
  refuse({"--grid", "flor:0.75"}, 1, "the nearest is \"floor\"");
  refuse({"--grid", "walls"}, 1, "is not flat");
  refuse({"--grid", "floor", "--border", "2"}, 1, "leaves nothing");
  refuse({"--grid", "floor", "--spacing", "0.001"}, 1, "would be more than 100000");
  refuse({"--grid", "0,0,0,1,0,0,1,1,0"}, 2, "right angle");
  refuse({"--grid", "0,0,0,1,0,0,1,1,x"}, 2, "nine numbers");
  refuse({"--observer", "0,0,1,0,0,1"}, 2, "elsewhere than up or down");
  refuse({"--observer", "0,0,1"}, 2, "six numbers");
  refuse({"--maintenance-factor", "1.5"}, 2, "at most 1");
  refuse({"--grid", "floor", "--vertical", "0,0,0"}, 2, "not all 0");
  const auto points = [&](const std::string& text, const std::string& words) {
    refuse({"--points", write_file("points.csv", text)}, 1, words);
  };
  points("1,2,3\n1,2\n", "points.csv:2: found 2 columns, expected 3");
  points("1,2,3\n1,2,3,0,0,1\n", "points.csv:2: found 6 columns, 3 before");
  points("x,y\n1,2\n", "points.csv:1: the columns are not x,y,z");
  points("x,y,z\n1,nan,3\n", "points.csv:2: expected a number, found \"nan\"");
  points("x,y,z\n1,,3\n", "points.csv:2: expected a number");
  points("1,2,3,0,0,0\n", "points.csv:1: the normal is 0");
  points("x,y,z\n", "points.csv: has no points");
  points("", "points.csv: is empty");
  refuse({"--points", folder() / "none.csv"}, 1, "none.csv");
  // Its own table would replace it.
  refuse({"--points", write_file("a.csv", "1,1,1\n"), "-o", folder()}, 1, "a.csv");
}

TEST_F(Light, RefusesScenesThatSayItWrong) {
  const auto refuse = [&](const std::string& more, const std::string& words) {
    expect_error(run({"light", write_room(", " + more), "--quiet"}), 1, words);
  };
  refuse(R"("grids": [{"name": "a"}])", "grids[0]: expected one of \"surface\"");
  refuse(R"("grids": [{"name": "a", "surface": "flor"}])", "no surface \"flor\" in the scene");
  refuse(R"("grids": [{"name": "a", "surface": "floor", "sides": []}])", "does not go with");
  refuse(R"("grids": [{"name": "a", "surface": "floor"}, {"name": "a", "surface": "floor"}])",
         "grids[1].name: is the name of another one");
  refuse(R"("grids": [{"name": "a", "surface": "floor", "spacing": 0}])", "spacing: is 0");
  refuse(R"("grids": [{"name": "a", "corner": [0,0,1], "sides": [[1,0,0],[1,1,0]]}])",
         "sides: are not at a right angle");
  refuse(R"("grids": [{"name": "a", "points": []}])", "points: has no points");
  refuse(R"("grids": [{"name": "a", "points": "none.csv"}])", "none.csv");
  refuse(R"("grids": [{"name": "a", "surface": "floor", "required": {"E": 5}}])", "required");
  refuse(R"("grids": [{"name": "a", "surface": "floor", "required": {"U0": 2}}])", "at most 1");
  refuse(R"("observers": [{"name": "a", "position": [0,0,1], "direction": [0,0,1]}])",
         "looks along its own \"up\"");
  refuse(R"("observers": [{"name": "a", "position": [0,0,1]}])", "either \"look_at\"");
  refuse(R"("maintenance_factor": 0)", "maintenance_factor: is 0");
}

// Points of a facade, which stands on the endless ground of a sky, are wherever they are wanted.
TEST_F(Light, UnderTheSkyPointsNeedNoFloor) {
  const std::string scene = write_file("block.json", R"({"bands": "grey",
    "materials": {"black": {"reflectance": 0}},
    "surfaces": [{"name": "roof", "material": "black",
                  "polygons": [[[0,0,6],[4,0,6],[4,4,6],[0,4,6]]]}],
    "sky": {"type": 5, "horizontal_illuminance": 1000, "ground_reflectance": 0}})");
  const std::string points =
      write_file("points.csv", "x,y,z,nx,ny,nz\n9,9,1,0,0,1\n500,0,0.1,1,0,0\n500,0,0.1,0,0,-1\n");
  light({scene, "--points", points, "--as-is", "-o", result("out")});
  const std::vector<double> found = column(contents(result("out/points.csv")), "illuminance");
  ASSERT_EQ(found.size(), 3);
  EXPECT_GT(found[0], 900);  // the roof hides some
  EXPECT_LT(found[0], 1000);
  EXPECT_NEAR(found[1], 500, 1e-2);  // half of an even sky
  EXPECT_EQ(found[2], 0);
}

}  // namespace
