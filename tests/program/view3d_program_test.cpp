// Form factors as View3D writes them, against what it printed.

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/program.h"

namespace {

using namespace radiosity::test;

using View3d = Program;

struct View3dFile {
  std::string header;
  std::vector<std::vector<double>> lines;  // areas, a row for each surface, emissivities
};

View3dFile read_view3d(const fs::path& path) {
  std::ifstream file(path);
  View3dFile result;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with('#')) continue;
    if (result.header.empty()) {
      result.header = line;
      continue;
    }
    std::istringstream words(line);
    std::vector<double> numbers;
    for (double number = 0; words >> number;) numbers.push_back(number);
    result.lines.push_back(numbers);
  }
  return result;
}

/// Of rectangles that share an edge, 3 m long and 1 m wide to 3 and 2 m: closed forms (Howell's
/// catalogue, C-14), from which View3D is 5e-6 and 3e-6 off.
constexpr double kBesideLong = 0.33946324;
constexpr double kBesideShort = 0.31899670;
/// Of pairs that are partly hidden it is further off: rows of its table that sum to 1 as ours do
/// have 1.1e-5 more of one wall, and as much less of others.
constexpr double kTheirError = 1.2e-5;

/// The room of tests/data/view3d/l-room.txt, from within.
std::string l_room() {
  const std::vector<std::string> corners = {"0, 0", "3, 0", "3, 1", "1, 1", "1, 3", "0, 3"};
  std::string surfaces;
  std::string floor;
  std::string ceiling;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const std::string& from = corners[k];
    const std::string& to = corners[(k + 1) % corners.size()];
    surfaces += R"({"name": "wall )" + std::to_string(k + 1) +
                R"(", "material": "m", "polygons": [[[)" + to + ", 0], [" + from + ", 0], [" +
                from + ", 3], [" + to + ", 3]]]},";
    floor += (k > 0 ? ", [" : "[") + from + ", 0]";
    ceiling = "[" + from + ", 3]" + (k > 0 ? ", " : "") + ceiling;
  }
  return R"({"bands": "grey", "closed": true, "materials": {"m": {"emissivity": 0.9}}, "surfaces": [)" +
         surfaces + R"({"name": "floor", "material": "m", "polygons": [[)" + floor +
         R"(]]}, {"name": "ceiling", "material": "m", "polygons": [[)" + ceiling + "]]}]}";
}

void expect_same(const View3dFile& ours, const View3dFile& theirs, double tolerance) {
  EXPECT_EQ(ours.header, theirs.header);
  ASSERT_EQ(ours.lines.size(), theirs.lines.size());
  for (std::size_t k = 0; k < ours.lines.size(); ++k) {
    ASSERT_EQ(ours.lines[k].size(), theirs.lines[k].size()) << k;
    for (std::size_t j = 0; j < ours.lines[k].size(); ++j) {
      EXPECT_NEAR(ours.lines[k][j], theirs.lines[k][j], tolerance) << k << ", " << j;
    }
  }
}

