// `radiosity solve` of scenes with heats, shields and surroundings, as a user would run it.

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "tests/support/program.h"

namespace {

using namespace radiosity::test;
using Json = nlohmann::json;

double black(double kelvin) { return 5.670374419e-8 * std::pow(kelvin, 4); }

/// Faces of a cube of edge 2 r about the origin, seen from outside or inside.
std::string cube(double r, bool from_inside) {
  const Json vertices = {{-r, -r, -r}, {r, -r, -r}, {r, r, -r}, {-r, r, -r},
                         {-r, -r, r},  {r, -r, r},  {r, r, r},  {-r, r, r}};
  Json faces = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 4, 7, 3}, {1, 2, 6, 5}};
  for (Json& face : faces) {
    if (from_inside) face = {face[3], face[2], face[1], face[0]};
  }
  return R"("vertices": )" + vertices.dump() + R"(, "polygons": )" + faces.dump();
}

std::string surface(const std::string& name, const std::string& rest) {
  return R"({"name": ")" + name + R"(", "material": ")" + name + R"(", )" + rest + "}";
}

std::string scene(const std::string& head, const std::string& materials,
                  const std::string& surfaces) {
  return R"({"bands": "grey", )" + head + R"("materials": {)" + materials + R"(}, "surfaces": [)" +
         surfaces + "]}";
}

class Heat : public Program {
 protected:
  /// The surfaces that --json tells.
  Json solve(const std::string& text, const std::string& more = "--as-is") const {
    return Program::solve({write_file("scene.json", text), more, "--tolerance", "1e-6"});
  }
  std::string error_of(const std::string& text) const {
    const Outcome outcome = run({"solve", write_file("bad.json", text), "--as-is"});
    EXPECT_EQ(outcome.exit_code, 1) << text;
    return outcome.err;
  }
};

// A cube in a cube is a two-surface enclosure, one patch a face:
// Q = σ (T1⁴ - T2⁴) / ((1 - ε1)/(A1 ε1) + 1/A1 + (1 - ε2)/(A2 ε2)). Heat gives the temperature.
TEST_F(Heat, BodyInAnEnclosure) {
  const double resistance = 0.7 / (6 * 0.3) + 1. / 6 + 0.4 / (24 * 0.6);
  const double heat = (black(500) - black(300)) / resistance;
  for (const std::string& given : {R"("heat_power": )" + std::to_string(heat),
                                   R"("heat_flux": )" + std::to_string(heat / 6)}) {
    const Json json =
        solve(scene(R"("closed": true, )",
                    R"("in": {"emissivity": 0.3, )" + given +
                        R"(}, "out": {"emissivity": 0.6, "temperature": 300})",
                    surface("in", cube(0.5, false)) + "," + surface("out", cube(1, true))));
    ASSERT_TRUE(json.contains("surfaces")) << json;
    // 1e-9 of B by the iteration, a patch's coefficients in single or double precision.
    EXPECT_NEAR(json["surfaces"][0]["net_heat"], heat, 1e-6 * heat);
    EXPECT_NEAR(json["surfaces"][0]["temperature"], 500, 1e-4);
    EXPECT_NEAR(json["surfaces"][1]["net_heat"], -heat, 1e-6 * heat);
    EXPECT_TRUE(json["solve"]["converged"]);
  }
}

// In surroundings of one temperature all that gives off no heat comes to that, shields too; turned
// and divided otherwise just as well.
TEST_F(Heat, SurroundingsWarmEverything) {
  const std::string text =
      scene(R"("environment": {"temperature": 290}, )",
            R"("box": {"emissivity": 0.4, "adiabatic": true}, "sheet": {"emissivity": 0.1},
         "other": {"emissivity": 0.9})",
            surface("box", cube(0.5, false)) + "," +
                surface("sheet",
                        R"("two_sided": true, "shield": true, "back": "other",
                     "polygons": [[[-1, -1, 0.8], [1, -1, 0.9], [1, 1, 1.1], [-1, 1, 1]]])"));
  for (const char* more : {"--as-is", "--patches=80"}) {
    const Json json = solve(text, more);
    ASSERT_TRUE(json.contains("surfaces"));
    for (const Json& each : json["surfaces"]) {
      EXPECT_NEAR(each["temperature"], 290, 1e-3) << more << each;
      EXPECT_NEAR(each["net_heat"], 0, 1e-3 * black(290)) << more << each;
    }
    const Json& energy = json["energy"];
    const double incident = energy["incident"][0];
    EXPECT_GT(incident, 0);
    EXPECT_NEAR(energy["emitted"][0].get<double>() + incident,
                energy["absorbed"][0].get<double>() + energy["escaped"][0].get<double>(),
                1e-6 * incident);
  }
}

