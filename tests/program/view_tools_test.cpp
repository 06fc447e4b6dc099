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

/// Pixels of the picture's part of a window that are red, as what sees an opening is outlined.
long count_red(const fs::path& file, const json& region) {
  const Picture picture = read_png(file);
  const int left = region["left"];
  const int top = region["top"];
  long n = 0;
  for (int y = top; y < top + region["height"].get<int>(); ++y) {
    for (int x = left; x < left + region["width"].get<int>(); ++x) {
      const auto [red, green, blue] = picture.at(x, y);
      if (red > 120 && red > 2 * green && red > 2 * blue) ++n;
    }
  }
  return n;
}

// What sees an opening where there should be none is outlined, and cannot be missed where it is
// small: a ring of 9 pixels at scale 1 has some 28 at scale 0.5, of which the shadow takes some.
TEST_F(ViewTools, ShowThePatchesThatSeeAnOpening) {
  const Outcome outcome = run_script({{{"load", kBox}},
                                      "wait-solved",
                                      {{"set-look", {{"axes", false}}}},  // of which one is red
                                      {{"set-quantity", "area"}},
                                      {{"screenshot", result("a.png")}},
                                      {{"set-quantity", "unseen"}},
                                      {{"screenshot", result("b.png")}},
                                      {{"report", result("b.json")}},
                                      {{"zoom", 60}},
                                      {{"screenshot", result("c.png")}}},
                                     {"--closed", "yes"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_GT(report("b.json")["open_patches"].size(), 20U);
  const json region = report("b.json")["region"];
  EXPECT_EQ(count_red(result("a.png"), region), 0);
  EXPECT_GT(count_red(result("b.png"), region), 1000);
  EXPECT_GT(count_red(result("c.png"), region), 12);
}

/// Pixels of the colour that a patch is outlined with that is asked.
long count_outline(const Picture& picture, const json& region) {
  const int left = region["left"];
  const int top = region["top"];
  long n = 0;
  for (int y = top; y < top + region["height"].get<int>(); ++y) {
    for (int x = left; x < left + region["width"].get<int>(); ++x) {
      const auto [red, green, blue] = picture.at(x, y);
      if (red > 215 && std::abs(green - 170) < 30 && blue < 90) ++n;
    }
  }
  return n;
}

// On a screen of twice as many pixels all is twice as large, lines too, and the mouse hits the
// same.
TEST_F(ViewTools, AreTwiceAsLargeAtTwiceTheScale) {
  const auto show = [&](const std::string& name, const Arguments& size) {
    const json actions = {{{"load", kBox}},
                          "wait-solved",
                          {{"set-quantity", "form-factors"}},
                          {{"select-at", {{"x", 0.3}, {"y", 0.7}}}},
                          "wait-idle",
                          {{"set-legend", {{"map", "grey"}}}},
                          {{"report", result(name + ".json")}},
                          {{"screenshot", result(name + ".png")}}};
    Arguments arguments = {"view", "--patches", "60", "--script",
                           write_file("script.json", actions.dump())};
    arguments.insert(arguments.end(), size.begin(), size.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  };
  show("a", {"--width", "640", "--height", "480", "--ui-scale", "1"});
  show("b", {"--width", "1280", "--height", "960", "--ui-scale", "2"});
  const json plain = report("a.json");
  const json twice = report("b.json");
  EXPECT_EQ(twice["scale"], 2);
  EXPECT_EQ(plain["selected"]["patch"], twice["selected"]["patch"]);
  for (const char* key : {"left", "top", "width", "height"}) {
    EXPECT_NEAR(twice["region"][key].get<double>(), 2 * plain["region"][key].get<double>(), 4)
        << key;
  }
  const auto one = count_outline(read_png(result("a.png")), plain["region"]);
  const auto four = count_outline(read_png(result("b.png")), twice["region"]);
  // Twice as long and wide; of what is blended at its sides not all counts.
  EXPECT_GT(one, 20);
  EXPECT_GT(four, 3 * one);
  EXPECT_LT(four, 6 * one);
}

TEST_F(ViewTools, HideSurfacesAndMeasure) {
  const Outcome outcome = run_script({{{"load", kBox}},
                                      "wait-solved",
                                      {{"screenshot", result("a.png")}},
                                      {{"report", result("a.json")}},
                                      {{"sort-surfaces", {{"by", "area"}, {"falling", true}}}},
                                      {{"show-surface", {{"surface", "left"}, {"on", false}}}},
                                      {{"mark-surface", "floor"}},
                                      {{"list-surfaces", "material"}},
                                      {{"screenshot", result("b.png")}},
                                      {{"measure", {{"from", {0, 0, 0}}, {"to", {0.3, 0, 0.4}}}}},
                                      {{"save-view", "front"}},
                                      {{"zoom", {{"factor", 0.5}, {"x", 0.2}, {"y", 0.7}}}},
                                      {{"orbit", {{"right", 20}, {"x", 0.5}, {"y", 0.5}}}},
                                      {{"report", result("b.json")}},
                                      {{"use-view", "front"}},
                                      {{"measure-at", {{"x", 0.5}, {"y", 0.8}}}},
                                      {{"report", result("c.json")}},
                                      {{"isolate-surface", {{"material", "red"}}}},
                                      {{"mark-surface", {{"emitter", "light"}}}},
                                      {{"report", result("e.json")}},
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
  for (const json& surface : report("e.json")["surfaces"]) {
    EXPECT_EQ(surface["shown"], surface["material"] == "red");
    EXPECT_EQ(surface["marked"], surface["material"] == "light");
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
