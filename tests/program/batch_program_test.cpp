// End-to-end tests of `radiosity batch`.

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/program.h"
#include "tests/support/wait_until.h"

namespace {

using namespace radiosity::test;
using Json = nlohmann::json;
using Names = std::vector<std::string>;

class BatchProgram : public Program {
 protected:
  std::string write_list(const Json& json, const std::string& name = "list.json") const {
    return write_file(name, json.dump());
  }
  /// A cube of another size, and so of other light.
  std::string write_scene(const std::string& name, double size) const {
    std::ostringstream text;
    text << "mtllib cube.mtl\n";
    for (const char* corner :
         {"0 0 0", "1 0 0", "1 1 0", "0 1 0", "0 0 1", "1 0 1", "1 1 1", "0 1 1"}) {
      std::istringstream numbers(corner);
      text << 'v';
      for (double x = 0; numbers >> x;) text << ' ' << size * x;
      text << '\n';
    }
    text << "usemtl wall\nf 1 2 3 4\nf 5 8 7 6\nf 1 5 6 2\nf 4 3 7 8\nf 1 4 8 5\nf 2 6 7 3\n";
    return write_file(name, text.str());
  }
  void write_scenes() const {
    (void)write_cube(0.5, 1);  // its materials
    write_scene("a.obj", 1);
    write_scene("b.obj", 2);
    write_scene("c.obj", 3);
    write_file("broken.obj", "v 0 0 0\nf 1 2 97\n");
  }
  /// Runs a batch; its results as JSON.
  Json run_json(const std::string& list, int exit_code, const Arguments& more = {}) const {
    Arguments arguments = {"batch", list, "--json", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    return Json::parse(outcome.out, nullptr, false);
  }
  static Names statuses(const Json& results) {
    Names names;
    for (const Json& entry : results.at("entries")) names.push_back(entry.at("status"));
    return names;
  }
  [[nodiscard]] std::size_t n_lines(const std::string& name) const {
    const std::string text = contents(result(name));
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  }
};

const Json kMixed = {
    {"options", {{"as-is", true}, {"tolerance", 0.01}}},
    {"output", "results/{name}.csv"},
    {"entries",
     {{{"scene", "a.obj"}},
      {{"scene", "broken.obj"}},
      {{"scene", "b.obj"},
       {"name", "factors"},
       {"command", "form-factors"},
       {"output", {"results/b.h5"}}},
      {{"scene", "missing.obj"}},
      {{"scene", "c.obj"}, {"command", "exchange"}},
      {{"scene", "c.obj"}, {"name", "bad"}, {"options", {{"no-such-option", 3}}}}}}};

TEST_F(BatchProgram, FailuresStopNothingAndAreTold) {
  write_scenes();
  const std::string list = write_list(kMixed);
  const Json json =
      run_json(list, 1, {"--jobs", "2", "-o", result("t.csv"), "-o", result("t.json")});
  EXPECT_EQ(statuses(json), (Names{"done", "failed", "done", "failed", "done", "failed"}));
  EXPECT_EQ(json.at("done"), 3);
  EXPECT_EQ(json.at("failed"), 3);
  const Json& entries = json.at("entries");
  EXPECT_NE(entries[1].at("message").get<std::string>().find("broken.obj:2"), std::string::npos);
  EXPECT_NE(entries[3].at("message").get<std::string>().find("missing.obj"), std::string::npos);
  EXPECT_NE(entries[5].at("message").get<std::string>().find("no-such-option"), std::string::npos);
  EXPECT_EQ(entries[5].at("exit_code"), 2);
  EXPECT_EQ(entries[2].at("name"), "factors");
  EXPECT_EQ(entries[0].at("summary").at("patches"), 6);
  EXPECT_GT(entries[0].at("memory").get<double>(), 1e6);
  // What runs wrote is what the same command lines write on their own.
  const Outcome alone = run({"form-factors", (folder() / "b.obj").string(), "--as-is",
                             "--tolerance", "0.01", "--quiet", "-o", result("alone.h5")});
  EXPECT_EQ(alone.exit_code, 0) << alone.err;
  EXPECT_TRUE(contents(result("alone.h5")) == contents(result("b.h5")));
  EXPECT_EQ(n_lines("t.csv"), 7U);
  EXPECT_EQ(Json::parse(contents(result("t.json"))), json);
}

TEST_F(BatchProgram, ErrorIsOneLineAndTheTableIsThere) {
  write_scenes();
  const Outcome outcome = run({"batch", write_list(kMixed), "--quiet"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.err, "radiosity: error: 3 of 6 entries failed, as the table tells\n");
  EXPECT_NE(outcome.out.find("3 done, 3 failed"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("broken: "), std::string::npos) << outcome.out;
}

TEST_F(BatchProgram, WhatIsDoneIsKeptUntilItsInputsChange) {
  write_scenes();
  Json pattern = {{"options", {{"as-is", true}}},
                  {"output", "results/{name}.csv"},
                  {"entries", Json::array({{{"scene", "*.obj"}}})}};
  fs::remove(folder() / "broken.obj");
  fs::remove(folder() / "cube.obj");
  const std::string list = write_list(pattern);
  EXPECT_EQ(statuses(run_json(list, 0)), (Names{"done", "done", "done"}));
  EXPECT_EQ(results(), (Names{"a.csv", "b.csv", "c.csv"}));
  EXPECT_EQ(statuses(run_json(list, 0)), (Names{"kept", "kept", "kept"}));
  write_scene("b.obj", 2.5);
  fs::remove(result("c.csv"));
  const Json again = run_json(list, 0);
  EXPECT_EQ(statuses(again), (Names{"kept", "done", "done"}));
  EXPECT_EQ(again.at("entries")[0].at("summary").at("patches"), 6);  // remembered
  (void)write_cube(0.25, 2);  // the materials that all scenes refer to
  fs::remove(folder() / "cube.obj");
  EXPECT_EQ(statuses(run_json(list, 0)), (Names{"done", "done", "done"}));
  EXPECT_EQ(statuses(run_json(list, 0, {"--again"})), (Names{"done", "done", "done"}));
  pattern["options"]["tolerance"] = 0.02;
  EXPECT_EQ(statuses(run_json(write_list(pattern), 0)), (Names{"done", "done", "done"}));
}

TEST_F(BatchProgram, InterruptedItEndsCleanlyAndGoesOn) {
  write_scenes();
  const Json list = {
      {"output", "results/{name}.h5"},
      {"command", "form-factors"},
      {"entries",
       {{{"scene", "a.obj"}, {"options", {{"as-is", true}}}},
        {{"scene", RADIOSITY_SCENES "/cornell-box.json"}, {"options", {{"patches", 6000}}}},
        {{"scene", "b.obj"}, {"options", {{"as-is", true}}}}}}};
  const std::string path = write_list(list);
  const Arguments arguments = {"batch", path, "--json", "--quiet", "-o", result("t.csv")};
  for (const int signal : {SIGINT, SIGTERM}) {
    const Running running = start(arguments);
    EXPECT_TRUE(wait_until([&] { return fs::exists(result("cornell-box.h5.partial")); }));
    running.send(signal);
    const Outcome outcome = running.wait();
    EXPECT_EQ(outcome.exit_code, 130) << outcome.err;
    EXPECT_NE(outcome.err.find("the same command goes on"), std::string::npos) << outcome.err;
    const Json json = Json::parse(outcome.out);
    EXPECT_EQ(statuses(json), (Names{signal == SIGINT ? "done" : "kept", "stopped", "waiting"}));
    EXPECT_EQ(n_lines("t.csv"), 4U);
    fs::remove(result("cornell-box.h5.partial"));
  }
  Json quick = list;
  quick["entries"][1]["options"] = {{"patches", 30}};
  EXPECT_EQ(statuses(run_json(write_list(quick), 0)), (Names{"kept", "done", "done"}));
}

TEST_F(BatchProgram, KilledItLeavesNoRunBehindAndGoesOn) {
  write_scenes();
  const std::string path = write_list(
      {{"command", "form-factors"},
       {"entries",
        {{{"scene", "a.obj"}, {"output", "results/a.h5"}, {"options", {{"as-is", true}}}},
         {{"scene", RADIOSITY_SCENES "/cornell-box.json"},
          {"output", "results/box.h5"},
          {"options", {{"patches", 6000}, {"resume", true}}}}}}});
  {
    const Running running = start({"batch", path, "--quiet"});
    EXPECT_TRUE(wait_until([&] { return fs::exists(result("box.h5.partial")); }));
    running.send(SIGKILL);
    running.wait();
  }
  // The run is asked to stop; its work file is free again.
  EXPECT_TRUE(wait_until([&] {
    const Outcome outcome = run({"form-factors", RADIOSITY_SCENES "/cornell-box.json", "--resume",
                                 "--patches", "40", "--quiet", "-o", result("box.h5")});
    return outcome.err.find("another run is using it") == std::string::npos;
  }));
  const std::string journal = path + ".journal";
  std::ofstream(journal, std::ios::app) << "{\"stamp\": \"half a li";
  fs::remove(result("box.h5.partial"));
  const std::string quick = write_list(
      {{"command", "form-factors"},
       {"entries",
        Json::array(
            {{{"scene", "a.obj"}, {"output", "results/a.h5"}, {"options", {{"as-is", true}}}}})}});
  EXPECT_EQ(statuses(run_json(quick, 0)), Names{"kept"});
}

TEST_F(BatchProgram, EntriesShareTheMemory) {
  const Json list = {{"options", {{"patches", 500}, {"transport", "dense"}}},
                     {"entries",
                      {{{"scene", RADIOSITY_SCENES "/cornell-box.json"}, {"name", "share"}},
                       {{"scene", RADIOSITY_SCENES "/cornell-box.json"},
                        {"name", "own"},
                        {"options", {{"memory", "100MB"}}}}}}};
  // 500 patches need 2.4 n^2 bytes and more, which is above a half of this.
  const Json json = run_json(write_list(list), 1, {"--jobs", "2", "--memory", "1MB"});
  EXPECT_EQ(statuses(json), (Names{"failed", "done"}));
  const std::string message = json.at("entries")[0].at("message");
  EXPECT_NE(message.find("memory"), std::string::npos) << message;
}

TEST_F(BatchProgram, BadListsAreOneLine) {
  write_scenes();
  const auto expect_refused = [&](const Json& list, const std::string& words) {
    SCOPED_TRACE(list.dump());
    expect_error(run({"batch", write_list(list)}), 1, words);
  };
  const Json entry = {{"scene", "a.obj"}};
  expect_error(run({"batch", "no-such-list.json"}), 1, "no-such-list.json");
  expect_error(run({"batch", write_file("list.json", "[1, 2")}), 1, "list.json:");
  expect_refused({{"entries", Json::array()}}, "entries: has no entries");
  expect_refused({{"entries", Json::array({1})}}, "entries[0]");
  expect_refused({{"entries", Json::array({{{"output", "x.csv"}}})}}, "scene");
  expect_refused({{"scenes", Json::array({entry})}}, "scenes");
  expect_refused({{"command", "view"}, {"entries", Json::array({entry})}},
                 "command: found 'view', expected one of solve, render, ");
  expect_refused({{"options", {{"json", true}}}, {"entries", Json::array({entry})}},
                 "options.json: is not");
  expect_refused({{"options", {{"--as-is", true}}}, {"entries", Json::array({entry})}},
                 "without dashes");
  expect_refused({{"options", {{"patches", nullptr}}}, {"entries", Json::array({entry})}},
                 "options.patches");
  expect_refused({{"entries", Json::array({{{"scene", "*.stl"}}})}}, "no file fits '*.stl'");
  expect_refused({{"output", "results/x.csv"}, {"entries", {entry, {{"scene", "b.obj"}}}}},
                 "'a' and 'b' write the same file results/x.csv");
  expect_refused(
      {{"output", "b.obj"}, {"entries", {entry, {{"scene", "b.obj"}, {"output", "x.csv"}}}}},
      "which is the scene of 'b'");
  const std::string list =
      write_list({{"output", "results/a.csv"}, {"entries", Json::array({entry})}});
  expect_error(run({"batch", list, "-o", result("a.csv")}), 1, "it is a file of the list");
  expect_error(run({"batch", list, "-o", list}), 1, "list.json");
  expect_error(run({"batch", list, "--jobs", "0"}), 2, "--jobs");
  expect_error(run({"batch", list, "-o", result("t.txt")}), 2, "--output");
  expect_error(run({"batch"}), 2, "LIST is required");
  write_file("list.json.journal", "somebody's notes\n");
  expect_error(run({"batch", list, "--quiet"}), 1, "list.json.journal: is no journal");
  EXPECT_TRUE(results().empty());
}

}  // namespace