TEST_F(View3d, HasTheSameFactorsOfAnLShapedRoom) {
  const Outcome outcome = run({"form-factors", write_file("l.json", l_room()), "--as-is",
                               "--tolerance", "1e-7", "--quiet", "-o", result("l.txt")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const View3dFile ours = read_view3d(result("l.txt"));
  const View3dFile theirs = read_view3d(RADIOSITY_TEST_DATA "/view3d/l-room.txt");
  ASSERT_NO_FATAL_FAILURE(expect_same(ours, theirs, kTheirError));
  EXPECT_NEAR(ours.lines[2][0], kBesideLong, 0.5e-6);
  EXPECT_NEAR(ours.lines[2][2], kBesideShort, 0.5e-6);
}

/// Corners of the walls of that room from within, counter-clockwise, 3 m high.
const std::vector<std::array<int, 2>> kCorners = {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};

/// The room with vertices (F 3) or planes (F 3a); floor and ceiling are three squares or oblongs.
std::string l_room_vs3(const std::string& geometry, const std::string& control) {
  const std::vector<std::array<int, 4>> oblongs = {{0, 0, 1, 1}, {0, 1, 1, 3}, {1, 0, 3, 1}};
  std::string vertices;
  std::string surfaces;
  int n_vertices = 0;
  int n_surfaces = 0;
  const auto begin = [&] { surfaces += "S " + std::to_string(++n_surfaces); };
  const auto add = [&](const std::vector<std::array<int, 3>>& corners, int combined) {
    begin();
    for (const auto& [x, y, z] : corners) {
      vertices += "V " + std::to_string(++n_vertices) + " " + std::to_string(x) + ". " +
                  std::to_string(y) + " " + std::to_string(z) + "\n";
      surfaces += " " + std::to_string(n_vertices);
    }
    surfaces += " 0 " + std::to_string(combined) + " 0.90 srf ! a comment\n";
  };
  for (std::size_t k = 0; k < kCorners.size(); ++k) {
    const auto& [x, y] = kCorners[k];
    const auto& [u, v] = kCorners[(k + 1) % kCorners.size()];
    if (geometry == "3") {
      add({{u, v, 0}, {x, y, 0}, {x, y, 3}, {u, v, 3}}, 0);
    } else {
      const int azimuth = u > x ? 0 : v > y ? 270 : u < x ? 180 : 90;
      begin();
      surfaces += " R 0 0 0.9 srf\n " + std::to_string(u) + " " + std::to_string(v) + " 0 " +
                  std::to_string(azimuth) + " 90 " +
                  std::to_string(std::abs(u - x) + std::abs(v - y)) + " 3\n";
    }
  }
  for (const bool is_floor : {true, false}) {
    const int first = n_surfaces + 1;
    for (const auto& [x, y, u, v] : oblongs) {
      const int combined = n_surfaces + 1 == first ? 0 : first;
      if (geometry == "3") {
        if (is_floor) add({{x, y, 0}, {u, y, 0}, {u, v, 0}, {x, v, 0}}, combined);
        if (!is_floor) add({{x, y, 3}, {x, v, 3}, {u, v, 3}, {u, y, 3}}, combined);
      } else {
        begin();
        // Looking down x runs the other way.
        const int left = is_floor ? x : 3 - u;
        const int right = is_floor ? u : 3 - x;
        surfaces += " Q 0 " + std::to_string(combined) + " 0.9 srf\n" +
                    (is_floor ? "0 0 0 180 0\n" : "3 0 3 0 180\n");
        for (const auto& [a, b] :
             std::vector<std::array<int, 2>>{{left, y}, {right, y}, {right, v}, {left, v}}) {
          surfaces += " " + std::to_string(a) + ". " + std::to_string(b);
        }
        surfaces += "\n";
      }
    }
  }
  return "T an L\nC " + control + "\nF " + geometry + "\n" + vertices + surfaces + "End of data\n";
}

class Vs3Program : public Program {
 protected:
  View3dFile factors_of(const std::string& vs3) const {
    const Outcome outcome = run({"form-factors", write_file("a.vs3", vs3), "--as-is", "--tolerance",
                                 "1e-7", "--quiet", "-o", result("a.txt")});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return read_view3d(result("a.txt"));
  }
  static View3dFile reference(const std::string& name) {
    return read_view3d(RADIOSITY_TEST_DATA "/view3d/" + name);
  }
};

TEST_F(Vs3Program, GivesWhatView3dGivesOfAnLShapedRoom) {
  for (const char* geometry : {"3", "3a"}) {
    SCOPED_TRACE(geometry);
    expect_same(factors_of(l_room_vs3(geometry, "encl=1 list=2 eps=1.e-6")),
                reference("l-room.txt"), kTheirError);
  }
}

/// From the factors that View3D printed with a criterion of 1e-6, by Gebhart's equations one
/// reflection after the other; what these are off by grows by 1 / (1 - 0.1) at most. View3D's own
/// script-F is of a run with 1e-4, which is up to 1.5e-4 off.
TEST_F(Vs3Program, GivesScriptF) {
  constexpr double kEmissivity = 0.9;
  const View3dFile ours = factors_of(l_room_vs3("3", "encl=1, emit=1"));
  View3dFile expected = reference("l-room.txt");
  expected.header = ours.header;
  Eigen::MatrixXd factors(8, 8);
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < 8; ++j) factors(i, j) = expected.lines[1 + i][j];
  }
  Eigen::MatrixXd absorbed = Eigen::MatrixXd::Zero(8, 8);
  Eigen::MatrixXd arriving = factors;
  for (int k = 0; k < 10; ++k) {
    absorbed += kEmissivity * arriving;
    arriving = (1 - kEmissivity) * factors * arriving;
  }
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < 8; ++j) expected.lines[1 + i][j] = kEmissivity * absorbed(i, j);
  }
  expect_same(ours, expected, kTheirError / kEmissivity);
  expect_same(ours, reference("l-room-script-f.txt"), 1.5e-4);
}

