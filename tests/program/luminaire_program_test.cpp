// Luminaires of photometric files, as a user would run them.

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/messages.h"
#include "tests/support/program.h"

namespace {

using namespace radiosity::test;
using Json = nlohmann::json;

/// 100 cd in all directions, or down to the horizon.
constexpr const char* kBall = "IESNA91\nTILT=NONE\n1 -1 100 2 1 1 2 0 0 0\n1 1 10\n0 180\n0\n1 1\n";
constexpr const char* kHalf = "IESNA91\nTILT=NONE\n1 -1 100 2 1 1 2 0 0 0\n1 1 10\n0 90\n0\n1 1\n";

class Luminaires : public Program {
 protected:
  Luminaires() {
    (void)write_file("ball.ies", kBall);
    (void)write_file("half.ies", kHalf);
  }
  /// A room of 2 x 2 x 2 m, all grey, with luminaires.
  [[nodiscard]] std::string write_room(const std::string& luminaires,
                                       const std::string& head = R"("bands": "grey")",
                                       double reflectance = 0) const {
    return write_file("room.json", "{" + head + R"(, "materials": {"m": {"reflectance": )" +
                                       std::to_string(reflectance) + R"(}}, "surfaces": [
      {"name": "floor", "material": "m", "polygons": [[[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0]]]},
      {"name": "ceiling", "material": "m", "polygons": [[[0, 0, 2], [0, 2, 2], [2, 2, 2], [2, 0, 2]]]},
      {"name": "walls", "material": "m", "polygons": [
        [[0, 0, 0], [0, 0, 2], [2, 0, 2], [2, 0, 0]], [[0, 2, 0], [2, 2, 0], [2, 2, 2], [0, 2, 2]],
        [[0, 0, 0], [0, 2, 0], [0, 2, 2], [0, 0, 2]], [[2, 0, 0], [2, 0, 2], [2, 2, 2], [2, 2, 0]]]}],
      "luminaires": [)" + luminaires + "]}");
  }
};

double mean_lux(const Json& json, int surface) {
  return json["quantities"]["illuminance"]["surfaces"][surface]["mean"].get<double>();
}

// 400 π lm in the middle of a cube: as much on each face, and the sum of reflections.
TEST_F(Luminaires, AreLuxInAllBands) {
  const double direct = 100 * 4 * std::acos(-1.0) / 24;
  for (const char* bands : {R"("bands": "grey")", R"("bands": "rgb")",
                            R"("bands": [400, 450, 500, 550, 600, 650, 700])"}) {
    const std::string scene =
        write_room(R"({"name": "ball", "file": "ball.ies", "position": [1, 1, 1]})", bands, 0.5);
    const Json json = solve({scene, "--patches", "24", "--quantity", "illuminance"});
    for (int surface = 0; surface < 3; ++surface) {
      EXPECT_NEAR(mean_lux(json, surface), direct / (1 - 0.5), 0.02 * direct) << bands;
    }
    double total = 4 * (mean_lux(json, 0) + mean_lux(json, 1) + 4 * mean_lux(json, 2));
    EXPECT_NEAR(total, 24 * direct / (1 - 0.5), 1e-3 * 24 * direct) << bands;
  }
  const std::string colored = write_room(
      R"({"name": "ball", "file": "ball.ies", "position": [1, 1, 1], "spectrum": [3, 2, 1]})",
      R"("bands": "rgb")");
  const Json json = solve({colored, "--patches", "24", "--quantity", "illuminance"});
  EXPECT_NEAR(mean_lux(json, 0), direct, 1e-6 * direct);
  EXPECT_NEAR(json["energy"]["incident"][0].get<double>(),
              3 * json["energy"]["incident"][2].get<double>(), 1e-9);
}

