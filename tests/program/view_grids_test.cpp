// Grids and observers of a scene in the window.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/view_program.h"

namespace radiosity::test {
namespace {

using nlohmann::json;
using ViewGrids = ViewProgram;

const std::string kLitOffice = std::string(RADIOSITY_SCENES) + "/lit-office.json";

// The window and `radiosity light` measure the same: digits that are printed are alike.
TEST_F(ViewGrids, ShowWhatRadiosityLightPrints) {
  const Outcome light = run({"light", kLitOffice, "--patches", "600", "--json"});
  ASSERT_EQ(light.exit_code, 0) << light.err;
  const json printed = json::parse(light.out);
  const Outcome outcome =
      run_script({{{"load", kLitOffice}},
                  "wait-idle",
                  {{"show-grid", {{"grid", "desk"}, {"numbers", true}}}},
                  {{"set-legend", {{"step", 50}}}},
                  {{"report", result("a.json")}},
                  {{"screenshot", result("a.png")}},
                  {{"show-grid", {{"grid", "faces"}, {"quantity", "cylindrical"}}}},
                  {{"report", result("b.json")}},
                  {{"screenshot", result("b.png")}}});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json report_of_desk = report("a.json");
  const json shown = report_of_desk["grids"];
  EXPECT_EQ(shown["note"], "");
  EXPECT_EQ(shown["shown"], "desk");
  ASSERT_EQ(shown["grids"].size(), printed["grids"].size());
  for (std::size_t g = 0; g < shown["grids"].size(); ++g) {
    const json& mine = shown["grids"][g];
    const json& theirs = printed["grids"][g];
    EXPECT_EQ(mine["name"], theirs["name"]);
    ASSERT_EQ(mine["quantities"].size(), theirs["quantities"].size());
    for (std::size_t q = 0; q < mine["quantities"].size(); ++q) {
      for (const char* age : {"new", "maintained"}) {
        for (const char* key : {"Em", "Emin", "Emax", "U0", "Ud"}) {
          const double expected = theirs["quantities"][q][age][key];
          EXPECT_NEAR(mine["quantities"][q][age][key], expected, 1e-4 * expected) << key;
        }
      }
    }
  }
  ASSERT_EQ(shown["observers"].size(), printed["observers"].size());
  for (std::size_t k = 0; k < shown["observers"].size(); ++k) {
    EXPECT_NEAR(std::stod(shown["observers"][k]["value"].get<std::string>()),
                printed["observers"][k]["UGR"].get<double>(), 0.051);
  }
  int n_met = 0;
  for (const json& check : printed["required"]) n_met += check["met"].get<bool>() ? 1 : 0;
  EXPECT_EQ(shown["required"], std::to_string(n_met) + " of " +
                                   std::to_string(printed["required"].size()) +
                                   " required values met");
  for (const json& tick : report_of_desk["look"]["legend"]["ticks"]) {
    EXPECT_EQ(std::fmod(tick.get<double>(), 50), 0);
  }
  EXPECT_EQ(report("b.json")["look"]["legend"]["title"][0], "faces: cylindrical, maintained");
  const auto color = [&](const std::string& name) {
    return color_at(read_png(result(name + ".png")), report(name + ".json"), 0.5, 0.6);
  };
  EXPECT_NE(color("a"), color("b"));
}

TEST_F(ViewGrids, AreRefusedByNameIfThereAreNone) {
  for (const json& action :
       {json{{"show-grid", "moon"}}, json{{"show-grid", {{"grid", "desk"}, {"quantity", "noise"}}}},
        json{{"set-legend", {{"step", -1}}}}}) {
    const Outcome outcome = run_script({{{"load", kLitOffice}}, "wait-solved", action});
    EXPECT_EQ(outcome.exit_code, 1) << action;
    EXPECT_FALSE(outcome.err.empty());
  }
}

}  // namespace
}  // namespace radiosity::test
