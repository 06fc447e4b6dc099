// From a model in millimetres to lux on a desk, and to files, in the window alone.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/view_program.h"

namespace radiosity::test {
namespace {

using nlohmann::json;
using ViewNewcomer = ViewProgram;

/// A closed room of 4 x 3 x 2.5 m in mm, z up, and a lamp of 1 x 1 m below its ceiling.
const char* const kRoomInMillimetres =
    "v 0 0 0\nv 4000 0 0\nv 4000 3000 0\nv 0 3000 0\n"
    "v 0 0 2500\nv 4000 0 2500\nv 4000 3000 2500\nv 0 3000 2500\n"
    "v 1500 1000 2400\nv 1500 2000 2400\nv 2500 2000 2400\nv 2500 1000 2400\n"
    "o floor\nf 1 2 3 4\no ceiling\nf 5 8 7 6\n"
    "o walls\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\no panel\nf 9 10 11 12\n";

// The light that a surface gives once it is made a lamp is that of the scene which is saved, and
// what it is made of can be made again.
TEST_F(ViewNewcomer, MakesALampAndReadsLux) {
  const std::string room = write_file("room.obj", kRoomInMillimetres);
  const json meter = {{"add-meter", {{"position", {2, 1.5, 0.75}}, {"normal", {0, 0, 1}}}}};
  const Outcome outcome = run_script({{{"load", room}},
                                      "wait-idle",
                                      {{"set-unit", "mm"}},
                                      {{"wait", 0.2}},
                                      "wait-idle",
                                      {{"make-lamp", {{"surface", "panel"}, {"lumens", 4000}}}},
                                      "wait-solved",
                                      meter,
                                      {{"save-readings", result("a.csv")}},
                                      {{"screenshot", result("a.png")}},
                                      {{"save-result", result("a.vtp")}},
                                      {{"report", result("a.json")}},
                                      {{"save-scene", result("lit.json")}},
                                      {{"load", result("lit.json")}},
                                      {{"wait", 0.2}},
                                      "wait-solved",
                                      meter,
                                      {{"save-readings", result("b.csv")}},
                                      {{"report", result("b.json")}}});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json first = report("a.json");
  EXPECT_EQ(first["up"], "z");
  EXPECT_EQ(first["unit"], "mm");
  EXPECT_NEAR(first["size"][0], 4, 1e-9);
  ASSERT_EQ(first["mix"]["emitters"].size(), 1U);
  EXPECT_EQ(first["mix"]["emitters"][0]["name"], "panel");
  const double lux = first["meters"][0]["value"];
  // 4000 lm on 62 m² of half reflectance: 4000 / (62 (1 - 0.5)) in the mean, more below the lamp.
  EXPECT_GT(lux, 129);
  EXPECT_LT(lux, 1300);
  EXPECT_NEAR(report("b.json")["meters"][0]["value"], lux, 1e-4 * lux);
  EXPECT_NE(contents(result("a.csv")).find("point 1"), std::string::npos);
  EXPECT_EQ(read_png(result("a.png")).width, 640);
  EXPECT_TRUE(fs::exists(result("a.vtp")));
}

TEST_F(ViewNewcomer, IsToldWhatCannotBeALamp) {
  const std::string room = write_file("room.obj", kRoomInMillimetres);
  for (const json& lamp :
       {json{{"surface", "moon"}, {"lumens", 10}}, json{{"surface", "panel"}, {"lumens", -10}},
        json{{"surface", "panel"}}}) {
    const Outcome outcome = run_script({{{"load", room}}, "wait-idle", {{"make-lamp", lamp}}});
    EXPECT_EQ(outcome.exit_code, 1) << lamp;
    EXPECT_NE(outcome.err.find("make-lamp"), std::string::npos) << outcome.err;
  }
}

TEST_F(ViewNewcomer, SeesWhatASurfaceOfHeatIsCoupledTo) {
  const Outcome outcome =
      run_script({{{"load", std::string(RADIOSITY_SCENES) + "/thermal-enclosure.json"}},
                  "wait-solved",
                  {{"select-at", {{"x", 0.4}, {"y", 0.6}}}},
                  {{"couplings", true}},
                  {{"wait", 0.2}},
                  "wait-idle",
                  {{"report", result("a.json")}}});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json couplings = report("a.json")["couplings"];
  ASSERT_FALSE(couplings.is_null());
  EXPECT_EQ(couplings["with"][0]["with"], "shroud");
  const Outcome light = run_script({{{"load", kBox}}, "wait-solved", {{"couplings", true}}});
  EXPECT_EQ(light.exit_code, 1);
}

}  // namespace
}  // namespace radiosity::test
