// Form factors in the files of other solvers, read back by readers of the tests' own.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/program.h"

namespace {

using namespace radiosity::test;
using Json = nlohmann::json;
using Matrix = std::vector<std::vector<double>>;

/// Two parallel squares and one beside them that stands on one, and further a triangle.
constexpr const char* kPolygons = R"({"bands": "grey", "materials": {"m": {"emissivity": 0.5}},
  "surfaces": [
   {"name": "a", "material": "m", "polygons": [[[0,0,0],[1,0,0],[1,1,0],[0,1,0]], [[1,0,0],[2,0,0],[2,1,0],[1,1,0]]]},
   {"name": "b", "material": "m", "polygons": [[[0,0,1],[0,1,1],[1,1,1],[1,0,1]]]},
   {"name": "c", "material": "m", "polygons": [[[0,0,0],[0,1,0],[0,0,1]]]}]})";

class SolverFiles : public Program {
 protected:
  void write(const Arguments& arguments) const {
    Arguments all = {"form-factors"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Outcome outcome = run(all);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  }
};

/// A file of Elmer: for each element a count, then lines `i j F`.
Matrix read_elmer(const std::string& text, std::size_t n) {
  Matrix factors(n, std::vector<double>(n));
  std::istringstream stream(text);
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t count = 0;
    EXPECT_TRUE(stream >> count);
    for (std::size_t k = 0; k < count; ++k) {
      std::size_t from = 0;
      std::size_t to = 0;
      double factor = 0;
      EXPECT_TRUE(stream >> from >> to >> factor);
      EXPECT_EQ(from, i + 1);
      if (to < 1 || to > n) return {};
      factors[i][to - 1] = factor;
    }
  }
  std::string rest;
  EXPECT_FALSE(stream >> rest);
  return factors;
}

Matrix read_elmer_binary(const std::string& bytes) {
  std::size_t at = 0;
  const auto take = [&](auto value) {
    EXPECT_LE(at + sizeof(value), bytes.size());
    std::memcpy(&value, bytes.data() + at, sizeof(value));
    at += sizeof(value);
    return value;
  };
  const auto n = static_cast<std::size_t>(take(std::int32_t{}));
  Matrix factors(n, std::vector<double>(n));
  for (auto& row : factors) {
    for (int count = take(std::int32_t{}); count > 0; --count) {
      const auto to = static_cast<std::size_t>(take(std::int32_t{}));
      row.at(to - 1) = take(double{});
    }
  }
  EXPECT_EQ(at, bytes.size());
  return factors;
}

// Opposed unit squares at distance 1: F = 0.199824895698 (Siegel & Howell). Divided more finely the
// factors between the polygons stay, as they are exact.
TEST_F(SolverFiles, ElmerHasOneRowForEachPolygon) {
  const std::string scene = write_file("scene.json", kPolygons);
  for (const char* patches : {"--as-is", "--patches=60"}) {
    write({scene, patches, "--tolerance", "1e-6", "-o", result("ViewFactors.dat")});
    write({scene, patches, "--tolerance", "1e-6", "--format", "elmer-binary", "-o",
           result("binary.dat")});
    const Matrix text = read_elmer(contents(result("ViewFactors.dat")), 4);
    ASSERT_EQ(text.size(), 4U);
    EXPECT_NEAR(text[0][2], 0.199824895698, 1e-6) << patches;
    EXPECT_NEAR(text[2][0], 0.199824895698, 1e-6) << patches;
    EXPECT_EQ(text[0][1], 0);
    EXPECT_GT(text[3][1], 0);
    EXPECT_NEAR(0.5 * text[3][1], text[1][3], 1e-9);  // A F, the triangle being half a square
    EXPECT_EQ(read_elmer_binary(contents(result("binary.dat"))), text);
  }
}

TEST_F(SolverFiles, MooseNumbersSurfacesFromZero) {
  write({write_file("scene.json", kPolygons), "--as-is", "--format", "moose", "-o",
         result("factors.csv")});
  std::istringstream lines(contents(result("factors.csv")));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "subdomain_id,vf_to_0,vf_to_1,vf_to_2");
  double sum = 0;
  for (int s = 0; s < 3; ++s) {
    ASSERT_TRUE(std::getline(lines, line));
    std::istringstream fields(line);
    std::string field;
    std::getline(fields, field, ',');
    EXPECT_EQ(field, std::to_string(s));
    while (std::getline(fields, field, ',')) sum += std::stod(field);
  }
  EXPECT_FALSE(std::getline(lines, line));
  EXPECT_GT(sum, 0.2);
}