TEST_F(Luminaires, StandInArraysAndAreDimmed) {
  const std::string array = R"(, "array": {"rows": 2, "columns": 2, "row_step": [0, 1, 0],
    "column_step": [1, 0, 0]}})";
  const std::string scene = write_room(
      R"({"name": "lamp", "file": "half.ies", "position": [0.5, 0.5, 2], "lumens": 1000)" + array);
  const Json json = solve({scene, "--patches", "24", "--quantity", "luminous-flux"});
  EXPECT_NEAR(json["energy"]["incident"][0].get<double>() * 179, 4000, 1e-6);
  const std::string scenarios = write_file("s.json", R"({"scenarios": [
    {"name": "all"}, {"name": "row", "lights": {"lamp-1-*": 0.5, "lamp-2-*": "off"}}]})");
  const Json table = solve({scene, "--patches", "24", "--scenarios", scenarios});
  EXPECT_NEAR(table["scenarios"][0]["energy"]["incident"][0].get<double>() * 179, 4000, 1e-6);
  EXPECT_NEAR(table["scenarios"][1]["energy"]["incident"][0].get<double>() * 179, 1000, 1e-6);
  const Outcome text =
      run({"solve", scene, "--quantity", "illuminance", "--efficacy", "358", "--patches", "24"});
  expect_contains(text.out, "from luminaires, W");
  expect_contains(text.err, "--efficacy 358 makes 2 lm of each of their lumens");
  // Written and read again.
  const std::string copy = result("copy.json");
  EXPECT_EQ(run({"inspect", scene, "-o", copy}).exit_code, 0);
  const Json again = solve({copy, "--patches", "24"});
  EXPECT_NEAR(again["energy"]["incident"][0].get<double>() * 179, 4000, 1e-6);
}

TEST_F(Luminaires, LightWithoutReflectionInPicturesAndOutputs) {
  const std::string scene = write_room(
      R"({"name": "spot", "file": "half.ies", "position": [1, 1, 1.5], "aim": [2, 1, 1]})",
      R"("bands": "rgb")", 0.4);
  const Json json = solve({scene, "--patches", "60", "-o", result("a.csv"), "-o", result("a.vtp"),
                           "-o", result("a.png"), "--gather", "--width", "16", "--height", "16"});
  EXPECT_EQ(results().size(), 3U);
}

TEST_F(Luminaires, AreInspected) {
  const std::string file = write_file("half.ies", kHalf);
  const Outcome text = run({"inspect", file, "-o", result("curve.svg"), "-o", result("curve.png")});
  EXPECT_EQ(text.exit_code, 0) << text.err;
  for (const char* part : {"628.319 lm", "absolute photometry", "rotational", "180.0", "100 cd",
                           "62.83 lm/W", "IES LM-63-1991, type C"}) {
    expect_contains(text.out, part);
  }
  EXPECT_EQ(results().size(), 2U);
  const Outcome json = run({"inspect", file, "--json"});
  ASSERT_EQ(json.exit_code, 0);
  EXPECT_NEAR(Json::parse(json.out)["flux"].get<double>(), 628.3185307179587, 1e-9);
  EXPECT_EQ(Json::parse(json.out)["lamp_flux"], nullptr);
  const Outcome scene = run({"inspect", file, "-o", result("x.json")});
  EXPECT_EQ(scene.exit_code, 1);
  expect_contains(scene.err, "drawn as .svg or .png");
}