// In a closed oblong box a sheet from wall to wall between alike ends is at the mean of T⁴.
TEST_F(Heat, ShieldBetweenAlikeEnds) {
  const std::string text =
      scene(R"("closed": true, )",
            R"("hot": {"emissivity": 0.8, "temperature": 500}, "cold": {"emissivity": 0.8,
         "temperature": 300}, "wall": {"emissivity": 0.5, "adiabatic": true},
         "sheet": {"emissivity": 0.05})",
            surface("hot", R"("polygons": [[[0,0,0], [1,0,0], [1,1,0], [0,1,0]]])") + "," +
                surface("cold", R"("polygons": [[[0,0,2], [0,1,2], [1,1,2], [1,0,2]]])") + "," +
                surface("wall", R"("polygons": [
            [[0,0,0], [0,0,1], [1,0,1], [1,0,0]], [[0,1,0], [1,1,0], [1,1,1], [0,1,1]],
            [[0,0,0], [0,1,0], [0,1,1], [0,0,1]], [[1,0,0], [1,0,1], [1,1,1], [1,1,0]],
            [[0,0,1], [0,0,2], [1,0,2], [1,0,1]], [[0,1,1], [1,1,1], [1,1,2], [0,1,2]],
            [[0,0,1], [0,1,1], [0,1,2], [0,0,2]], [[1,0,1], [1,0,2], [1,1,2], [1,1,1]]])") +
                "," + surface("sheet", R"("two_sided": true, "shield": true,
                              "polygons": [[[0,0,1], [1,0,1], [1,1,1], [0,1,1]]])"));
  const Json json = solve(text);
  ASSERT_TRUE(json.contains("surfaces"));
  const double expected = std::pow((std::pow(500, 4) + std::pow(300, 4)) / 2, 0.25);
  EXPECT_NEAR(json["surfaces"][3]["temperature"], expected, 1e-4);
  EXPECT_NEAR(json["surfaces"][0]["net_heat"].get<double>(),
              -json["surfaces"][1]["net_heat"].get<double>(), 1e-4);
}