// Against parallel rectangles of 5 x 4 m, 2.8 m apart, in closed form (Hottel).
double opposed_rectangles(double a, double b, double c) {
  const double x = a / c;
  const double y = b / c;
  const double rx = std::sqrt(1 + x * x);
  const double ry = std::sqrt(1 + y * y);
  return 2 / (M_PI * x * y) *
         (std::log(rx * ry / std::sqrt(1 + x * x + y * y)) + x * ry * std::atan(x / ry) +
          y * rx * std::atan(y / rx) - x * std::atan(x) - y * std::atan(y));
}

TEST_F(SolverFiles, EnergyPlusGetsAllPairsOfAZone) {
  const std::string zone = RADIOSITY_SCENES "/office-zone.idf";
  write({zone, "-o", result("f.idf"), "-o", result("f.epJSON"), "--tolerance", "1e-5"});
  const Json objects =
      Json::parse(contents(result("f.epJSON"))).at("ZoneProperty:UserViewFactors:BySurfaceName");
  ASSERT_EQ(objects.size(), 1U);
  const Json object = *objects.begin();
  EXPECT_EQ(object["zone_or_zonelist_or_space_or_spacelist_name"], "Office");
  ASSERT_EQ(object["view_factors"].size(), 64U);
  std::map<std::string, std::map<std::string, double>> factor;
  for (const Json& pair : object["view_factors"]) {
    factor[pair["from_surface"]][pair["to_surface"]] = pair["view_factor"];
  }
  EXPECT_NEAR(factor["Floor"]["Roof"], opposed_rectangles(5, 4, 2.8), 1e-5);
  const std::map<std::string, double> area = {{"South wall", 14 - 4.2},
                                              {"East wall", 11.2 - 2.1},
                                              {"North wall", 14},
                                              {"West wall", 11.2},
                                              {"Floor", 20},
                                              {"Roof", 20},
                                              {"South window", 4.2},
                                              {"East door", 2.1}};
  for (const auto& [from, row] : factor) {
    double sum = 0;
    for (const auto& [to, value] : row) {
      sum += value;
      EXPECT_NEAR(area.at(from) * value, area.at(to) * factor[to][from], 1e-9) << from << to;
    }
    EXPECT_NEAR(sum, 1, 1e-9) << from;
  }
  // The text says the same.
  std::string text = contents(result("f.idf"));
  text = text.substr(text.find("ZoneProperty:UserViewFactors:BySurfaceName,"));
  EXPECT_EQ(text.substr(text.size() - 2), ";\n");
  text[text.size() - 2] = ',';
  std::vector<std::string> fields;
  std::istringstream stream(text);
  for (std::string field; std::getline(stream, field, ',');) {
    const std::size_t first = field.find_first_not_of(" \n");
    if (first != std::string::npos) fields.push_back(field.substr(first));
  }
  ASSERT_EQ(fields.size(), 2 + 3 * 64U);
  EXPECT_EQ(fields[1], "Office");
  for (std::size_t k = 2; k < fields.size(); k += 3) {
    EXPECT_NEAR(std::stod(fields[k + 2]), factor[fields[k]][fields[k + 1]], 1e-9);
  }
}

// EnergyPlus knows the space's name, not the zone's, where a zone is divided.
TEST_F(SolverFiles, EnergyPlusGetsTheSpacesOfAZone) {
  std::string text =
      "GlobalGeometryRules, UpperLeftCorner, Counterclockwise, World;\nZone, Hall;\n"
      "Zone, Loft;\nSpace, Front part, HALL;\n";
  const auto add = [&](const std::string& name, const std::string& where, int x) {
    for (const bool is_floor : {true, false}) {
      text += "BuildingSurface:Detailed, " + name + (is_floor ? " floor" : " roof") +
              ", Wall, W, " + where + ", Outdoors, , SunExposed, WindExposed, 0.5, 4";
      for (const int corner : {0, 1, 2, 3}) {
        const int along = corner == 1 || corner == 2 ? 1 : 0;
        const int across = corner / 2;
        // Seen from outside: the floor from below.
        text += ", " + std::to_string(x + (is_floor ? across : along)) + ", " +
                std::to_string(is_floor ? along : across) + (is_floor ? ", 0" : ", 1");
      }
      text += ";\n";
    }
  };
  add("A", "Hall, front PART", 0);
  add("B", "hall, ", 1);
  add("C", "Loft, ", 2);
  write({write_file("house.idf", text), "-o", result("f.epJSON")});
  const Json objects =
      Json::parse(contents(result("f.epJSON"))).at("ZoneProperty:UserViewFactors:BySurfaceName");
  std::map<std::string, std::string> first;
  for (const Json& object : objects) {
    EXPECT_EQ(object["view_factors"].size(), 4U);
    first[object["zone_or_zonelist_or_space_or_spacelist_name"]] =
        object["view_factors"][1]["to_surface"];
    EXPECT_NEAR(object["view_factors"][1]["view_factor"].get<double>(), 0.199824895698, 1e-3);
  }
  const std::map<std::string, std::string> expected{
      {"Front part", "A roof"}, {"Hall-Remainder", "B roof"}, {"Loft", "C roof"}};
  EXPECT_EQ(first, expected);
  for (const char* other : {"Cellar", "Front part"}) {
    std::string wrong = text;
    wrong.replace(wrong.find("Loft, , Outdoors"), 6, std::string("Loft, ") + other);
    expect_error(run({"form-factors", write_file("wrong.idf", wrong), "-o", result("g.idf")}), 1,
                 std::string("is in the space \"") + other + "\", which its zone \"Loft\" has not");
  }
}

