// What the window's tools do to the picture, by scripts on a virtual display.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/support/view_program.h"

namespace radiosity::test {
namespace {

using nlohmann::json;
using ViewTools = ViewProgram;

TEST_F(ViewTools, HandleTheColourBarAndLines) {
  const Outcome outcome =
      run_script({{{"load", kBox}},
                  "wait-solved",
                  {{"set-quantity", "illuminance"}},
                  {{"screenshot", result("a.png")}},
                  {{"report", result("a.json")}},
                  {{"set-legend", {{"map", "inferno"}, {"fit", {0, 100}}, {"isolines", true}}}},
                  {{"screenshot", result("b.png")}},
                  {{"report", result("b.json")}},
                  {{"set-legend", {{"isolines", false}, {"map", "viridis"}, {"range", {0, 50}}}}},
                  {{"set-look", {{"outlines", false}}}},
                  {{"screenshot", result("c.png")}},
                  {{"report", result("c.json")}}});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json first = report("a.json")["look"];
  const json second = report("b.json")["look"];
  EXPECT_EQ(first["legend"]["fit"], "0 to 98 % of patches");
  EXPECT_EQ(first["legend"]["iso_numbers"], 0);
  EXPECT_EQ(second["legend"]["fit"], "0 to 100 % of patches");
  EXPECT_GE(second["legend"]["high"], second["legend"]["greatest"]);
  EXPECT_GT(second["legend"]["iso_numbers"], 3);
  EXPECT_EQ(second["map"], "inferno");
  EXPECT_EQ(report("c.json")["look"]["legend"]["high"], 50);
  // The same place in other colours, and with another range.
  const auto color = [&](const std::string& name) {
    return color_at(read_png(result(name + ".png")), report(name + ".json"), 0.1, 0.5);
  };
  EXPECT_NE(color("a"), color("b"));
  EXPECT_NE(color("a"), color("c"));
}

TEST_F(ViewTools, HideSurfacesAndMeasure) {
  const Outcome outcome = run_script({{{"load", kBox}},
                                      "wait-solved",
                                      {{"screenshot", result("a.png")}},
                                      {{"report", result("a.json")}},
                                      {{"sort-surfaces", {{"by", "area"}, {"falling", true}}}},
                                      {{"show-surface", {{"surface", "left"}, {"on", false}}}},
                                      {{"mark-surface", "floor"}},
                                      {{"screenshot", result("b.png")}},
                                      {{"measure", {{"from", {0, 0, 0}}, {"to", {0.3, 0, 0.4}}}}},
                                      {{"save-view", "front"}},
                                      {{"zoom", {{"factor", 0.5}, {"x", 0.2}, {"y", 0.7}}}},
                                      {{"orbit", {{"right", 20}, {"x", 0.5}, {"y", 0.5}}}},
                                      {{"report", result("b.json")}},
                                      {{"use-view", "front"}},
                                      {{"measure-at", {{"x", 0.5}, {"y", 0.8}}}},
                                      {{"report", result("c.json")}},
                                      "show-all-surfaces",
                                      {{"mark-surface", nullptr}},
                                      {{"measure", json::object()}},
                                      {{"screenshot", result("d.png")}},
                                      {{"report", result("d.json")}},
                                      {{"add-meter", {{"x", 0.25}, {"y", 0.93}}}},
                                      {{"work-plane", {{"height", 0.1}, {"spacing", 0.1}}}},
                                      {{"save-readings", result("e.csv")}},
                                      {{"screenshot", result("e.png")}},
                                      {{"report", result("e.json")}}});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json before = report("a.json");
  const json hidden = report("b.json");
  EXPECT_NEAR(hidden["tape"]["distance"].get<double>(), 0.5, 1e-12);
  EXPECT_EQ(report("c.json")["tape"], nullptr);  // laid anew, one end only
  EXPECT_EQ(hidden["views"], json({"front"}));
  EXPECT_NE(hidden["camera"]["position"], before["camera"]["position"]);
  EXPECT_EQ(report("c.json")["camera"]["position"], before["camera"]["position"]);
  double last = INFINITY;
  for (const json& surface : hidden["surfaces"]) {
    EXPECT_EQ(surface["shown"], surface["name"] != "left");
    EXPECT_EQ(surface["marked"], surface["name"] == "floor");
    EXPECT_LE(surface["area"].get<double>(), last);
    last = surface["area"];
  }
  const Picture whole = read_png(result("a.png"));
  EXPECT_NE(color_at(read_png(result("b.png")), before, 0.1, 0.4),
            color_at(whole, before, 0.1, 0.4));
  EXPECT_EQ(color_at(read_png(result("d.png")), before, 0.1, 0.4),
            color_at(whole, before, 0.1, 0.4));
  const json measured = report("e.json");
  EXPECT_EQ(measured["look"]["legend"]["title"], json({"work plane", "lux"}));
  EXPECT_EQ(measured["work_plane"]["note"], "");
  EXPECT_GT(measured["work_plane"]["mean"], measured["work_plane"]["least"]);
  EXPECT_GT(measured["work_plane"]["inside"], 0);
  EXPECT_EQ(measured["meters"][0]["surface"], "floor");
  EXPECT_TRUE(std::filesystem::exists(result("e.csv")));
  EXPECT_NE(color_at(read_png(result("e.png")), before, 0.5, 0.78),
            color_at(whole, before, 0.5, 0.78));
}

TEST_F(ViewTools, CompareIterationsAndPlayThem) {
  const Outcome outcome = run_script({{{"load", kBox}},
                                      "wait-solved",
                                      {{"record-iteration", "jacobi"}},
                                      "wait-idle",
                                      {{"record-iteration", "southwell"}},
                                      "wait-idle",
                                      {{"select-patch", 3}},
                                      {{"report", result("a.json")}},
                                      {{"set-watch", {{"playing", true}, {"speed", 30}}}},
                                      {{"wait", 1}},
                                      {{"set-watch", {{"playing", false}}}},
                                      {{"report", result("b.json")}},
                                      {{"set-emitter", {{"emitter", 0}, {"scale", 0.5}}}},
                                      {{"report", result("c.json")}}});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json state = report("a.json");
  EXPECT_EQ(state["iteration"]["compared"], json({"jacobi"}));
  EXPECT_FALSE(state["iteration"]["frames"][0]["shooter"].is_null());
  EXPECT_EQ(state["iteration"]["stale"], false);
  EXPECT_EQ(state["selected"]["step"]["radiosity"].size(), 3U);
  EXPECT_GT(report("b.json")["iteration"]["step"], 2);
  EXPECT_EQ(report("c.json")["iteration"]["stale"], true);
}

}  // namespace
}  // namespace radiosity::test