TEST_F(Heat, FilesTellTemperatures) {
  const Outcome outcome = run({"solve", RADIOSITY_SCENES "/furnace-walls.json", "--patches", "60",
                               "-o", result("a.csv"), "-o", result("a.vtp")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::string csv = contents(result("a.csv"));
  EXPECT_NE(csv.substr(0, csv.find('\n')).find(",net_0,T"), std::string::npos);
  EXPECT_NE(contents(result("a.vtp")).find("\"surface_temperature\""), std::string::npos);
  EXPECT_NE(outcome.out.find(" K\n"), std::string::npos) << outcome.out;
}

// What one run finds another takes as given, from either file, and comes to the same heats.
TEST_F(Heat, TemperaturesOfAResultAreTaken) {
  const std::string furnace = RADIOSITY_SCENES "/furnace-walls.json";
  const auto solve_furnace = [&](Arguments more) {
    Arguments arguments = {"solve", furnace, "--patches", "60", "--tolerance", "1e-6", "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.exit_code == 0 ? Json::parse(outcome.out) : Json();
  };
  const Json first =
      solve_furnace({"--quantity", "temperature", "-o", result("a.csv"), "-o", result("a.vtp")});
  ASSERT_TRUE(first.contains("quantities"));
  EXPECT_NEAR(first["quantities"]["temperature"]["surfaces"][0]["mean"][0], 900, 1e-6);
  EXPECT_EQ(first["quantities"]["temperature"]["unit"], "K");
  const std::string csv = contents(result("a.csv"));
  EXPECT_NE(csv.substr(0, csv.find('\n')).find(",T,surface_temperature_0"), std::string::npos);
  for (const char* file : {"a.csv", "a.vtp"}) {
    const Json again = solve_furnace({"--temperatures", result(file)});
    ASSERT_TRUE(again.contains("surfaces"));
    for (std::size_t s = 0; s < 3; ++s) {
      // The iterations add up to 1e-8 of B, of which heats are a part.
      EXPECT_NEAR(again["surfaces"][s]["net_heat"], first["surfaces"][s]["net_heat"], 0.1) << file;
    }
  }
}

// Before the long work, by the shield's name, and from form factors at hand as well.
TEST_F(Heat, ShieldsAreRefusedWhereTheMethodCannotPassHeat) {
  const std::string path =
      write_file("shield.json",
                 scene(R"("environment": {"radiance": 9}, )", R"("sheet": {"emissivity": 0.05})",
                       surface("sheet", R"("two_sided": true, "shield": true,
                              "polygons": [[[0,0,1], [1,0,1], [1,1,1], [0,1,1]]])")));
  const Outcome made = run({"solve", path, "-o", result("f.h5"), "--json"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_TRUE(Json::parse(made.out).contains("surfaces"));
  for (const char* method : {"gauss-seidel", "southwell"}) {
    for (const char* how : {"--as-is", "--adaptive", "--operator"}) {
      Arguments arguments = {"solve", path, "--method", method, how};
      if (std::string(how) == "--operator") arguments.push_back(result("f.h5"));
      expect_error(run(arguments), 1, std::string("surface 'sheet' is a shield, which ") + method);
    }
  }
}

TEST_F(Heat, FilesInDegreesCelsiusAreTold) {
  const std::string path = RADIOSITY_SCENES "/furnace-walls.json";
  ASSERT_EQ(run({"solve", path, "--patches", "60", "-o", result("f.h5")}).exit_code, 0);
  const std::string cold = write_file("cold.csv", "polygon,T\n0,20.5\n1,\n2,45\n");
  const std::string mixed = write_file("mixed.csv", "polygon,T\n0,20.5\n2,345\n");
  for (const char* how : {"--as-is", "--operator"}) {
    Arguments arguments = {"solve", path, how};
    if (std::string(how) == "--operator") arguments.push_back(result("f.h5"));
    for (const auto& [file, is_told] : {std::pair(cold, true), std::pair(mixed, false)}) {
      Arguments with_file = arguments;
      with_file.insert(with_file.end(), {"--temperatures", file});
      const Outcome outcome = run(with_file);
      EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
      EXPECT_EQ(
          outcome.err.find("cold.csv: all temperatures lie from 20.5 to 45 K") != std::string::npos,
          is_told)
          << outcome.err;
    }
  }
}

TEST_F(Heat, TablesOfEmissivityAreChecked) {
  const std::pair<const char*, const char*> cases[] = {
      {"[[200, 0.3]]", "materials.m.emissivity: has one pair"},
      {"[[200, 0.3], [100, 0.4]]", "temperature 100 K does not follow 200 K"},
      {"[[200, 0.3], [200, 0.4]]", "temperature 200 K does not follow 200 K"},
      {"[[-5, 0.3], [200, 0.4]]", "emissivity[0]: temperature is -5 K, below absolute zero"},
      {"[[5, 0], [200, 0.4]]", "emissivity 0 is outside (0, 1]"},
      {"[[5, 0.2], [200, 1.4]]", "emissivity[1]: emissivity 1.4 is outside"},
      {"[[5, 0.1, 3], [200, 0.4]]", "expected a pair of a temperature, K, and an emissivity"},
      {"[[5, \"a\"], [200, 0.4]]", "emissivity[0][1]: expected a number"},
      {"[[5, 0.1], 0.4]", "emissivity[1]: expected a list"}};
  for (const auto& [table, message] : cases) {
    const std::string text =
        scene("", std::string(R"("m": {"adiabatic": true, "emissivity": )") + table + "}",
              surface("m", R"("polygons": [[[0,0,0], [1,0,0], [1,1,0], [0,1,0]]])"));
    EXPECT_NE(error_of(text).find(message), std::string::npos) << table << ": " << error_of(text);
  }
}

TEST_F(Heat, CellDataOfGridsAreTaken) {
  const std::string text = scene(
      "", R"("m": {"emissivity": 0.5})",
      surface(
          "m",
          R"("polygons": [[[0,0,0],[1,0,0],[1,1,0],[0,1,0]], [[2,0,0],[3,0,0],[3,1,0],[2,1,0]]])"));
  const std::string grid = write_file("T.vtu", R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian"><UnstructuredGrid>
<Piece NumberOfPoints="8" NumberOfCells="2">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">
0 0 0 1 0 0 1 1 0 0 1 0 2 0 0 3 0 0 3 1 0 2 1 0</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3 4 5 6 7</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">4 8</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">9 9</DataArray></Cells>
<CellData><DataArray type="Float64" Name="temperature" format="ascii">300 400</DataArray>
<DataArray type="Float64" Name="heat_flux" format="ascii">7 nan</DataArray></CellData>
</Piece></UnstructuredGrid></VTKFile>)");
  const auto heats = [&](const char* option, const char* more) {
    const Outcome outcome =
        run({"solve", write_file("two.json", text), more, option, grid, "--json"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.exit_code == 0 ? Json::parse(outcome.out)["surfaces"] : Json();
  };
  for (const char* more : {"--as-is", "--patches=32"}) {
    const double expected = 0.5 * (black(300) + black(400));
    EXPECT_NEAR(heats("--temperatures", more)[0]["net_heat"], expected, 1e-9 * expected) << more;
  }
  EXPECT_NEAR(heats("--heat-fluxes", "--as-is")[0]["net_heat"], 7, 1e-9);
  const Outcome both = run({"solve", write_file("two.json", text), "--as-is", "--temperatures",
                            grid, "--heat-fluxes", grid});
  expect_error(both, 1, "has a temperature or heat flux already");
  expect_error(run({"solve", write_file("two.json", text), "--temperatures", grid, "-o", grid}), 2,
               ".vtu");
  const std::string csv = write_file("T.csv", "patch,T\n0,300\n");
  const Outcome part =
      run({"solve", write_file("two.json", text), "--as-is", "--temperatures", csv});
  EXPECT_NE(part.err.find("tells of 1 of 2 patches"), std::string::npos) << part.err;
  expect_error(run({"solve", write_file("two.json", text), "--temperatures", csv, "-o", csv}), 1,
               "cannot be written");
  expect_error(run({"solve", RADIOSITY_SCENES "/cornell-box.json", "--quantity", "temperature"}), 1,
               "has no temperatures");
}

TEST_F(Heat, BadConditionsAreRefused) {
  const std::string square = R"("polygons": [[[0,0,0], [1,0,0], [1,1,0], [0,1,0]]])";
  const auto with = [&](const std::string& material, const std::string& rest = "") {
    return scene("", R"("m": {)" + material + "}", surface("m", rest + square));
  };
  struct Case {
    std::string text;
    std::string message;
  };
  const Case cases[] = {
      {with(R"("emissivity": 0.5, "temperature": 300, "heat_flux": 3)"),
       "emission is given twice, by \"temperature\" and by \"heat_flux\""},
      {with(R"("emissivity": 0.5, "heat_power": 3, "adiabatic": true)"),
       "emission is given twice, by \"heat_power\" and by \"adiabatic\""},
      {with(R"("emissivity": 0, "temperature": 300)"), "emissivity 0 with a temperature"},
      {with(R"("emissivity": 0, "heat_flux": 3)"), "emissivity 0 with a temperature or heat"},
      {with(R"("emissivity": 0.5, "temperature": -20)"), "-20 °C are 253.15"},
      {with(R"("emissivity": 0.5, "adiabatic": false)"), "is false"},
      {with(R"("emissivity": 0.5)", R"("shield": true, )"), "expected \"two_sided\": true"},
      {with(R"("emissivity": 0.5)", R"("back": "m", )"), "expected \"two_sided\": true"},
      {with(R"("emissivity": 0.5)", R"("back": "x", "two_sided": true, )"), "unknown material"},
      {with(R"("emissivity": 0.5, "temperature": 300)", R"("two_sided": true, "shield": true, )"),
       "is a shield, whose temperature follows from the heat"},
      {with(R"("emissivity": 0.5, "heat_flux": -3)"), "below absolute zero"},
      {scene(R"("environment": {"power": 3}, )", R"("m": {"emissivity": 1})", surface("m", square)),
       "environment"},
      {scene(R"("environment": {}, )", R"("m": {"emissivity": 1})", surface("m", square)),
       "expected one of radiance, exitance, temperature"},
      {R"({"bands": "solar-infrared", "materials": {"m": {"reflectance": 0.5, "adiabatic": true}},
           "surfaces": [)" +
           surface("m", square) + "]}",
       "would couple the bands"},
      {R"({"materials": {"m": {"reflectance": 0.5, "heat_flux": 2}}, "surfaces": [)" +
           surface("m", square) + "]}",
       "heat needs \"bands\": \"grey\""},
      {scene(R"("closed": true, )", R"("m": {"emissivity": 0.5, "heat_power": 7})",
             surface("m", cube(1, true))),
       "no surface of a floating group has a temperature and nothing leaves it: m; 7 W"}};
  for (const Case& each : cases) {
    EXPECT_NE(error_of(each.text).find(each.message), std::string::npos)
        << each.message << "\nin " << error_of(each.text);
  }
}

TEST_F(Heat, DegreesCelsiusBringAWarning) {
  const auto warned = [&](const std::string& kelvin) {
    const Outcome outcome =
        run({"solve",
             write_file("room.json",
                        scene("", R"("m": {"emissivity": 0.5, "temperature": )" + kelvin + "}",
                              surface("m", cube(1, true)))),
             "--as-is"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.err.find("are they degrees Celsius?") != std::string::npos;
  };
  EXPECT_TRUE(warned("21.5"));
  EXPECT_FALSE(warned("294.65"));
  EXPECT_FALSE(warned("4"));
}

}  // namespace
