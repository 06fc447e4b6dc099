// What the desktop window shows whoever comes to it first, on a virtual display.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/support/view_program.h"

namespace radiosity::test {
namespace {

using nlohmann::json;
using ViewWelcome = ViewProgram;

TEST_F(ViewWelcome, OffersExamplesAndATour) {
  const Outcome outcome = run_script({"wait-idle",
                                      {{"report", result("empty.json")}},
                                      {{"screenshot", result("empty.png")}},
                                      {{"open-example", "furnace-cube"}},
                                      "wait-solved",
                                      {{"tour", 2}},
                                      {{"set-console", 6}},
                                      {{"screenshot", result("tour.png")}},
                                      {{"report", result("tour.json")}},
                                      {{"tour", nullptr}},
                                      "clear-messages",
                                      {{"report", result("end.json")}}});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json examples = report("empty.json")["examples"];
  const auto is_scene = [](const auto& entry) { return entry.path().extension() == ".json"; };
  EXPECT_EQ(static_cast<std::ptrdiff_t>(examples.size()),
            std::ranges::count_if(std::filesystem::directory_iterator(RADIOSITY_SCENES), is_scene));
  for (const json& example : examples) EXPECT_EQ(example["has_picture"], true) << example;
  EXPECT_NE(report("tour.json")["path"].get<std::string>().find("furnace-cube.json"),
            std::string::npos);
  EXPECT_EQ(report("tour.json")["tour"], 2);
  EXPECT_EQ(report("tour.json")["console_lines"], 6);
  // More lines of messages leave less of a picture.
  EXPECT_LT(report("tour.json")["region"]["height"], report("empty.json")["region"]["height"]);
  EXPECT_TRUE(report("end.json")["tour"].is_null());
  EXPECT_TRUE(report("end.json")["messages"].empty());
}

}  // namespace
}  // namespace radiosity::test