constexpr const char* kSquares =
    "F 3\nV 1 0 0 0\nV 2 1 0 0\nV 3 1 1 0\nV 4 0 1 0\nV 5 0 0 1\nV 6 1 0 1\nV 7 1 1 1\nV 8 0 1 1\n"
    "V 9 0 0 .5\nV 10 .5 0 .5\nV 11 .5 .5 .5\nV 12 0 .5 .5\n"
    "S 1 1 2 3 4 0 0 .5 low\nS 2 7 6 5 8 0 0 .5 high\n";

TEST_F(Vs3Program, GivesWhatView3dGivesBehindAnObstruction) {
  const View3dFile theirs = reference("square-obstruction.txt");
  const View3dFile radiating = factors_of(kSquares + std::string("S 3 9 10 11 12 0 0 .5 mid\n"));
  expect_same(radiating, theirs, kTheirError);
  // An obstruction shades as much and has no row.
  const View3dFile shaded = factors_of(kSquares + std::string("O 3 9 10 11 12\n"));
  ASSERT_EQ(shaded.lines.size(), 4U);
  EXPECT_EQ(shaded.header, "View3D 4.0.0 0 0 0 2          ");
  EXPECT_EQ(shaded.lines[1], (std::vector<double>{0, radiating.lines[1][1]}));
  EXPECT_EQ(shaded.lines[2], (std::vector<double>{radiating.lines[2][0], 0}));
}

/// Factors to a floor are those to its part and to the rest of it, and a hole gets its own.
TEST_F(Vs3Program, SharesTheFactorsOfABase) {
  const std::string part =
      kSquares + std::string("V 13 .25 .25 0\nV 14 .75 .25 0\nV 15 .5 .75 0\n");
  const View3dFile whole = factors_of(part);
  const View3dFile parts = factors_of(part + "S 3 13 14 15 0 1 0 .5 part\n");
  const View3dFile holed = factors_of(part + "N 3 15 14 13 0 1 0 .5 hole\n");
  ASSERT_EQ(parts.lines.size(), 5U);
  ASSERT_EQ(holed.lines.size(), 4U);
  EXPECT_EQ(parts.lines[0], (std::vector<double>{0.875, 1, 0.125}));
  EXPECT_EQ(holed.lines[0], (std::vector<double>{0.875, 1}));
  constexpr double kDecimals = 2e-6;  // of numbers with six of them
  const std::vector<double>& from_high = parts.lines[2];
  EXPECT_NEAR(from_high[0] + from_high[2], whole.lines[2][0], kDecimals);
  EXPECT_NEAR(from_high[0], holed.lines[2][0], kDecimals);
  // Opposed unit squares 1 apart: Howell's catalogue, C-11.
  EXPECT_NEAR(whole.lines[2][0], 0.19982490, 1e-6);
}

/// A mask faces what it covers of its base, which nothing else sees: the base exchanges with others
/// what it does with a hole there.
TEST_F(Vs3Program, GivesWhatView3dGivesOfAMask) {
  const std::string part =
      kSquares + std::string("V 13 .25 .25 0\nV 14 .75 .25 0\nV 15 .5 .75 0\n");
  const View3dFile masked = factors_of(part + "M 3 15 14 13 0 1 0 .5 mask\n");
  expect_same(masked, reference("mask.txt"), kTheirError);
  const View3dFile holed = factors_of(part + "N 3 15 14 13 0 1 0 .5 hole\n");
  constexpr double kDecimals = 2e-6;  // of numbers with six of them
  EXPECT_NEAR(masked.lines[1][1], 0.875 * holed.lines[1][1], kDecimals);
  EXPECT_NEAR(masked.lines[2][0], holed.lines[2][0], kDecimals);
  // Of all of its base it sees all, and is seen by nothing else.
  const View3dFile covered = factors_of(kSquares + std::string("M 3 4 3 2 1 1 0 .5 mask\n"));
  EXPECT_EQ(covered.lines[1], (std::vector<double>{0, 0, 1}));
  EXPECT_EQ(covered.lines[2], (std::vector<double>{0, 0, 0}));
  EXPECT_EQ(covered.lines[3], (std::vector<double>{1, 0, 0}));
}

