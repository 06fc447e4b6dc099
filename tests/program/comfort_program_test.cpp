// `radiosity comfort`, as a user would run it.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "radiosity/base/geometry.h"
#include "tests/support/program.h"

namespace {

using namespace radiosity::test;
using radiosity::Vec3;
using Json = nlohmann::json;

constexpr double kWarm = 310;
constexpr double kCool = 290;

/// A black room of 6 x 4 x 3 m, its ceiling warm, or the wall at x = 6.
std::string room(const std::string& warm, const std::string& head = R"("closed": true, )") {
  const std::string parts[6][2] = {{"floor", "[[0,0,0],[6,0,0],[6,4,0],[0,4,0]]"},
                                   {"ceiling", "[[0,0,3],[0,4,3],[6,4,3],[6,0,3]]"},
                                   {"west", "[[0,0,0],[0,4,0],[0,4,3],[0,0,3]]"},
                                   {"east", "[[6,0,0],[6,0,3],[6,4,3],[6,4,0]]"},
                                   {"south", "[[0,0,0],[0,0,3],[6,0,3],[6,0,0]]"},
                                   {"north", "[[0,4,0],[6,4,0],[6,4,3],[0,4,3]]"}};
  std::string surfaces;
  for (const auto& [name, polygon] : parts) {
    surfaces += std::string(surfaces.empty() ? "" : ", ") + R"({"name": ")" + name +
                R"(", "material": ")" + (name == warm ? "warm" : "cool") + R"(", "polygons": [)" +
                polygon + "]}";
  }
  return R"({"bands": "grey", )" + head + R"("materials": {"warm": {"emissivity": 1,
      "temperature": 310}, "cool": {"emissivity": 1, "temperature": 290}}, "surfaces": [)" +
         surfaces + "]}";
}

/// The form factor from an element to the ceiling, or the wall at x = 6, by a fine sum over it.
double factor_by_sum(const Vec3& point, const Vec3& normal, bool is_ceiling) {
  constexpr int kSteps = 400;
  const double width = is_ceiling ? 6 : 3;
  const double depth = 4;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const double s = (i + 0.5) / kSteps * width;
      const double t = (j + 0.5) / kSteps * depth;
      const Vec3 there = is_ceiling ? Vec3(s, t, 3) : Vec3(6, t, s);
      const Vec3 way = there - point;
      const double facing = is_ceiling ? way.z() : way.x();
      sum += std::max(normal.dot(way), 0.) * facing /
             (radiosity::kPi * way.squaredNorm() * way.squaredNorm());
    }
  }
  return sum * width * depth / (kSteps * kSteps);
}

double fourth(double x) { return x * x * x * x; }

