// The desktop window under a window manager and a real mouse: drags, the wheel, files that are
// dropped, other sizes, and its end.
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "tests/support/desktop.h"
#include "tests/support/view_program.h"
#include "tests/support/wait_until.h"

namespace radiosity::test {
namespace {

using nlohmann::json;

class ViewHands : public ViewProgramByHand {
 protected:
  void SetUp() override {
    ViewProgramByHand::SetUp();
    if (IsSkipped()) return;
    manager_.emplace();
    if (!manager_->is_there()) GTEST_SKIP() << "there is no openbox";
  }

  /// Opens the box, solves it and reports after each function key up to the last one, in 0.json,
  /// 1.json...
  Running start_reporting(int last) const {
    json actions = {{{"load", kBox}}, "wait-solved", {{"report", result("0.json")}}};
    for (int k = 1; k <= last; ++k) {
      actions.push_back({{"wait-key", "F" + std::to_string(k)}});
      actions.push_back("wait-idle");
      actions.push_back({{"report", result(std::to_string(k) + ".json")}});
    }
    Running running = start_script(actions);
    EXPECT_TRUE(wait_until([&] { return fs::exists(result("0.json")); }));
    return running;
  }

  json press(int function_key) const {
    const std::string name = std::to_string(function_key) + ".json";
    act("key F" + std::to_string(function_key));
    EXPECT_TRUE(wait_until([&] { return fs::exists(result(name)); })) << name;
    return report(name);
  }

  /// "x y" for xdotool, of a place in the picture from its top left, [0, 1].
  static std::string place(const json& report, double x, double y) {
    const WindowPlace window = window_place("radiosity");
    const json& region = report["region"];
    const double right = window.left + region["left"].get<double>();
    const double down = window.top + region["top"].get<double>();
    return std::to_string(std::lround(right + x * region["width"].get<double>())) + " " +
           std::to_string(std::lround(down + y * region["height"].get<double>()));
  }

  /// What xdotool is to do while the window draws no frame: all of it happens within one.
  static void act_within_a_frame(const Running& running, const std::string& what) {
    running.send(SIGSTOP);
    act(what);
    running.send(SIGCONT);
  }