/// A case of OpenFOAM of 2 x 1 x 1 cells, its mesh as written by hand: a box of 2 x 1 x 1 m.
void write_case(const fs::path& folder) {
  fs::create_directories(folder / "constant/polyMesh");
  const auto put = [&](const char* name, const char* type, const std::string& text) {
    std::ofstream(folder / "constant/polyMesh" / name)
        << "/* a head */\nFoamFile\n{\n version 2.0;\n format ascii;\n class " << type
        << ";\n object " << name << ";\n}\n// * * *\n"
        << text;
  };
  std::ofstream(folder / "case.foam") << "";
  put("points", "vectorField", R"(12
(
(0 0 0) (1 0 0) (2 0 0) (0 1 0) (1 1 0) (2 1 0)
(0 0 1) (1 0 1) (2 0 1) (0 1 1) (1 1 1) (2 1 1)
)
)");
  // One face within, then the floor's, the ceiling's, the inlet's and the rest.
  put("faces", "faceList", R"(11
(
4(1 4 10 7)
4(0 3 4 1)
4(1 4 5 2)
4(6 7 10 9)
4(7 8 11 10)
4(0 6 9 3)
4(2 5 11 8)
4(0 1 7 6)
4(1 2 8 7)
4(3 9 10 4)
4(4 10 11 5)
)
)");
  put("boundary", "polyBoundaryMesh", R"(4
(
    floor { type wall; inGroups 2(viewFactorWall wall); nFaces 2; startFace 1; }
    ceiling { type wall; inGroups List<word> 2(wall viewFactorWall); nFaces 2; startFace 3; }
    inlet { type patch; nFaces 1; startFace 5; }
    rest { type wall; inGroups (viewFactorWall); nFaces 5; startFace 6; }
)
)");
}

/// What a list of lists of OpenFOAM holds.
Matrix read_foam_lists(const std::string& text) {
  std::istringstream stream(text.substr(text.find('}') + 1));
  std::size_t n = 0;
  char bracket = 0;
  stream >> n >> bracket;
  Matrix lists(n);
  for (auto& list : lists) {
    std::size_t count = 0;
    EXPECT_TRUE(stream >> count >> bracket) << text;
    for (double value = 0; count > 0 && stream >> value; --count) list.push_back(value);
    stream >> bracket;
    EXPECT_EQ(bracket, ')');
  }
  return lists;
}