class Comfort : public Program {
 protected:
  Json comfort(const std::string& text, const Arguments& more) const {
    Arguments arguments = {
        "comfort", write_file("room.json", text), "--as-is", "--tolerance", "1e-6", "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.exit_code == 0 ? Json::parse(outcome.out)["points"] : Json();
  }
};

// σ T⁴ = Σ w (F Tw⁴ + (1 - F) Tc⁴) with factors that the test sums up by itself.
TEST_F(Comfort, BlackRoomsAgreeWithSumsOverTheWarmSurface) {
  const Vec3 point(1.5, 1.2, 1.1);
  const std::array<Vec3, 6> normals = {Vec3(0, 0, 1),  Vec3(0, 0, -1), Vec3(1, 0, 0),
                                       Vec3(-1, 0, 0), Vec3(0, 1, 0),  Vec3(0, -1, 0)};
  struct Case {
    const char* posture;
    std::array<double, 3> weights;  // up, front, left
  };
  for (const bool is_ceiling : {true, false}) {
    for (const Case& each :
         {Case{"standing", {0.08, 0.35, 0.23}}, Case{"seated", {0.18, 0.30, 0.22}}}) {
      const Json points =
          comfort(room(is_ceiling ? "ceiling" : "east"),
                  {"--at", "1.5,1.2,1.1", "--posture", each.posture, "--facing", "2,0,5"});
      ASSERT_EQ(points.size(), 1U);
      double mean = 0;
      double factor = 0;
      for (std::size_t k = 0; k < 6; ++k) {
        const double f = factor_by_sum(point, normals[k], is_ceiling);
        const double black = f * fourth(kWarm) + (1 - f) * fourth(kCool);
        // The sum is right to 1e-5 of F, which is 1e-4 K.
        EXPECT_NEAR(points[0]["plane_radiant_temperatures"][k], std::pow(black, 0.25), 1e-3) << k;
        mean += each.weights[k / 2] / 1.32 * black / (each.weights[0] == 0.18 ? 1.4 / 1.32 : 1);
        factor += each.weights[k / 2] * f / (each.weights[0] == 0.18 ? 1.4 : 1.32);
      }
      EXPECT_NEAR(points[0]["mean_radiant_temperature"], std::pow(mean, 0.25), 1e-3)
          << each.posture;
      EXPECT_NEAR(points[0]["factors"][is_ceiling ? "ceiling" : "east"], factor, 1e-4);
      EXPECT_NEAR(points[0]["sky"], 0, 1e-9);
    }
  }
}

// Whatever surfaces reflect, and wherever one stands, turned to all sides or to one.
TEST_F(Comfort, AnEvenRoomIsAsWarmAsItsWalls) {
  std::string text = room("none");
  text.replace(text.find("\"emissivity\": 1, \"temperature\": 290"), 15, "\"emissivity\": 0.3");
  for (const Arguments& more :
       {Arguments{}, Arguments{"--posture", "seated"}, Arguments{"--body", "projected-area"},
        Arguments{"--body", "projected-area", "--facing", "1,2,0"}, Arguments{"--facing", "1,2,0"},
        Arguments{"--up", "0,1,0"}}) {
    Arguments arguments = {"--at", "1,1,1", "--at", "5.9,0.2,2.9"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Json points = comfort(text, arguments);
    ASSERT_EQ(points.size(), 2U);
    // Projected areas are integrated to 1e-4 of T⁴.
    const bool has_areas = std::find(more.begin(), more.end(), "projected-area") != more.end();
    const double exact = has_areas ? 1e-4 * kCool / 4 : 1e-4;
    for (const Json& point : points) EXPECT_NEAR(point["mean_radiant_temperature"], kCool, exact);
  }
}

// Without walls the surroundings count by what is seen of them: a floor far below a person is
// nothing, one at its feet a part that the summary tells.
TEST_F(Comfort, SurroundingsCountByWhatIsSeenOfThem) {
  const std::string text = R"({"bands": "grey", "environment": {"temperature": 260},
    "materials": {"warm": {"emissivity": 1, "temperature": 310}}, "surfaces": [{"name": "floor",
    "material": "warm", "polygons": [[[-2,-2,0],[2,-2,0],[2,2,0],[-2,2,0]]]}]})";
  const Json points = comfort(text, {"--at", "0,0,1", "--at", "0,0,2000"});
  ASSERT_EQ(points.size(), 2U);
  const double seen = points[0]["factors"]["floor"];
  EXPECT_GT(seen, 0.2);
  EXPECT_NEAR(points[0]["sky"].get<double>() + seen, 1, 1e-9);
  EXPECT_NEAR(fourth(points[0]["mean_radiant_temperature"]),
              seen * fourth(310) + (1 - seen) * fourth(260), 1e-6 * fourth(310));
  EXPECT_NEAR(points[1]["mean_radiant_temperature"], 260, 1e-3);
}

/// The angle factor from a person, turned to all sides, to a rectangle a wide and b high (a deep on
/// floor and ceiling) at distance c, one corner at the foot of the normal from the person's centre:
/// fits to Fanger's diagrams (ISO 7726:1998, B.4).
double fitted_factor(bool is_seated, bool is_wall, double a, double b, double c) {
  struct Fit {
    double most, a, b, c, d, e;
  };
  constexpr Fit kFits[2][2] = {
      {{0.116, 1.595, 0.128, 1.226, 0.046, 0.044}, {0.120, 1.242, 0.167, 0.616, 0.082, 0.051}},
      {{0.116, 1.396, 0.130, 0.951, 0.080, 0.055}, {0.118, 1.216, 0.169, 0.717, 0.087, 0.052}}};
  const Fit& fit = kFits[is_seated ? 1 : 0][is_wall ? 1 : 0];
  const double across = a / c;
  const double along = b / c;
  const double tau = fit.a + fit.b * across;
  const double gamma = fit.c + fit.d * along + fit.e * across;
  return fit.most * (1 - std::exp(-across / tau)) * (1 - std::exp(-along / gamma));
}

// By projected areas, form factors are those of Fanger's diagrams: a person in the middle of a room
// sees each wall as four rectangles.
TEST_F(Comfort, ProjectedAreasGiveFangersFactors) {
  for (const char* posture : {"standing", "seated"}) {
    const bool is_seated = std::string(posture) == "seated";
    const Json points = comfort(
        room("ceiling"), {"--at", "3,2,1.5", "--posture", posture, "--body", "projected-area"});
    ASSERT_EQ(points.size(), 1U);
    const Json& factors = points[0]["factors"];
    double sum = points[0]["backs"].get<double>() + points[0]["sky"].get<double>();
    for (const Json& factor : factors) sum += factor.get<double>();
    EXPECT_NEAR(sum, 1, 1e-4);
    EXPECT_NEAR(points[0]["sky"], 0, 1e-4);
    // The fits were read off diagrams: to 0.01 for each of the four.
    EXPECT_NEAR(factors["ceiling"], 4 * fitted_factor(is_seated, false, 3, 2, 1.5), 0.04);
    EXPECT_NEAR(factors["east"], 4 * fitted_factor(is_seated, true, 2, 1.5, 3), 0.04);
    EXPECT_NEAR(factors["north"], 4 * fitted_factor(is_seated, true, 3, 1.5, 2), 0.04);
    EXPECT_NEAR(factors["east"], factors["west"], 1e-4);
    // Black walls: the factors tell the temperature.
    const double seen = factors["ceiling"];
    EXPECT_NEAR(fourth(points[0]["mean_radiant_temperature"]),
                seen * fourth(kWarm) + (1 - seen) * fourth(kCool), 1e-4 * fourth(kWarm));
  }
}

