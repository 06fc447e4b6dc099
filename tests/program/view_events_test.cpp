// The desktop window under real keys and clicks, which xdotool makes on a virtual display.
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/support/view_program.h"
#include "tests/support/wait_until.h"

namespace radiosity::test {
namespace {

using nlohmann::json;

class ViewEvents : public ViewProgramByHand {
 protected:
  /// Opens a dialog by its key, types the name of a file, and presses more keys.
  static void type_file(const std::string& dialog, const std::string& file,
                        const std::string& keys) {
    act("key " + dialog + " type --delay 5 " + file);
    act("key --delay 5 " + keys);
  }

  /// What the script reports once the function key of that number has been pressed.
  json press(int function_key) const {
    const std::string name = report_name(function_key);
    act("key F" + std::to_string(function_key));
    EXPECT_TRUE(wait_until([&] { return fs::exists(result(name)); })) << name;
    return report(name);
  }

  /// Opens the box, solves it and reports after each function key up to the last one.
  json actions(int last) const {
    json list = {{{"load", kBox}}, "wait-solved", {{"report", result(report_name(0))}}};
    for (int k = 1; k <= last; ++k) {
      list.push_back({{"wait-key", "F" + std::to_string(k)}});
      list.push_back("wait-idle");  // what a key has begun
      list.push_back({{"report", result(report_name(k))}});
    }
    return list;
  }

 private:
  static std::string report_name(int k) { return std::to_string(k) + ".json"; }
};

TEST_F(ViewEvents, TakesEveryKeyAndAsksBeforeItReplaces) {
  const Running running = start_script(actions(6));
  ASSERT_TRUE(wait_until([&] { return fs::exists(result("0.json")); }));
  const json region = report("0.json")["region"];
  const int x = region["left"].get<int>() + region["width"].get<int>() / 2;
  const int y = region["top"].get<int>() + region["height"].get<int>() / 2;

  // However fast: eleven taps of G, three of +.
  act("mousemove " + std::to_string(x) + " " + std::to_string(y) + " click 1");
  act("key --delay 5 i g g g g g g g g g g g plus plus plus");
  json state = press(1);
  EXPECT_EQ(state["look"]["quantity"], "illuminance");
  EXPECT_EQ(state["look"]["log"], true);
  EXPECT_EQ(state["look"]["stops"], 1.5);
  EXPECT_FALSE(state["selected"].is_null());

  // Esc ends dialogs, and nothing is written; then keys are the picture's again.
  act("key --delay 5 ctrl+p Escape ctrl+o Escape t");
  state = press(2);
  EXPECT_EQ(state["look"]["quantity"], "true-colour");
  EXPECT_TRUE(state["messages"].empty()) << state["messages"];
  EXPECT_FALSE(fs::exists(std::string(RADIOSITY_SCENES) + "/cornell-box.png"));

  const std::string picture = result("a.png");
  type_file("ctrl+p", picture, "Return");
  press(3);
  ASSERT_TRUE(wait_until([&] { return fs::exists(picture); }));
  std::ofstream(picture) << "mine";
  type_file("ctrl+p", picture, "Return Escape");
  press(4);
  EXPECT_EQ(contents(picture), "mine");
  type_file("ctrl+p", picture, "Return Return");
  press(5);
  EXPECT_TRUE(wait_until([&] { return contents(picture) != "mine"; }));

  // What cannot be read takes nothing away.
  type_file("ctrl+o", write_file("bad.obj", "v 1 2\nf 1 2 3\n"), "Return");
  state = press(6);
  EXPECT_EQ(state["light"]["kind"], "complete");
  EXPECT_EQ(state["path"], kBox);
  EXPECT_NE(state["messages"].back()["text"].get<std::string>().find("bad.obj"), std::string::npos);
  EXPECT_EQ(running.wait().exit_code, 0);
}

/// Seconds of processor time that a process has taken.
double processor_seconds(pid_t pid) {
  std::ifstream stream("/proc/" + std::to_string(pid) + "/stat");
  std::string word;
  double ticks = 0;
  for (int field = 1; field <= 15 && stream >> word; ++field) {
    if (field >= 14) ticks += std::stod(word);
  }
  return ticks / static_cast<double>(sysconf(_SC_CLK_TCK));
}

// Once all is solved and nobody touches it, it does next to nothing; and it offers again what it
// has opened, not what it could not.
TEST_F(ViewEvents, RestsAndRemembersWhatItOpened) {
  const Running running = start({"view", kBox, "--patches", "60"});
  const fs::path recent = folder() / "radiosity" / "recent";
  ASSERT_TRUE(wait_until([&] { return fs::exists(recent); }));
  act("mousemove 640 400");
  type_file("ctrl+o", write_file("bad.obj", "v 1 2\nf 1 2 3\n"), "Return");
  constexpr double kMostIdle = 0.05;  // of a processor
  EXPECT_TRUE(wait_until([&] {
    const double before = processor_seconds(running.pid());
    std::this_thread::sleep_for(std::chrono::seconds(1));
    return processor_seconds(running.pid()) - before < kMostIdle;
  }));
  EXPECT_EQ(contents(recent), kBox + "\n");
  running.send(SIGINT);
  EXPECT_EQ(running.wait().exit_code, 130);
}

}  // namespace
}  // namespace radiosity::test
