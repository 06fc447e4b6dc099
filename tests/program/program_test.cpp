// End-to-end tests: they run the built program as a user would.

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "radiosity/assembly/dense_memory.h"
#include "tests/support/program.h"

namespace {

using namespace std::chrono_literals;
using namespace radiosity::test;
using Json = nlohmann::json;

/// A binary STL file of n x n x 2 triangles that make up a flat square.
std::string write_large_stl(const fs::path& folder, int n) {
  std::ofstream file(folder / "large.stl", std::ios::binary);
  const std::string header(80, ' ');
  file.write(header.data(), 80);
  const auto count = static_cast<std::uint32_t>(2 * n * n);
  file.write(reinterpret_cast<const char*>(&count), 4);
  const auto triangle = [&](std::array<float, 12> floats) {
    file.write(reinterpret_cast<const char*>(floats.data()), 48);
    file.write("\0\0", 2);
  };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const auto x = static_cast<float>(i);
      const auto y = static_cast<float>(j);
      triangle({0, 0, 1, x, y, 0, x + 1, y, 0, x + 1, y + 1, 0});
      triangle({0, 0, 1, x, y, 0, x + 1, y + 1, 0, x, y + 1, 0});
    }
  }
  return (folder / "large.stl").string();
}

/// Columns of a CSV file whose header starts with `name`, row by row.
std::vector<double> csv_columns(const std::string& path, const std::string& name) {
  const auto split = [](const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    return cells;
  };
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  const std::vector<std::string> header = split(line);
  std::vector<double> values;
  while (std::getline(file, line)) {
    const std::vector<std::string> cells = split(line);
    EXPECT_EQ(cells.size(), header.size()) << line;
    for (std::size_t c = 0; c < header.size() && c < cells.size(); ++c) {
      if (header[c].rfind(name, 0) == 0) values.push_back(std::stod(cells[c]));
    }
  }
  return values;
}

void expect_keys(const Json& object, const std::vector<std::string>& keys) {
  for (const std::string& key : keys) EXPECT_TRUE(object.contains(key)) << key << " in " << object;
}

TEST_F(Program, HelpAndVersionSucceed) {
  for (const Arguments& arguments : std::vector<Arguments>{{"--help"},
                                                           {"solve", "--help"},
                                                           {"inspect", "--help"},
                                                           {"render", "--help"},
                                                           {"--version"}}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_NE(outcome.out.find("radiosity"), std::string::npos) << outcome.out;
    EXPECT_EQ(outcome.err, "");
  }
}

TEST_F(Program, BadUsageExitsWithTwo) {
  const std::string scene = write_cube(0.5, 1);
  const std::vector<std::pair<Arguments, std::string>> cases = {
      {{}, "expected solve"},
      {{"--quiet", "solve", scene}, "must follow"},
      {{"slove", scene}, "did you mean 'solve'"},
      {{"solve"}, "SCENE"},
      {{"solve", scene, "--max-egde", "0.1"}, "did you mean '--max-edge'"},
      {{"solve", scene, "--quite"}, "did you mean '--quiet'"},
      {{"solve", scene, "another.obj"}, "another.obj"},
      {{"solve", scene, "--patches", "10", "--as-is"}, "--as-is"},
      {{"solve", scene, "--patches", "10", "--max-edge", "1"}, "--max-edge"},
      {{"solve", scene, "--patches", "0"}, "--patches"},
      {{"solve", scene, "--tolerance", "0"}, "--tolerance"},
      {{"solve", scene, "--tolerance", "nan"}, "--tolerance"},
      {{"solve", scene, "--method", "magic"}, "--method"},
      {{"solve", scene, "--transport", "sparse"}, "--transport"},
      {{"solve", scene, "--closed", "maybe"}, "--closed"},
      {{"solve", scene, "--unit", "parsec"}, "parsec"},
      {{"solve", scene, "--threads", "-1"}, "--threads"},
      {{"solve", scene, "-o", result("a.xyz")}, ".vtp"},
      {{"render", scene}, "--output"},
      {{"render", scene, "-o", result("a.vtp")}, ".png"},
      {{"render", scene, "-o", result("a.png"), "--samples", "3"}, "square number"}};
  for (const auto& [arguments, words] : cases) {
    SCOPED_TRACE(testing::PrintToString(arguments));
    expect_error(run(arguments), 2, words);
  }
  EXPECT_TRUE(results().empty());
}