// Whichever way it is turned with its scene, and where walls are missing; a person shows its front
// to the ceiling's light as to the floor's.
TEST_F(Comfort, ProjectedAreasSeeSurroundingsBacksAndTheSun) {
  const std::string floor = R"("surfaces": [{"name": "floor", "material": "warm",
      "polygons": [[[-2,-2,0],[2,-2,0],[2,2,0],[-2,2,0]]]},
      {"name": "away", "material": "warm", "polygons": [[[3,-9,0],[3,9,0],[3,9,9],[3,-9,9]]]}]})";
  const std::string head = R"({"bands": "grey", "environment": {"temperature": 260}, "materials":
      {"warm": {"emissivity": 1, "temperature": 310}}, )";
  const Arguments person = {"--at", "0,0,1", "--body", "projected-area", "--facing", "1,0,0"};
  const Json plain = comfort(head + floor, person);
  ASSERT_EQ(plain.size(), 1U);
  const double seen = plain[0]["factors"]["floor"];
  const double backs = plain[0]["backs"];
  EXPECT_GT(seen, 0.1);
  EXPECT_GT(backs, 0.1);
  EXPECT_NEAR(seen + backs + plain[0]["sky"].get<double>(), 1, 1e-12);
  const double without_sun = fourth(plain[0]["mean_radiant_temperature"]);
  EXPECT_NEAR(without_sun, seen * fourth(310) + (1 - seen - backs) * fourth(260),
              1e-6 * fourth(310));
  // Straight from behind, where f_p is 0.347 of a standing person and the black floor, lit edge-on,
  // gets nothing; ∫ f_p dω is π within what measurements of a body differ (Fanger: 1 to 2 %).
  const Json sunny =
      comfort(head + R"("sun": {"direction": [1, 0, 0], "irradiance": 500}, )" + floor, person);
  EXPECT_NEAR((fourth(sunny[0]["mean_radiant_temperature"]) - without_sun) * 5.670374419e-8,
              0.347 * 500, 0.03 * 0.347 * 500);
}

TEST_F(Comfort, TablesHoldAllPoints) {
  const std::string places = write_file("points.csv", "x,name,y,z\n1,a,1,1\n2,b,1.5,1.1\n");
  const Outcome outcome = run({"comfort", write_file("room.json", room("ceiling")), "--as-is",
                               "--points", places, "--at", "3,2,1", "-o", result("comfort.csv")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("mean radiant, K"), std::string::npos);
  std::istringstream lines(contents(result("comfort.csv")));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line,
            "x,y,z,mean_radiant_temperature,up,down,front,back,left,right,F_floor,F_ceiling,"
            "F_west,F_east,F_south,F_north,F_backs,F_sky");
  for (const char* place : {"3,2,1,", "1,1,1,", "2,1.5,1.1,"}) {
    ASSERT_TRUE(std::getline(lines, line));
    EXPECT_EQ(line.substr(0, std::string(place).size()), place);
  }
  EXPECT_FALSE(std::getline(lines, line));
}

TEST_F(Comfort, BadInputIsRefused) {
  const std::string scene = write_file("room.json", room("ceiling"));
  const auto error = [&](const Arguments& more, int exit_code, const std::string& words) {
    Arguments all = {"comfort", scene, "--as-is"};
    all.insert(all.end(), more.begin(), more.end());
    expect_error(run(all), exit_code, words);
  };
  error({}, 2, "--at or --points");
  error({"--at", "1,2"}, 2, "expected x,y,z");
  error({"--at", "1,2,3", "--facing", "0,0,0"}, 2, "expected a direction");
  error({"--at", "1,2,3", "--facing", "0,0,2"}, 1, "cannot face upwards");
  error({"--at", "1,2,3", "--posture", "lying"}, 2, "lying");
  error({"--at", "1,2,3", "--body", "sphere"}, 2, "sphere");
  error({"--at", "1,2,3", "-o", result("a.vtp")}, 2, ".csv");
  error({"--points", write_file("p.csv", "x,y\n1,2\n")}, 1, "p.csv:1: has no column z");
  error({"--points", write_file("p.csv", "1,2,up\n")}, 1, "p.csv:1: expected a number");
  error({"--points", write_file("p.csv", "1,2\n")}, 1, "p.csv:1: found 2 columns, expected 3");
  error({"--points", write_file("p.csv", "\n\n")}, 1, "has no points");
  expect_error(run({"comfort", RADIOSITY_SCENES "/cornell-box.json", "--as-is", "--at", "1,1,1"}),
               1, "a radiant temperature wants heat");
}

}  // namespace
