// The desktop window, driven by scripts on a virtual display.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

#include "tests/support/view_program.h"
#include "tests/support/wait_until.h"

namespace radiosity::test {
namespace {

using nlohmann::json;
using View = ViewProgram;

TEST_F(View, ShowsTheSolvedBoxInItsColors) {
  const json actions = {{{"load", kBox}},
                        "wait-solved",
                        {{"report", result("r.json")}},
                        {{"screenshot", result("a.png")}}};
  const Outcome outcome =
      run({"view", "--patches", "600", "--script", write_file("script.json", actions.dump())});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const json state = report("r.json");
  EXPECT_EQ(state["light"]["kind"], "complete");
  const Picture picture = read_png(result("a.png"));
  EXPECT_EQ(picture.width, 1280);
  EXPECT_EQ(picture.height, 800);
  const auto red = color_at(picture, state, 0.1, 0.4);
  const auto green = color_at(picture, state, 0.92, 0.4);
  const auto light = color_at(picture, state, 0.5, 0.145);
  EXPECT_GT(red[0], 3 * red[1]);
  EXPECT_GT(green[1], green[0]);
  EXPECT_GT(green[1], 3 * green[2]);
  EXPECT_EQ(light, (std::array{255, 255, 255}));
}

TEST_F(View, ScreenshotWithoutAScriptIsOfTheSolvedScene) {
  const Outcome outcome = run({"view", kBox, "--patches", "300", "--width", "900", "--height",
                               "600", "--ui-scale", "0.8", "--screenshot", result("a.png")});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(read_png(result("a.png")).width, 900);
}

TEST_F(View, AnswersWhatIsAskedOfAPatch) {
  const Outcome outcome = run_script(
      {{{"load", kBox}},
       "wait-solved",
       {{"light-path", true}},
       {{"select-at", {{"x", 0.5}, {"y", 0.4}}}},
       "wait-idle",
       {{"report", result("a.json")}},
       {{"set-quantity", "form-factors"}},
       {{"report", result("b.json")}},
       {{"screenshot", result("b.png")}},
       {{"set-quantity", "light-path"}},
       {{"screenshot", result("c.png")}},
       {{"set-quantity", {{"quantity", "illuminance"}, {"log", true}, {"range", {1, 1000}}}}},
       {{"screenshot", result("d.png")}},
       {{"report", result("d.json")}}});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json patch = report("a.json")["selected"];
  EXPECT_EQ(patch["partners"].size(), 10U);
  EXPECT_GT(patch["row_sum"], 0.1);
  ASSERT_EQ(patch["emitters"].size(), 1U);
  EXPECT_NEAR(patch["emitters"][0]["share"], 1, 1e-9);
  for (int b = 0; b < 3; ++b) {
    EXPECT_NEAR(patch["emitters"][0]["radiosity"][b].get<double>(), patch["radiosity"][b],
                1e-5 * patch["radiosity"][b].get<double>());
  }
  double shares = 0;
  for (const json& arrival : patch["arrivals"]) shares += arrival["share"].get<double>();
  EXPECT_NEAR(shares, 1, 1e-12);
  // The picture stays where it is, with a colour bar or without.
  EXPECT_EQ(report("d.json")["region"], report("a.json")["region"]);
  const json legend = report("d.json")["look"]["legend"];
  EXPECT_EQ(legend["low"], 1);
  EXPECT_EQ(legend["high"], 1000);
  EXPECT_EQ(legend["log"], true);
  EXPECT_EQ(legend["title"][1], "lux");
  EXPECT_NE(read_png(result("b.png")).bytes, read_png(result("d.png")).bytes);
}

TEST_F(View, LampsAndMaterialsChangeThePicture) {
  const Outcome outcome =
      run_script({{{"load", kBox}},
                  "wait-solved",
                  {{"set-emitter", {{"emitter", "light"}, {"scale", 0.5}}}},
                  {{"report", result("half.json")}},
                  {{"toggle-emitter", 0}},
                  {{"report", result("off.json")}},
                  {{"screenshot", result("off.png")}},
                  "reset-scene",
                  {{"set-reflectance", {{"material", "white"}, {"value", 0.9}}}},
                  "wait-solved",
                  {{"report", result("white.json")}},
                  "reset-scene",
                  "wait-solved",
                  {{"report", result("full.json")}}});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto mean = [&](const std::string& name) {
    return report(name)["light"]["mean_radiosity"][0].get<double>();
  };
  EXPECT_NEAR(mean("half.json"), 0.5 * mean("full.json"), 1e-6 * mean("full.json"));
  EXPECT_EQ(mean("off.json"), 0);
  EXPECT_GT(mean("white.json"), 1.2 * mean("full.json"));
  const Picture off = read_png(result("off.png"));
  EXPECT_EQ(color_at(off, report("off.json"), 0.5, 0.4), (std::array{0, 0, 0}));
}

TEST_F(View, StepsThroughIterations) {
  const Outcome outcome = run_script({{{"load", kBox}},
                                      "wait-solved",
                                      {{"record-iteration", "jacobi"}},
                                      "wait-idle",
                                      {{"set-step", 0}},
                                      {{"report", result("a.json")}},
                                      {{"screenshot", result("a.png")}},
                                      {{"set-step", "last"}},
                                      {{"report", result("b.json")}},
                                      {{"screenshot", result("b.png")}},
                                      {{"set-quantity", "unshot"}},
                                      {{"screenshot", result("c.png")}}});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  // In the beginning there is the lamp alone, in the end the walls are lit.
  EXPECT_EQ(color_at(read_png(result("a.png")), report("a.json"), 0.1, 0.4), (std::array{0, 0, 0}));
  EXPECT_GT(color_at(read_png(result("b.png")), report("b.json"), 0.1, 0.4)[0], 60);
  EXPECT_LT(report("b.json")["iteration"]["bounds"].back(), 1e-5);
}

TEST_F(View, SavesAndOpensResults) {
  const Outcome outcome = run_script({{{"load", kBox}},
                                      "wait-solved",
                                      {{"save-result", result("box.vtp")}},
                                      {{"save-scene", result("box.json")}},
                                      {{"report", result("a.json")}},
                                      {{"load", result("box.vtp")}},
                                      "wait-solved",
                                      {{"report", result("b.json")}},
                                      {{"load", result("box.json")}},
                                      "wait-solved",
                                      {{"report", result("c.json")}}});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(report("b.json")["light"]["kind"], "stored");
  EXPECT_EQ(report("b.json")["light"]["mean_radiosity"],
            report("a.json")["light"]["mean_radiosity"]);
  EXPECT_EQ(report("c.json")["light"]["kind"], "complete");
}

TEST_F(View, SurvivesBadFilesAndTinyWindows) {
  const std::string bad = write_file("bad.obj", "v 1 2\nf 1 2 3\n");
  const std::string vtp = write_file("bad.vtp", "<VTKFile>");
  const std::string h5 = write_file("bad.h5", "HDF");
  const Outcome outcome = run_script({{{"load", kBox}},
                                      "wait-solved",
                                      {{"load", bad}},
                                      "wait-idle",
                                      {{"load", vtp}},
                                      "wait-idle",
                                      {{"load", h5}},
                                      "wait-idle",
                                      {{"action", "resize"}, {"width", 0}, {"height", 0}},
                                      {{"wait", 0.2}},
                                      {{"action", "resize"}, {"width", 300}, {"height", 40}},
                                      {{"wait", 0.2}},
                                      {{"action", "resize"}, {"width", 1000}, {"height", 700}},
                                      {{"wait", 0.2}},
                                      {{"report", result("a.json")}},
                                      {{"screenshot", result("a.png")}}});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json state = report("a.json");
  EXPECT_EQ(state["path"], kBox);
  EXPECT_EQ(state["light"]["kind"], "complete");
  std::string messages;
  for (const json& message : state["messages"]) messages += message["text"].get<std::string>();
  for (const char* name : {"bad.obj", "bad.vtp", "bad.h5"}) {
    EXPECT_NE(messages.find(name), std::string::npos) << messages;
  }
  EXPECT_EQ(read_png(result("a.png")).width, 1000);
}

TEST_F(View, FailsInOneLine) {
  expect_error(run({"view", (folder() / "none.json").string()}), 1, "none.json");
  expect_error(run_script({{{"load", kBox}}, "wait-solved", {{"select-patch", 123456}}}), 1,
               "there is no patch 123456");
  expect_error(run_script({"jump"}), 1, "no action is called 'jump'");
  expect_error(run_script({{{"load", "none.obj"}}, "wait-solved"}), 1, "none.obj");
  expect_error(run({"view", kBox, "--screenshot", "picture.txt"}), 2, ".png");
}

// Neither a preview nor what could not be solved may leave as a result, and nothing may overwrite
// what is open or the script; what cannot be written is told before the window opens.
TEST_F(View, WritesNothingFalseAndOverwritesNothing) {
  const std::string unsolvable = write_cube(1, 1);
  expect_error(run({"view", unsolvable, "--patches", "60", "--screenshot", result("a.png")}), 1,
               "");
  // At once: nothing is solved by then.
  expect_error(run_script({{{"load", kBox}}, {{"save-result", result("a.vtp")}}}), 1, "");
  const std::string cube = write_cube(0.5, 1);
  const std::string before = contents(cube);
  expect_error(run_script({{{"load", cube}}, "wait-solved", {{"save-scene", cube}}}), 1, "it is");
  expect_error(run_script({{{"load", cube}}, {{"report", cube}}}), 1, "it is");
  EXPECT_EQ(contents(cube), before);
  const std::string script = (folder() / "script.json").string();
  expect_error(run_script({{{"load", cube}}, {{"report", script}}}), 1, "it is");
  expect_error(run_script({{{"load", "none.json"}}, {{"screenshot", result("missing/a.png")}}}), 1,
               "there is no folder");
  EXPECT_TRUE(results().empty());
}

TEST_F(View, SaysWhatIsMissingAndOffersRender) {
  {
    const Environment none("DISPLAY", nullptr);
    const Environment no_wayland("WAYLAND_DISPLAY", nullptr);
    const Outcome outcome = run({"view", kBox});
    expect_error(outcome, 1, "no display");
    expect_error(outcome, 1, "render");
  }
  const Environment old("MESA_GL_VERSION_OVERRIDE", "2.1");
  const Outcome outcome = run({"view", kBox});
  expect_error(outcome, 1, "OpenGL 3.2");
  expect_error(outcome, 1, "render");
}

TEST_F(View, EndsWhenInterrupted) {
  const json actions = {{{"load", kBox}}, {{"report", result("loaded.json")}}, {{"wait", 600}}};
  const Running running = start(
      {"view", kBox, "--patches", "20000", "--script", write_file("script.json", actions.dump())});
  EXPECT_TRUE(wait_until([&] { return fs::exists(result("loaded.json")); }));
  running.send(SIGINT);
  EXPECT_EQ(running.wait().exit_code, 130);
}

/// Random things that a person may do.
json random_actions(std::mt19937& random, int n) {
  const auto below = [&](int limit) { return static_cast<int>(random() % limit); };
  const std::vector<std::string> shown = {"true-colour", "illuminance", "error",   "form-factors",
                                          "light-path",  "unshot",      "watched", "direct",
                                          "indirect",    "area",        "net-flux"};
  const std::vector<std::string> methods = {"cg", "jacobi", "southwell", "gauss-seidel"};
  json actions = json::array();
  for (int k = 0; k < n; ++k) {
    switch (below(12)) {
      case 0:
        actions.push_back({{"select-patch", below(200)}});
        break;
      case 1:
        actions.push_back({{"set-quantity", shown[random() % shown.size()]}});
        break;
      case 2:
        actions.push_back({{"toggle-emitter", 0}});
        break;
      case 3:
        actions.push_back(
            {{"set-reflectance", {{"material", "white"}, {"value", 0.01 * below(100)}}}});
        break;
      case 4:
        actions.push_back({{"orbit", {{"right", below(90)}, {"up", below(40) - 20}}}});
        break;
      case 5:
        actions.push_back({{"restart", 200 + below(400)}});
        break;
      case 6:
        actions.push_back({{"record-iteration", methods[random() % methods.size()]}});
        break;
      case 7:
        actions.push_back(
            {{"action", "resize"}, {"width", 300 + below(900)}, {"height", 100 + below(700)}});
        break;
      case 8:
        actions.push_back(
            {{"load", below(2) == 0 ? kBox : std::string(RADIOSITY_SCENES) + "/l-room.json"}});
        actions.push_back("wait-solved");
        break;
      case 9:
        actions.push_back({{"select-at", {{"x", 0.01 * below(100)}, {"y", 0.01 * below(100)}}}});
        break;
      case 10:
        actions.push_back("reset-scene");
        break;
      default:
        actions.push_back({{"wait", 0.05 * below(10)}});
    }
  }
  return actions;
}

TEST_F(View, SoakLeavesMemoryAsItIs) {
  constexpr unsigned kSeed = 20261125;
  std::mt19937 random(kSeed);
  RecordProperty("seed", static_cast<int>(kSeed));
  json actions = {{{"load", kBox}}, "wait-solved"};
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    // Names that both scenes have, whichever is open.
    actions.push_back({{"load", kBox}});
    actions.push_back("wait-solved");
    for (json& action : random_actions(random, 24)) {
      const bool is_of_the_box = action.is_object() && action.contains("set-reflectance");
      if (is_of_the_box) actions.push_back({{"load", kBox}});
      if (is_of_the_box) actions.push_back("wait-solved");
      actions.push_back(action);
      // Until there is a patch to select and a lamp to switch.
      if (action.is_object() && action.contains("restart")) actions.push_back("wait-solved");
    }
    actions.push_back({{"load", kBox}});
    actions.push_back("wait-solved");
    actions.push_back({{"report", result(std::to_string(round) + ".json")}});
  }
  const Outcome outcome = run_script(actions);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err << " (seed " << kSeed << ")";
  const auto memory = [&](int round) {
    return report(std::to_string(round) + ".json")["resident_bytes"].get<double>();
  };
  // The first rounds fill caches; what leaks would go on growing.
  EXPECT_LT(memory(kRounds - 1), 1.25 * memory(1)) << "seed " << kSeed;
}

}  // namespace
}  // namespace radiosity::test