// Turned, moved and with six digits, as files have them.
TEST_F(Vs3Program, MasksMayBeRounded) {
  const Eigen::AngleAxisd turn(0.7, Eigen::Vector3d(1, -2, 3).normalized());
  const double corners[11][3] = {{0, 0, 0},     {1, 0, 0},     {1, 1, 0},   {0, 1, 0},
                                 {0, 0, 1},     {1, 0, 1},     {1, 1, 1},   {0, 1, 1},
                                 {.25, .25, 0}, {.75, .25, 0}, {.5, .75, 0}};
  std::string vs3 = "F 3\n";
  for (int k = 0; k < 11; ++k) {
    const Eigen::Vector3d p = turn * Eigen::Vector3d(corners[k][0], corners[k][1], corners[k][2]) +
                              Eigen::Vector3d(3, -1, 2);
    vs3 += "V " + std::to_string(k + 1);
    for (int c = 0; c < 3; ++c) vs3 += " " + std::to_string(p[c]);
    vs3 += "\n";
  }
  vs3 += "S 1 1 2 3 4 0 0 .5 low\nS 2 7 6 5 8 0 0 .5 high\nM 3 11 10 9 0 1 0 .5 mask\n";
  // Corners are off by 5e-7, areas by 1e-6 and factors by some of that.
  expect_same(factors_of(vs3), reference("mask.txt"), 1e-5);
}

std::string cube_vs3(const std::string& control) {
  return "C " + control +
         "\nF 3\nV 1 0 0 0\nV 2 1 0 0\nV 3 1 1 0\nV 4 0 1 0\nV 5 0 0 1\nV 6 1 0 1\nV 7 1 1 1\n"
         "V 8 0 1 1\nS 1 1 2 3 4 0 0 .5 down\nS 2 1 5 6 2 0 0 .5 south\nS 3 1 4 8 5 0 0 .5 west\n"
         "S 4 5 8 7 6 0 0 .5 up\nS 5 3 7 8 4 0 0 .5 north\nS 6 2 6 7 3 0 0 .5 east\n";
}

/// B of the cube in closed form, to seven digits: ε B is 0.04545455, 0.09087291 and 0.09091813.
TEST_F(Vs3Program, GivesScriptFOfACubeInTextAndBinary) {
  const View3dFile text = factors_of(cube_vs3("encl=1 emit=1"));
  expect_same(text, reference("cube-script-f.txt"), 1.01e-6);
  EXPECT_NEAR(text.lines[1][0], 0.04545455, 0.51e-6);
  EXPECT_NEAR(text.lines[1][3], 0.09087291, 0.51e-6);
  EXPECT_NEAR(text.lines[1][1], 0.09091813, 0.51e-6);

  factors_of(cube_vs3("encl=1 emit=1 out=1"));
  const std::string bytes = contents(result("a.txt"));
  ASSERT_EQ(bytes.size(), 32 + 4 * (6 + 36 + 6U));
  EXPECT_EQ(bytes.substr(0, 32), "View3D 4.0.0 1 1 1 6          \r\n");
  std::vector<float> numbers(6 + 36 + 6);
  std::memcpy(numbers.data(), bytes.data() + 32, 4 * numbers.size());
  EXPECT_EQ(numbers[0], 1);
  EXPECT_EQ(numbers[47], 0.5F);
  for (std::size_t k = 0; k < 36; ++k) {
    EXPECT_NEAR(numbers[6 + k], text.lines[1 + k / 6][k % 6], 0.51e-6);
  }
}

}  // namespace
