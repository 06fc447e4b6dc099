// Luminaires in the window: under the mouse, in the picture, and dimmed.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/support/view_program.h"
#include "tests/support/wait_until.h"

namespace radiosity::test {
namespace {

using nlohmann::json;

const std::string kOffice = std::string(RADIOSITY_SCENES) + "/office.json";

class ViewLuminaires : public ViewProgramByHand {
 protected:
  json press(int function_key) const {
    const std::string name = std::to_string(function_key) + ".json";
    act("key F" + std::to_string(function_key));
    EXPECT_TRUE(wait_until([&] { return fs::exists(result(name)); })) << name;
    return report(name);
  }
};

json named(const json& list, const std::string& name) {
  for (const json& item : list) {
    if (item["name"] == name) return item;
  }
  return nullptr;
}

/// Pixels of the colour that polar curves in C0-C180 have.
long count_curves(const Picture& picture) {
  long n = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const auto [red, green, blue] = picture.at(x, y);
      if (red > 190 && std::abs(green - 190) < 40 && blue < 110) ++n;
    }
  }
  return n;
}

TEST_F(ViewLuminaires, AreHoveredAndChosenByTheMouse) {
  json actions = {{{"load", kOffice}}, "wait-solved", {{"report", result("0.json")}}};
  for (int k = 1; k <= 3; ++k) {
    actions.push_back({{"wait-key", "F" + std::to_string(k)}});
    actions.push_back({{"screenshot", result(std::to_string(k) + ".png")}});
    actions.push_back({{"report", result(std::to_string(k) + ".json")}});
  }
  const Running running = start_script(actions);
  ASSERT_TRUE(wait_until([&] { return fs::exists(result("0.json")); }));
  const json start = report("0.json");
  ASSERT_EQ(start["luminaires"].size(), 12U);
  // One of those in the picture.
  json shown;
  for (const json& luminaire : start["luminaires"]) {
    if (!luminaire["seen"] || luminaire["place"].is_null()) continue;
    const double x = luminaire["place"][0];
    const double y = luminaire["place"][1];
    if (x > 0.1 && x < 0.9 && y > 0.05 && y < 0.9) shown = luminaire;
  }
  ASSERT_FALSE(shown.is_null());
  const std::string name = shown["name"];
  const json region = start["region"];
  const double x = region["left"].get<double>() +
                   shown["place"][0].get<double>() * region["width"].get<double>();
  const double y = region["top"].get<double>() +
                   shown["place"][1].get<double>() * region["height"].get<double>();
  const std::string place = std::to_string(std::lround(x)) + " " + std::to_string(std::lround(y));
  act("mousemove " + place);
  const json hovered = named(press(1)["luminaires"], name);
  EXPECT_EQ(hovered["hovered"], true);
  EXPECT_EQ(hovered["chosen"], false);
  EXPECT_NE(hovered["text"].get<std::string>().find("office-panel.ies"), std::string::npos);
  act("mousemove " + place + " click 1");
  const json chosen = press(2);
  EXPECT_EQ(named(chosen["luminaires"], name)["chosen"], true);
  EXPECT_TRUE(chosen["selected"].is_null());  // the ceiling behind it was not asked
  act("key Escape");
  EXPECT_EQ(named(press(3)["luminaires"], name)["chosen"], false);
  EXPECT_EQ(running.wait().exit_code, 0);
  EXPECT_GT(count_curves(read_png(result("2.png"))), count_curves(read_png(result("1.png"))) + 50);
}

TEST_F(ViewLuminaires, AreDimmedByScripts) {
  const Outcome outcome =
      run_script({{{"load", kOffice}},
                  "wait-solved",
                  {{"report", result("a.json")}},
                  {{"set-emitter", {{"emitter", "panel-1-1"}, {"scale", 0.5}}}},
                  {{"choose-luminaire", "panel-1-1"}},
                  "wait-solved",
                  {{"report", result("b.json")}},
                  {{"choose-luminaire", nullptr}},
                  {{"set-look", {{"luminaires", false}, {"polar_curves", true}}}},
                  {{"report", result("c.json")}}});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json before = named(report("a.json")["luminaires"], "panel-1-1");
  const json after = named(report("b.json")["luminaires"], "panel-1-1");
  EXPECT_EQ(after["chosen"], true);
  EXPECT_EQ(before["text"].get<std::string>().find("dimmed"), std::string::npos);
  EXPECT_NE(after["text"].get<std::string>().find("dimmed"), std::string::npos);
  // Of twelve alike one gives half: the room's mean falls by about a twenty-fourth.
  const double mean_before = report("a.json")["light"]["mean_radiosity"][0];
  const double mean_after = report("b.json")["light"]["mean_radiosity"][0];
  EXPECT_NEAR(mean_after / mean_before, 1 - 1 / 24.0, 0.02);
  EXPECT_EQ(named(report("a.json")["mix"]["emitters"], "panel-1-1")["kind"], "luminaires");
  EXPECT_EQ(report("c.json")["look"]["luminaires"], false);
  EXPECT_EQ(named(report("c.json")["luminaires"], "panel-1-1")["seen"], false);
  const Outcome unknown = run_script(
      {{{"load", kOffice}}, {{"wait", 0.1}}, "wait-solved", {{"choose-luminaire", "moon"}}});
  EXPECT_EQ(unknown.exit_code, 1);
  EXPECT_NE(unknown.err.find("no luminaire is called 'moon'"), std::string::npos) << unknown.err;
}

}  // namespace
}  // namespace radiosity::test