TEST_F(SolverFiles, OpenFoamGetsItsFacesInTheirOrder) {
  const fs::path folder = fs::path(result(""));
  write_case(folder);
  const std::string f = (folder / "constant/F").string();
  write({(folder / "case.foam").string(), "--as-is", "--tolerance", "1e-6", "-o", f});
  const Matrix factors = read_foam_lists(contents(f));
  const Matrix faces = read_foam_lists(contents(folder / "constant/globalFaceFaces"));
  ASSERT_EQ(factors.size(), 9U);
  ASSERT_EQ(faces.size(), 9U);
  Matrix dense(9, std::vector<double>(9));
  for (std::size_t i = 0; i < 9; ++i) {
    ASSERT_EQ(factors[i].size(), faces[i].size());
    for (std::size_t k = 0; k < faces[i].size(); ++k) {
      dense[i].at(static_cast<std::size_t>(faces[i][k])) = factors[i][k];
    }
  }
  EXPECT_NEAR(dense[0][2], 0.199824895698, 1e-6);  // floor to ceiling
  EXPECT_NEAR(dense[1][3], 0.199824895698, 1e-6);
  EXPECT_EQ(dense[0][1], 0);
  for (std::size_t i = 0; i < 9; ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < 9; ++j) {
      sum += dense[i][j];
      EXPECT_NEAR(dense[i][j], dense[j][i], 1e-9);  // all faces are alike in size
    }
    EXPECT_LT(sum, 1);  // for some goes out by the inlet
    EXPECT_GT(sum, 0.7);
  }
  const std::string map = contents(folder / "constant/mapDist");
  EXPECT_NE(map.find("class       mapDistribute;"), std::string::npos);
  EXPECT_NE(map.find("1(9(0 1 2 3 4 5 6 7 8))"), std::string::npos);
  // Without finalAgglom the model ends; of each patch each face by itself.
  const fs::path agglomeration = folder / "constant/finalAgglom";
  const Matrix single{{0, 1}, {0, 1}, {0}, {0, 1, 2, 3, 4}};
  EXPECT_EQ(read_foam_lists(contents(agglomeration)), single);
  const std::string own = contents(agglomeration) + "// the case's own\n";
  std::ofstream(agglomeration) << own;
  // More patches than faces change nothing but rounding.
  write({(folder / "case.foam").string(), "--patches", "200", "--tolerance", "1e-6", "-o", f});
  EXPECT_EQ(read_foam_lists(contents(f)).size(), 9U);
  EXPECT_EQ(contents(agglomeration), own);
}

TEST_F(SolverFiles, WhatCannotBeWrittenIsRefused) {
  const std::string scene = write_file("scene.json", kPolygons);
  const auto error = [&](const Arguments& more, int exit_code, const std::string& words) {
    Arguments all = {"form-factors", scene, "--as-is"};
    all.insert(all.end(), more.begin(), more.end());
    expect_error(run(all), exit_code, words);
  };
  error({"--format", "moose", "-o", result("F.h5")}, 2, "no output is of moose");
  error({"--format", "elmer-binary", "-o", result("a.csv")}, 2, "a file name ending in .dat");
  error({"--format", "fluent", "-o", result("a.csv")}, 2, "fluent");
  error({"--transport", "compressed", "-o", result("a.dat")}, 2, "have no rows");
  error({"-o", result("a.xyz")}, 2, "or F, in the folder constant");
  const fs::path folder = fs::path(result(""));
  error({"-o", (folder / "F").string()}, 1, "polyMesh/boundary");
  write_case(folder);
  error({"-o", (folder / "constant/F").string()}, 1,
        "the case has 9 faces that radiate, the scene 4 polygons");
  const auto agglomerate = [&](const std::string& lists) {
    std::ofstream(folder / "constant/finalAgglom") << "FoamFile { format ascii; }\n" << lists;
  };
  agglomerate("4(2(0 0) 2(0 1) 1(0) 5(0 1 2 3 4))");
  error({"-o", (folder / "constant/F").string()}, 1, "puts faces together");
  for (const char* lists : {"1(2(0 1))", "4(2(0 1) 2(0 1) 1(0) 4(0 1 2 3))"}) {
    agglomerate(lists);
    error({"-o", (folder / "constant/F").string()}, 1, "is not of this mesh");
  }
  std::string two_sided = kPolygons;
  two_sided.insert(two_sided.find("\"name\": \"b\""), "\"two_sided\": true, ");
  expect_error(run({"form-factors", write_file("two.json", two_sided), "-o", result("a.dat")}), 1,
               "surface 'b' has two sides");
  std::string comma = kPolygons;
  comma.replace(comma.find("\"b\""), 3, "\"b, c\"");
  expect_error(run({"form-factors", write_file("comma.json", comma), "-o", result("a.idf")}), 1,
               "cannot hold the name \"b, c\"");
  std::ofstream(folder / "constant/polyMesh/boundary") << "FoamFile { format binary; }\n";
  expect_error(run({"form-factors", (folder / "case.foam").string(), "-o", result("a.csv")}), 1,
               "is binary, expected ascii");
  std::ofstream(folder / "constant/polyMesh/boundary")
      << "FoamFile { format ascii; }\n1(wall { type wall; nFaces 3; startFace 0; })";
  expect_error(run({"form-factors", (folder / "case.foam").string(), "-o", result("a.csv")}), 1,
               "no patch of the group viewFactorWall");
  std::ofstream(folder / "constant/polyMesh/boundary")
      << "FoamFile { format ascii; }\n1(wall { inGroups (viewFactorWall); nFaces 30; startFace 0; "
         "})";
  expect_error(run({"form-factors", (folder / "case.foam").string(), "-o", result("a.csv")}), 1,
               "patch wall has faces up to 30, but there are 11");
}

}  // namespace