TEST_F(Luminaires, TellWhatIsWrong) {
  const auto error = [&](const std::string& luminaire, const std::string& head) {
    const Outcome outcome = run({"solve", write_room(luminaire, head)});
    EXPECT_EQ(outcome.exit_code, 1) << luminaire;
    return outcome.err;
  };
  const std::string grey = R"("bands": "grey")";
  const auto lamp = [](const std::string& more) {
    return R"({"name": "a", "file": "half.ies", "position": [1, 1, 1])" + more + "}";
  };
  expect_contains(error(R"({"name": "a", "file": "no.ies", "position": [1, 1, 1]})", grey),
                  "no.ies: no such file");
  expect_contains(error(R"({"name": "a", "file": "half.ies", "position": [1, 1e20, 1]})", grey),
                  "luminaires[0].position: is more than 1e+09 m away");
  expect_contains(error(R"({"name": "a", "file": "half.ies"})", grey),
                  "luminaires[0]: has no \"position\"");
  expect_contains(error(lamp(R"(, "dimmed": 1)"), grey), "luminaires[0]");
  expect_contains(error(lamp(R"(, "dimming": -1)"), grey), "luminaires[0].dimming: found -1");
  expect_contains(error(lamp(R"(, "lumens": 0)"), grey), "luminaires[0].lumens: is 0");
  expect_contains(error(lamp(R"(, "aim": [1, 1, 1])"), grey), "aim: is the luminaire's position");
  expect_contains(error(lamp(R"(, "aim": [1, 1, 0], "direction": [0, 0, 1])"), grey),
                  "expected one of \"aim\"");
  expect_contains(error(lamp(R"(, "c0": [0, 0, 1])"), grey), "c0: is parallel to the axis");
  expect_contains(error(lamp(R"(, "array": {"rows": 2})"), grey), "without a \"row_step\"");
  expect_contains(error(lamp(R"(, "points": [2, 1])"), grey), "points[0]: has 2 points of a");
  expect_contains(error(lamp("") + ", " + lamp(""), grey), "is the name of another luminaire");
  expect_contains(error(lamp(""), R"("bands": {"thermal": [4]})"), "\"watts_per_lumen\"");
  expect_contains(error(lamp(""), grey + R"(, "symmetry": {"mirror": ["x=0"]})"),
                  "has both luminaires and a symmetry");
  const auto warning = [&](const std::string& position) {
    const Outcome outcome =
        run({"solve", "--patches", "6",
             write_room(R"({"name": "a", "file": "ball.ies", "position": )" + position + "}")});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.err;
  };
  expect_contains(warning("[5, 1, 1]"), "luminaire 'a' lights nothing: its light meets backs only");
  EXPECT_EQ(warning("[1, 1, 2]").find("lights nothing"), std::string::npos);
}

// In a cupboard that stands on the floor: the floor below it is no room that is lit.
TEST_F(Luminaires, InFurnitureAreToldOf) {
  const auto warning = [&](const std::string& position) {
    std::string text =
        contents(write_room(R"({"name": "a", "file": "ball.ies", "position": )" + position + "}"));
    const std::string place = R"("surfaces": [)";
    text.insert(text.find(place) + place.size(), R"(
        {"name": "cupboard", "material": "m", "polygons": [
          [[0.4, 0.5, 0], [0.4, 1, 0], [1, 1, 0], [1, 0.5, 0]],
          [[0.4, 0.5, 1.5], [1, 0.5, 1.5], [1, 1, 1.5], [0.4, 1, 1.5]],
          [[0.4, 0.5, 0], [1, 0.5, 0], [1, 0.5, 1.5], [0.4, 0.5, 1.5]],
          [[1, 0.5, 0], [1, 1, 0], [1, 1, 1.5], [1, 0.5, 1.5]],
          [[1, 1, 0], [0.4, 1, 0], [0.4, 1, 1.5], [1, 1, 1.5]],
          [[0.4, 1, 0], [0.4, 0.5, 0], [0.4, 0.5, 1.5], [0.4, 1, 1.5]]]},)");
    const Outcome outcome = run({"solve", "--patches", "40", write_file("furnished.json", text)});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.err;
  };
  expect_contains(warning("[0.6, 0.7, 0.9]"),
                  "luminaire 'a' lights nothing: its light meets backs");
  const char* on_it = R"([0.6, 0.7, 1.5], "direction": [0, 0, 1])";
  EXPECT_EQ(warning(on_it).find("lights nothing"), std::string::npos);
  EXPECT_EQ(warning("[1.5, 0.7, 0.9]").find("lights nothing"), std::string::npos);
}

}  // namespace