 private:
  std::optional<WindowManager> manager_;
};

void expect_same_camera(const json& a, const json& b) {
  for (const char* part : {"position", "direction", "up"}) {
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(a["camera"][part][k].get<double>(), b["camera"][part][k].get<double>(), 1e-6)
          << part;
    }
  }
}

bool has_same_camera(const json& a, const json& b) { return a["camera"] == b["camera"]; }

// However slow the frames are, a drag turns as far, from where it began, and asks nothing; a click
// is one, and the wheel goes towards the place where it was turned.
TEST_F(ViewHands, DoTheSameHoweverSlowFramesAre) {
  const Running running = start_reporting(9);
  const json start = report("0.json");
  const std::string from = "mousemove " + place(start, 0.4, 0.6);
  const std::string to = " mousemove " + place(start, 0.6, 0.45);
  const std::string away = " mousemove " + place(start, 0.05, 0.9);

  act(from + " mousedown 1 sleep 0.3" + to + " sleep 0.3 mouseup 1 sleep 0.3");
  const json turned = press(1);
  EXPECT_FALSE(has_same_camera(start, turned));
  EXPECT_TRUE(turned["selected"].is_null());
  act("key c");
  expect_same_camera(press(2), start);
  act_within_a_frame(running, from + " mousedown 1" + to + " mouseup 1");
  const json turned_at_once = press(3);
  EXPECT_TRUE(turned_at_once["selected"].is_null());
  expect_same_camera(turned_at_once, turned);

  act("key c " + from + " sleep 0.3 click --repeat 3 --delay 20 4 sleep 0.3" + away);
  const json near = press(4);
  EXPECT_FALSE(has_same_camera(start, near));
  act("key c");
  press(5);
  act_within_a_frame(running, from + " click --repeat 3 --delay 20 4" + away);
  expect_same_camera(press(6), near);

  act("key c");
  press(7);
  act(from + " sleep 0.2 click 1 sleep 0.3" + away);
  const json asked = press(8);
  ASSERT_FALSE(asked["selected"].is_null());
  act("key Escape");
  act_within_a_frame(running, from + " click 1" + away);
  const json asked_at_once = press(9);
  ASSERT_FALSE(asked_at_once["selected"].is_null());
  EXPECT_EQ(asked_at_once["selected"]["patch"], asked["selected"]["patch"]);
  expect_same_camera(asked_at_once, start);
  EXPECT_EQ(running.wait().exit_code, 0);
}

TEST_F(ViewHands, DropFilesOntoTheWindow) {
  const Running running = start_reporting(2);
  const std::string room = std::string(RADIOSITY_SCENES) + "/l-room.json";
  const std::string bad = write_file("bad one.obj", "v 1 2\nf 1 2 3\n");
  ASSERT_TRUE(drop_files({room}));
  const json dropped = press(1);
  EXPECT_EQ(dropped["path"], room);
  EXPECT_EQ(dropped["light"]["kind"], "complete");
  std::string encoded = bad;
  encoded.replace(encoded.find(' '), 1, "%20");
  ASSERT_TRUE(drop_files({encoded}));
  const json refused = press(2);
  EXPECT_EQ(refused["path"], room);
  EXPECT_NE(refused["messages"].back()["text"].get<std::string>().find("bad one.obj"),
            std::string::npos);
  EXPECT_EQ(running.wait().exit_code, 0);
}

// A file that has changed is told of, and read again by a key, whatever it is called.
TEST_F(ViewHands, ReadAgainWhatHasChanged) {
  const auto plate = [&](const char* length) {
    return write_file("ä plate.obj", "v 0 0 0\nv " + std::string(length) + " 0 0\nv " + length +
                                         " 1 0\nv 0 1 0\nf 1 2 3 4\n");
  };
  const std::string file = plate("1");
  const json actions = {{{"load", file}},     "wait-idle", {{"report", result("0.json")}},
                        {{"wait-key", "F1"}}, "wait-idle", {{"report", result("1.json")}},
                        {{"wait-key", "F2"}}, "wait-idle", {{"report", result("2.json")}}};
  const Running running = start_script(actions);
  ASSERT_TRUE(wait_until([&] { return fs::exists(result("0.json")); }));
  EXPECT_TRUE(report("0.json")["changed_file"].is_null());
  plate("2");
  std::this_thread::sleep_for(std::chrono::seconds(6));  // two looks, and some
  const json told = press(1);
  EXPECT_EQ(told["changed_file"], file);
  EXPECT_NEAR(told["size"][0], 1, 1e-9);
  EXPECT_NE(told["messages"].back()["text"].get<std::string>().find("has changed on disk"),
            std::string::npos);
  act("key ctrl+r");
  const json again = press(2);
  EXPECT_NEAR(again["size"][0], 2, 1e-9);
  EXPECT_TRUE(again["changed_file"].is_null());
  EXPECT_EQ(running.wait().exit_code, 0);
}

// The picture fills what the panels leave of any size, and what was seen in it is still seen.
TEST_F(ViewHands, ResizeTheWindow) {
  const Running running = start_reporting(4);
  const json start = report("0.json");
  int key = 0;
  for (const auto& [width, height] : {std::pair{700, 500}, {300, 120}, {1500, 900}}) {
    const std::string size = std::to_string(width) + " " + std::to_string(height);
    act("search --onlyvisible --name 'radiosity$' windowsize " + size);
    EXPECT_TRUE(wait_until([&, w = width, h = height] {
      const WindowPlace now = window_place("radiosity");
      return now.width == w && now.height == h;
    }));
    const json region = press(++key)["region"];
    EXPECT_GT(region["width"], 0);
    EXPECT_LE(region["left"].get<int>() + region["width"].get<int>(), width);
    EXPECT_LE(region["top"].get<int>() + region["height"].get<int>(), height);
  }
  act("search --name 'radiosity$' windowminimize");
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  act("search --name 'radiosity$' windowmap windowactivate");
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  const json back = press(4);
  expect_same_camera(back, start);
  EXPECT_GT(back["region"]["width"], start["region"]["width"]);
  EXPECT_EQ(running.wait().exit_code, 0);
}

// Of screens that differ in density only the person knows, where the system does not tell.
TEST_F(ViewHands, EnlargeAllTextAtOnce) {
  const Running running = start_reporting(2);
  const json start = report("0.json");
  act("key --delay 20 ctrl+plus ctrl+plus");
  const json larger = press(1);
  EXPECT_EQ(larger["scale"], 1.5);
  EXPECT_EQ(larger["region"]["left"], 1.5 * start["region"]["left"].get<int>());
  expect_same_camera(larger, start);
  act("key --delay 20 ctrl+minus ctrl+minus ctrl+minus");
  const json smaller = press(2);
  EXPECT_EQ(smaller["scale"], 0.75);
  EXPECT_GT(smaller["region"]["width"], start["region"]["width"]);
  EXPECT_EQ(running.wait().exit_code, 0);
}

// Whoever takes the display away is told, in one line, and nothing hangs.
TEST_F(ViewHands, EndWithTheDisplay) {
  std::optional<VirtualDisplay> other;
  other.emplace();
  ASSERT_TRUE(other->is_there());
  const Running running = start({"view", kBox, "--patches", "5000"});
  const bool is_there =
      wait_until([] { return window_place("cornell-box.json - radiosity").width > 0; });
  other.reset();
  ASSERT_TRUE(is_there) << running.wait().err;
  const Outcome outcome = running.wait();
  EXPECT_EQ(outcome.exit_code, 1);
  // Xlib says "X connection to ... broken" or "fatal IO error ... on X server ...".
  const bool is_told = outcome.err.find("X connection") != std::string::npos ||
                       outcome.err.find("X server") != std::string::npos;
  EXPECT_TRUE(is_told) << outcome.err;
}

// Two windows of one scene do not know of each other.
TEST_F(ViewHands, MayBeTwo) {
  const json actions = {{{"load", kBox}}, "wait-solved", {{"report", result("a.json")}}};
  const json others = {{{"load", kBox}}, "wait-solved", {{"report", result("b.json")}}};
  const auto start_one = [&](const std::string& name, const json& list) {
    fs::create_directory(folder() / name);
    const std::string script = write_file(name + ".json", list.dump());
    return Running({"view", "--patches", "60", "--script", script}, folder() / name);
  };
  const Running one = start_one("one", actions);
  const Running two = start_one("two", others);
  EXPECT_EQ(one.wait().exit_code, 0);
  EXPECT_EQ(two.wait().exit_code, 0);
  EXPECT_EQ(report("a.json")["light"]["mean_radiosity"],
            report("b.json")["light"]["mean_radiosity"]);
}

// Whatever it is at, it is gone at once and well.
TEST_F(ViewHands, CloseWhileItIsBusy) {
  const Running running = start({"view", kBox, "--patches", "20000"});
  ASSERT_TRUE(wait_until([] { return window_place("cornell-box.json - radiosity").width > 0; }));
  std::this_thread::sleep_for(std::chrono::seconds(2));  // at form factors and preview
  act("search --name 'radiosity$' windowactivate sleep 0.5 key alt+F4");
  ASSERT_TRUE(wait_until([] { return window_place("radiosity").width == 0; }));
  EXPECT_EQ(running.wait().exit_code, 0);
}

}  // namespace
}  // namespace radiosity::test