TEST_F(Program, WhatCannotBeDoneExitsWithOne) {
  const std::string scene = write_cube(0.5, 1);
  const std::string empty = write_file("empty.obj", "# nothing\n");
  const std::vector<std::pair<Arguments, std::string>> cases = {
      {{"solve", scene, "--transport", "compressed", "--method", "gauss-seidel"},
       "--transport dense"},
      {{"solve", "no-such-scene.obj"}, "no-such-scene.obj"},
      {{"inspect", "no-such-scene.obj"}, "no-such-scene.obj"},
      {{"solve", empty}, "empty.obj"},
      {{"solve", scene, "-o", result("missing/a.csv")}, "missing"},
      {{"solve", scene, "-o", scene + "/a.csv"}, "not a folder"},
      {{"render", scene, "-o", result("missing/a.png")}, "missing"}};
  for (const auto& [arguments, words] : cases) {
    SCOPED_TRACE(testing::PrintToString(arguments));
    expect_error(run(arguments), 1, words);
  }
}

TEST_F(Program, DoesNotReplaceAFolderOrItsOwnScene) {
  fs::create_directory(result("folder.csv"));
  const std::string ply = write_file(
      "square.ply",
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n");
  const std::string before = contents(ply);
  expect_error(run({"solve", ply, "-o", result("folder.csv")}), 1, "folder");
  expect_error(run({"solve", ply, "-o", ply}), 1, "scene file");
  EXPECT_EQ(contents(ply), before);
}

TEST_F(Program, JsonOfSolveHasTheAgreedKeys) {
  const Outcome outcome = run({"solve", write_cube(0.5, 1), "--patches", "100", "--json", "-o",
                               result("a.vtp"), "-o", result("a.csv"), "-o", result("a.ply")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json json = Json::parse(outcome.out);  // throws if anything else is on stdout
  expect_keys(json, {"patches", "bands", "form_factors", "solve", "energy", "outputs", "warnings"});
  expect_keys(json["form_factors"], {"seconds", "pairs", "rays", "closure_mean", "closure_max"});
  expect_keys(json["form_factors"]["pairs"],
              {"facing", "visible", "hidden", "undecided", "partial"});
  expect_keys(json["solve"], {"method", "iterations", "residual", "error_bound", "seconds"});
  EXPECT_EQ(json["bands"], 3);
  EXPECT_GE(json["patches"], 50);
  EXPECT_EQ(json["solve"]["method"], "cg");
  EXPECT_EQ(json["outputs"], Json({result("a.vtp"), result("a.csv"), result("a.ply")}));
  EXPECT_EQ(results(), (std::vector<std::string>{"a.csv", "a.ply", "a.vtp"}));
  for (int band = 0; band < 3; ++band) {
    const double emitted = json["energy"]["emitted"][band];
    const double absorbed = json["energy"]["absorbed"][band];
    const double escaped = json["energy"]["escaped"][band];
    EXPECT_NEAR(emitted, 6 * M_PI, 1e-6);  // 6 m² of exitance π L
    EXPECT_NEAR(absorbed + escaped, emitted, 1e-6 * emitted);
  }
}

// In a closed enclosure of equal walls B = M_e / (1 - ρ) on every patch, however it is divided.
TEST_F(Program, FurnaceComesOutInTheCsvFile) {
  const std::string scene = write_cube(0.5, 1 / M_PI);
  for (const char* method : {"cg", "jacobi", "gauss-seidel", "southwell", "chebyshev"}) {
    SCOPED_TRACE(method);
    const Outcome outcome = run({"solve", scene, "--max-edge", "0.3", "--method", method,
                                 "--closed", "yes", "-o", result("a.csv")});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::vector<double> radiosity = csv_columns(result("a.csv"), "B_");
    ASSERT_GE(radiosity.size(), 3U * 6 * 16);
    // The default tolerance, 1e-2, bounds the relative error of the result.
    for (const double b : radiosity) EXPECT_NEAR(b, 2, 2e-2);
  }
}

TEST_F(Program, CompressedFormFactorsTellAVerifiedError) {
  const Outcome outcome = run({"solve", write_cube(0.5, 1 / M_PI), "--patches", "600",
                               "--transport", "compressed", "--json", "-o", result("a.csv")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json compressed = Json::parse(outcome.out)["form_factors"]["compressed"];
  EXPECT_GT(compressed["verified_error"], 0);
  EXPECT_LE(compressed["verified_error"], 1e-2);
  EXPECT_GE(compressed["rows"], 64);
  for (const double b : csv_columns(result("a.csv"), "B_")) EXPECT_NEAR(b, 2, 2e-2);
}

TEST_F(Program, AsIsKeepsEachPolygon) {
  const Outcome outcome = run({"solve", write_cube(0.5, 1), "--as-is", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(Json::parse(outcome.out)["patches"], 6);
}

TEST_F(Program, UnitScalesTheArea) {
  const Outcome outcome = run({"inspect", write_cube(0.5, 1), "--unit", "cm", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NEAR(Json::parse(outcome.out)["area"], 6e-4, 1e-12);
}

TEST_F(Program, ThreadsDoNotChangeTheResult) {
  const std::string scene = RADIOSITY_SCENES "/cornell-box.json";
  for (const char* threads : {"1", "2"}) {
    const Outcome outcome = run({"solve", scene, "--patches", "60", "--threads", threads, "-o",
                                 result(std::string(threads) + ".csv")});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }
  EXPECT_EQ(contents(result("1.csv")), contents(result("2.csv")));
}

TEST_F(Program, SceneWithoutLightIsDark) {
  const Outcome outcome =
      run({"solve", write_cube(0.5, 0), "--patches", "50", "--json", "-o", result("a.csv")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("radiosity: warning: no surface emits"), std::string::npos);
  const Json json = Json::parse(outcome.out);
  EXPECT_NE(json["warnings"].dump().find("no surface emits"), std::string::npos);
  EXPECT_EQ(json["energy"]["emitted"], Json({0.0, 0.0, 0.0}));
  for (const double b : csv_columns(result("a.csv"), "B_")) EXPECT_EQ(b, 0);
}

// In a closed enclosure the heat that one surface loses by radiation is what the others gain.
TEST_F(Program, ThermalSceneTellsNetHeat) {
  const std::string scene = write_file("oven.json", R"({
    "bands": "grey", "closed": true,
    "materials": {"hot": {"reflectance": 0.2, "temperature": 500},
                  "cold": {"reflectance": 0.2, "temperature": 300}},
    "surfaces": [
      {"name": "floor", "material": "hot", "polygons": [[[0,0,0], [1,0,0], [1,1,0], [0,1,0]]]},
      {"name": "rest", "material": "cold", "polygons": [
        [[0,0,1], [0,1,1], [1,1,1], [1,0,1]], [[0,0,0], [0,0,1], [1,0,1], [1,0,0]],
        [[0,1,0], [1,1,0], [1,1,1], [0,1,1]], [[0,0,0], [0,1,0], [0,1,1], [0,0,1]],
        [[1,0,0], [1,0,1], [1,1,1], [1,1,0]]]}]})");
  const Outcome outcome = run({"solve", scene, "--patches", "100", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json surfaces = Json::parse(outcome.out)["surfaces"];
  ASSERT_EQ(surfaces.size(), 2U);
  EXPECT_EQ(surfaces[0]["name"], "floor");
  const double lost = surfaces[0]["net_heat"];
  const double black = 5.670374419e-8 * (std::pow(500, 4) - std::pow(300, 4));
  EXPECT_GT(lost, 0);
  EXPECT_LT(lost, black);  // per square metre, what two black planes would exchange
  EXPECT_NEAR(surfaces[1]["net_heat"].get<double>(), -lost, 1e-6 * lost);
  EXPECT_NEAR(surfaces[1]["net_flux"].get<double>(), -lost / 5, 1e-6 * lost);
}

constexpr double kStefanBoltzmann = 5.670374419e-8;  // W/(m² K⁴)

/// Net heat of the surfaces of a thermal scene whose polygons are one patch each, W.
std::vector<double> net_heats(const Outcome& outcome) {
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  std::vector<double> heats;
  const Json json = Json::parse(outcome.out);
  for (const Json& surface : json.at("surfaces")) heats.push_back(surface.at("net_heat"));
  return heats;
}

// Two plates and adiabatic walls, which pass on what they receive (Hottel & Sarofim 1967). With one
// patch a wall, all of them are equal by symmetry, so that the zones' formula is exact.
TEST_F(Program, PlatesBetweenAdiabaticWalls) {
  const std::string scene = write_file("plates.json", R"({
    "bands": "grey", "closed": true,
    "materials": {"hot": {"emissivity": 0.8, "temperature": 500},
                  "cold": {"emissivity": 0.4, "temperature": 300},
                  "adiabatic": {"emissivity": 0}},
    "surfaces": [
      {"name": "floor", "material": "hot", "polygons": [[[0,0,0], [1,0,0], [1,1,0], [0,1,0]]]},
      {"name": "ceiling", "material": "cold", "polygons": [[[0,0,1], [0,1,1], [1,1,1], [1,0,1]]]},
      {"name": "walls", "material": "adiabatic", "polygons": [
        [[0,0,0], [0,0,1], [1,0,1], [1,0,0]], [[0,1,0], [1,1,0], [1,1,1], [0,1,1]],
        [[0,0,0], [0,1,0], [0,1,1], [0,0,1]], [[1,0,0], [1,0,1], [1,1,1], [1,1,0]]]}]})");
  const std::vector<double> heats = net_heats(run({"solve", scene, "--as-is", "--json"}));
  ASSERT_EQ(heats.size(), 3U);
  const double f = 0.199824895698387383;  // tests/data/form-factors.json: cube interior
  const double direct_and_by_the_walls = f + (1 - f) / 2;
  const double expected = kStefanBoltzmann * (std::pow(500, 4) - std::pow(300, 4)) /
                          (0.2 / 0.8 + 1 / direct_and_by_the_walls + 0.6 / 0.4);
  EXPECT_NEAR(heats[0], expected, 1e-7 * expected);
  EXPECT_NEAR(heats[1], -expected, 1e-7 * expected);
  EXPECT_NEAR(heats[2], 0, 1e-7 * expected);
}

// q = σ (T1⁴ - T2⁴) / ((1 - ε1)/(A1 ε1) + 1/(A1 F12) + (1 - ε2)/(A2 ε2)) with F12 = 1.
TEST_F(Program, CubeInACubeIsATwoSurfaceEnclosure) {
  const std::string scene = write_file("cubes.json", R"({
    "bands": "grey", "closed": true,
    "materials": {"inner": {"emissivity": 0.3, "temperature": 500},
                  "outer": {"emissivity": 0.6, "temperature": 300}},
    "surfaces": [
      {"name": "inner", "material": "inner",
       "vertices": [[1,1,1], [2,1,1], [2,2,1], [1,2,1], [1,1,2], [2,1,2], [2,2,2], [1,2,2]],
       "polygons": [[0,3,2,1], [4,5,6,7], [0,1,5,4], [3,7,6,2], [0,4,7,3], [1,2,6,5]]},
      {"name": "outer", "material": "outer",
       "vertices": [[0,0,0], [3,0,0], [3,3,0], [0,3,0], [0,0,3], [3,0,3], [3,3,3], [0,3,3]],
       "polygons": [[0,1,2,3], [4,7,6,5], [0,4,5,1], [3,2,6,7], [0,3,7,4], [1,5,6,2]]}]})");
  const std::vector<double> heats =
      net_heats(run({"solve", scene, "--as-is", "--json", "--tolerance", "1e-3"}));
  ASSERT_EQ(heats.size(), 2U);
  const double inner = 6;   // m²
  const double outer = 54;  // m²
  const double expected = kStefanBoltzmann * (std::pow(500, 4) - std::pow(300, 4)) /
                          (0.7 / (inner * 0.3) + 1 / inner + 0.4 / (outer * 0.6));
  // The faces of a cube are alike by symmetry. Sampled factors disturb it by their error δ of about
  // 1e-3, which closure and reciprocity leave in the heat to second order only.
  EXPECT_NEAR(heats[0], expected, 1e-5 * expected);
  EXPECT_NEAR(heats[1], -expected, 1e-5 * expected);
}

TEST_F(Program, FactorsFromAPointAreExact) {
  const std::string scene = RADIOSITY_SCENES "/opposed-squares.json";
  const Outcome outcome = run(
      {"form-factors", scene, "--from", "0,0,0,0,0,2", "--json", "--quiet", "-o", result("f.csv")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json json = Json::parse(outcome.out);
  expect_keys(json, {"from", "factors", "backs", "backs_error", "sky", "sky_error", "sum",
                     "outputs", "warnings"});
  const double expected = 0.138531605994892997;  // tests/data/form-factors.json
  EXPECT_EQ(json["from"], "0,0,0,0,0,2");
  EXPECT_EQ(json["factors"][0]["factor"], 0.0);
  EXPECT_EQ(json["factors"][1]["surface"], "target");
  EXPECT_NEAR(json["factors"][1]["factor"].get<double>(), expected, 1e-14);
  EXPECT_EQ(json["factors"][1]["error"], 0.0);
  EXPECT_NEAR(json["sky"].get<double>(), 1 - expected, 1e-14);
  EXPECT_NEAR(json["sum"].get<double>(), 1, 1e-14);
  EXPECT_EQ(
      contents(result("f.csv")).rfind("destination,surface,factor,error\nsurface,source,0,0\n", 0),
      0U);
  const std::vector<double> column = csv_columns(result("f.csv"), "factor");
  ASSERT_EQ(column.size(), 4U);  // two surfaces, backs, sky
  EXPECT_EQ(column[1], json["factors"][1]["factor"].get<double>());
  EXPECT_EQ(column[3], json["sky"].get<double>());
}

TEST_F(Program, FactorsFromASurfaceByName) {
  // Its name looks like a point, and the name counts.
  const std::string scene = write_file("plates.json", R"({
    "bands": "grey", "materials": {"black": {"reflectance": 0}},
    "surfaces": [
      {"name": "0,0,0,0,0,1", "material": "black",
       "polygons": [[[0,0,0], [1,0,0], [1,1,0], [0,1,0]]]},
      {"name": "target", "material": "black",
       "polygons": [[[0,0,1], [0,1,1], [1,1,1], [1,0,1]]]}]})");
  const Outcome outcome =
      run({"form-factors", scene, "--from", "0,0,0,0,0,1", "--patches", "60", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json json = Json::parse(outcome.out);
  EXPECT_NEAR(json["factors"][1]["factor"].get<double>(), 0.199824895698387383, 1e-8);
  const double sigma = json["sky_error"];
  EXPECT_GT(sigma, 0);
  EXPECT_LT(sigma, 1e-3);
  EXPECT_NEAR(json["sky"].get<double>(), 1 - 0.199824895698387383, 5.5 * sigma);
  EXPECT_EQ(json["backs"], 0.0);
  const Outcome text = run({"form-factors", scene, "--from", "target", "--as-is", "--quiet"});
  EXPECT_NE(text.out.find("(sky)"), std::string::npos) << text.out;
}

TEST_F(Program, FactorsFromRefusesWhatItCannotMean) {
  const std::string scene = RADIOSITY_SCENES "/opposed-squares.json";
  const auto outcome = [&](const std::string& from) {
    return run({"form-factors", scene, "--from", from});
  };
  expect_error(outcome("sourse"), 1, "nearest is 'source'");
  expect_error(outcome(""), 1, "no surface ''");
  expect_error(outcome("1,2,3"), 2, "found 3 numbers");
  expect_error(outcome("1,2,3,0,0,0"), 2, "normal is zero");
  expect_error(outcome("1,2,3,0,0,up"), 2, "'up' is not a number");
  expect_error(run({"form-factors", scene, "--from", "source", "-o", result("a.h5")}), 2, ".csv");
  expect_error(run({"form-factors", scene, "--from", "source", "--by", "surface"}), 2, "--by");
  expect_error(run({"form-factors", scene}), 2, "--output");
  EXPECT_TRUE(results().empty());
}

TEST_F(Program, FormFactorsGoToFilesAndByName) {
  const Outcome outcome = run({"form-factors", write_cube(0.5, 1), "--as-is", "--by", "surface",
                               "--json", "--quiet", "-o", result("f.h5"), "-o", result("f.csv")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json json = Json::parse(outcome.out);
  EXPECT_EQ(json.at("patches"), 6);
  EXPECT_TRUE(json.at("form_factors").at("closed"));
  // The cube is one surface: it sees itself and nothing else.
  ASSERT_EQ(json.at("surfaces").size(), 1U);
  EXPECT_NEAR(json.at("surfaces").at(0).at("form_factors").at(0).get<double>(), 1, 1e-12);
  EXPECT_EQ(results(), (std::vector<std::string>{"f.csv", "f.h5"}));
  EXPECT_EQ(run({"form-factors", write_cube(0.5, 1), "-o", result("f.vtp")}).exit_code, 2);
}

TEST_F(Program, QuietShowsNoProgress) {
  const Outcome loud = run({"solve", write_cube(0.5, 1), "--patches", "50"});
  const Outcome quiet = run({"solve", write_cube(0.5, 1), "--patches", "50", "--quiet"});
  EXPECT_NE(loud.err.find("form factors"), std::string::npos) << loud.err;
  EXPECT_EQ(quiet.err, "");
  EXPECT_NE(quiet.out.find("patches"), std::string::npos) << quiet.out;
}

TEST_F(Program, RefusesWhatDoesNotFitIntoMemory) {
  constexpr int kSide = 448;  // 401 408 triangles
  const auto machine = static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES)) *
                       static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  if (radiosity::dense_transport_bytes(2 * kSide * kSide) < machine) {
    GTEST_SKIP() << "this machine has room for it";
  }
  const std::string scene = write_large_stl(folder(), kSide);
  expect_error(run({"solve", scene, "--as-is", "--transport", "dense", "--quiet"}), 1, " GB");
  const std::string cube = write_cube(0.5, 1);
  expect_error(run({"solve", cube, "--max-edge", "1e-4", "--quiet"}), 1, " GB compressed");
  expect_error(run({"solve", cube, "--max-edge", "1e-4", "--quiet"}), 1, "--patches");
}

TEST_F(Program, InspectTellsCountsAndFindings) {
  const Outcome outcome = run({"inspect", write_cube(0.5, 1), "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json json = Json::parse(outcome.out);
  expect_keys(json,
              {"vertices", "polygons", "triangles", "quads", "other", "area", "bounds", "precision",
               "parts", "closed", "boundary_edges", "surfaces", "findings", "warnings"});
  EXPECT_EQ(json["polygons"], 6);
  EXPECT_EQ(json["quads"], 6);
  EXPECT_NEAR(json["area"], 6, 1e-12);
  EXPECT_EQ(json["bounds"]["max"], Json({1.0, 1.0, 1.0}));
  EXPECT_EQ(json["closed"], true);
  EXPECT_EQ(json["surfaces"][0]["polygons"], 6);
}

TEST_F(Program, InspectSucceedsWithFindings) {
  const std::string scene = write_file("flawed.obj",
                                       "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                                       "f 1 2 3 4\nf 1 2 3\nf 1 2 3 4\nf 1 2 2\n");
  const Outcome json = run({"inspect", scene, "--json"});
  ASSERT_EQ(json.exit_code, 0) << json.err;
  const Json findings = Json::parse(json.out)["findings"];
  const std::string warnings = Json::parse(json.out)["warnings"].dump();
  EXPECT_NE(warnings.find("polygon 2"), std::string::npos) << warnings;  // the same as another
  EXPECT_NE(warnings.find("polygon 3"), std::string::npos) << warnings;  // without area
  ASSERT_FALSE(findings.empty());
  expect_keys(findings[0], {"kind", "severity", "surface", "polygon", "count", "message"});
  const Outcome text = run({"inspect", scene});
  EXPECT_EQ(text.exit_code, 0);
  EXPECT_NE(text.out.find(findings[0]["kind"].get<std::string>()), std::string::npos) << text.out;
}

TEST_F(Program, StrictReadingRefusesFaults) {
  const std::string scene = write_file("flawed.obj",
                                       "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                                       "f 1 2 3 4\nf 1 2 2\n");
  for (const Arguments& command :
       std::vector<Arguments>{{"inspect", scene},
                              {"solve", scene, "--as-is"},
                              {"form-factors", scene, "--as-is", "-o", result("F.csv")}}) {
    EXPECT_EQ(run(command).exit_code, 0) << command[0];
    Arguments strict = command;
    strict.emplace_back("--strict");
    strict.emplace_back("--quiet");
    expect_error(run(strict), 1, "1 polygon encloses no area");
  }
}

TEST_F(Program, OverlapsInOnePlaneAreNamed) {
  const std::string scene = RADIOSITY_TEST_DATA "/accuracy/overlapping-panels.json";
  for (const Arguments& command :
       std::vector<Arguments>{{"solve", scene, "--patches", "100", "--json"},
                              {"form-factors", scene, "--patches", "100", "-o", result("F.h5")}}) {
    // Refused, or the overlap named and the energy balanced.
    const Outcome outcome = run(command);
    EXPECT_LE(outcome.exit_code, 1) << outcome.err;
    if (outcome.exit_code == 0 && command[0] == "solve") {
      const Json energy = Json::parse(outcome.out)["energy"];
      EXPECT_GE(energy["escaped"][0], -1e-6 * energy["emitted"][0].get<double>());
    }
    EXPECT_NE(outcome.err.find("'panels'"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("lies in the plane of surface 'walls'"), std::string::npos)
        << outcome.err;
    EXPECT_EQ(outcome.err.find("--method"), std::string::npos) << outcome.err;
  }
}

TEST_F(Program, RenderWritesAPicture) {
  const Outcome outcome = run({"render", write_cube(0.5, 1), "--patches", "100", "-o",
                               result("a.png"), "--width", "40", "--height", "30"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("no camera"), std::string::npos) << outcome.err;
  EXPECT_EQ(results(), std::vector<std::string>{"a.png"});
  const std::string png = contents(result("a.png"));
  ASSERT_GT(png.size(), 24U);
  EXPECT_EQ(png.substr(1, 3), "PNG");
  EXPECT_EQ(png.substr(16, 8), std::string("\0\0\0\x28\0\0\0\x1e", 8));  // IHDR: width, height
}

TEST_F(Program, RefinesUntilTheToleranceIsMetOrThePatchesAreSpent) {
  const std::string scene = RADIOSITY_SCENES "/cornell-box.json";
  const Outcome met =
      run({"solve", scene, "--adaptive", "--tolerance", "0.15", "--json", "--quiet"});
  ASSERT_EQ(met.exit_code, 0) << met.err;
  const Json accurate = Json::parse(met.out);
  EXPECT_TRUE(accurate["refinement"]["accurate"]);
  EXPECT_LE(accurate["refinement"]["error"], 0.15);
  EXPECT_GT(accurate["discretisation"]["error"], 0);
  EXPECT_TRUE(accurate["warnings"].empty());

  const Outcome spent = run({"solve", scene, "--adaptive", "--tolerance", "1e-4", "--patches",
                             "500", "--json", "--quiet"});
  ASSERT_EQ(spent.exit_code, 0) << spent.err;
  const Json coarse = Json::parse(spent.out);
  EXPECT_FALSE(coarse["refinement"]["accurate"]);
  EXPECT_LE(coarse["patches"], 600);
  EXPECT_NE(spent.err.find("are spent"), std::string::npos) << spent.err;

  const Outcome compressed =
      run({"solve", scene, "--adaptive", "--tolerance", "0.15", "--transport", "compressed",
           "--patches", "1000000", "--json", "--quiet"});
  ASSERT_EQ(compressed.exit_code, 0) << compressed.err;
  const Json made = Json::parse(compressed.out);
  EXPECT_TRUE(made["refinement"]["accurate"]);
  EXPECT_LE(made["form_factors"]["compressed"]["verified_error"], 0.15);

  EXPECT_EQ(run({"solve", scene, "--adaptive", "--as-is"}).exit_code, 2);
  EXPECT_EQ(run({"solve", scene, "--adaptive", "--max-edge", "0.1"}).exit_code, 2);
}

TEST_F(Program, SaysWhatAPatchAloneOnItsSurfaceCannotTell) {
  const Outcome outcome = run({"solve", write_cube(0.5, 1), "--as-is", "--quiet"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("one patch only"), std::string::npos) << outcome.err;
}

// The walls are what counts, though a ball of many facets hangs between them.
TEST_F(Program, SaysWhenMostLightIsThatOfPatchesAloneOnTheirSurfaces) {
  constexpr int kSides = 24;
  Json scene = Json::parse(contents(fs::path(RADIOSITY_SCENES) / "furnace-cube.json"));
  Json& ball = scene["surfaces"].emplace_back(
      Json{{"name", "ball"}, {"material", "wall"}, {"polygons", {}}});
  const auto corner = [](int row, int column) {
    const double latitude = M_PI * (row / 12. - 0.5);
    const double longitude = 2 * M_PI * (column % kSides) / kSides;
    const double r = 0.05 * std::cos(latitude);
    return Json{0.5 + r * std::cos(longitude), 0.5 + r * std::sin(longitude),
                0.5 + 0.05 * std::sin(latitude)};
  };
  for (int row = 1; row < 11; ++row) {
    for (int k = 0; k < kSides; ++k) {
      ball["polygons"].push_back(
          {corner(row, k), corner(row, k + 1), corner(row + 1, k + 1), corner(row + 1, k)});
    }
  }
  const std::string path = write_file("ball.json", scene.dump());
  const Outcome coarse = run({"solve", path, "--as-is", "--quiet"});
  ASSERT_EQ(coarse.exit_code, 0) << coarse.err;
  EXPECT_NE(coarse.err.find("% of the reflected light is that of surfaces of one patch only"),
            std::string::npos)
      << coarse.err;
  const Outcome fine = run({"solve", path, "--patches", "800", "--quiet"});
  ASSERT_EQ(fine.exit_code, 0) << fine.err;
  EXPECT_EQ(fine.err.find("one patch only"), std::string::npos) << fine.err;
}

TEST_F(Program, TellsWhenStandardOutputIsFull) {
  if (!fs::exists("/dev/full")) GTEST_SKIP();
  fs::create_symlink("/dev/full", folder() / "printed" / "stdout");
  const Outcome outcome = run({"inspect", write_cube(0.5, 1), "--quiet"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("standard output"), std::string::npos) << outcome.err;
}

/// Starts a job of at least half a minute, sends the signals as soon as the first of its many
/// rounds is told, and expects it to end long before.
class Interrupt : public Program {
 protected:
  void expect_interrupted_by(const std::vector<int>& signals) const {
    const std::string scene = RADIOSITY_TEST_DATA "/cornell-box/patches-8x8.obj";
    const Running running = start({"solve", scene, "--adaptive", "--patches", "20000",
                                   "--tolerance", "1e-4", "-o", result("a.csv")});
    EXPECT_TRUE(running.has_told("radiosity: form factors: "));
    const auto sent = std::chrono::steady_clock::now();
    for (const int signal : signals) running.send(signal);
    const Outcome outcome = running.wait();
    // The program promises one second; a crowded machine gets some more.
    EXPECT_LT(std::chrono::steady_clock::now() - sent, 4s);
    EXPECT_EQ(outcome.exit_code, 130) << outcome.err;
    EXPECT_NE(outcome.err.find("radiosity: interrupted"), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_TRUE(results().empty());
  }
};

TEST_F(Interrupt, ByControlC) { expect_interrupted_by({SIGINT}); }
TEST_F(Interrupt, ByTermination) { expect_interrupted_by({SIGTERM}); }
TEST_F(Interrupt, ByTwoSignals) { expect_interrupted_by({SIGINT, SIGTERM}); }

}  // namespace
