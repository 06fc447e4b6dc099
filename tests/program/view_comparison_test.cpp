// Before and after in the desktop window, on a virtual display.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/view_program.h"

namespace radiosity::test {
namespace {

using nlohmann::json;
using ViewComparison = ViewProgram;

TEST_F(ViewComparison, PinnedLightStandsBesideThatOfNowOrIsSubtracted) {
  const Outcome outcome = run_script({{{"load", kBox}},
                                      "wait-solved",
                                      "pin",
                                      {{"set-emitter", {{"emitter", 0}, {"scale", 0.1}}}},
                                      "wait-solved",
                                      {{"compare", {{"mode", "wipe"}, {"split", 0.5}}}},
                                      {{"report", result("beside.json")}},
                                      {{"screenshot", result("beside.png")}},
                                      {{"set-quantity", "illuminance"}},
                                      {{"compare", "difference"}},
                                      {{"report", result("first.json")}},
                                      {{"screenshot", result("difference.png")}},
                                      {{"report", result("difference.json")}},
                                      "undo",
                                      "wait-solved",
                                      {{"screenshot", result("undone.png")}},
                                      {{"report", result("undone.json")}},
                                      {{"restart", 300}},
                                      "wait-solved",
                                      {{"report", result("again.json")}},
                                      "unpin",
                                      {{"report", result("unpinned.json")}}});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;

  // The back wall, to either side of its middle.
  const json beside = report("beside.json");
  const Picture picture = read_png(result("beside.png"));
  const auto before = color_at(picture, beside, 0.42, 0.3);
  const auto now = color_at(picture, beside, 0.58, 0.3);
  EXPECT_GT(before[1], 2 * now[1]);
  EXPECT_EQ(beside["comparison"]["shown"], "wipe");

  const json difference = report("difference.json");
  EXPECT_EQ(difference["comparison"]["shown"], "difference");
  const json legend = difference["look"]["legend"];
  EXPECT_EQ(legend["low"].get<double>(), -legend["high"].get<double>());
  EXPECT_LT(legend["least"], 0);
  const auto darker = color_at(read_png(result("difference.png")), difference, 0.42, 0.45);
  EXPECT_GT(darker[2], darker[0]);  // blue

  const json undone = report("undone.json");
  EXPECT_EQ(undone["mix"]["emitters"][0]["scale"], 1);
  EXPECT_EQ(undone["mix"]["can_undo"], false);
  const auto same = color_at(read_png(result("undone.png")), undone, 0.42, 0.45);
  EXPECT_NEAR(same[0], same[2], 3);  // grey
  EXPECT_NEAR(same[1], same[2], 3);

  EXPECT_EQ(report("again.json")["comparison"]["shown"], "wipe");
  EXPECT_EQ(report("again.json")["comparison"]["pinned"]["has_same_patches"], false);
  EXPECT_TRUE(report("unpinned.json")["comparison"]["pinned"].is_null());
}

TEST_F(ViewComparison, ActionsThatCannotBeDoneAreRefused) {
  const auto refusal = [&](const json& action) {
    const Outcome outcome = run_script({{{"load", kBox}}, "wait-solved", action});
    EXPECT_EQ(outcome.exit_code, 1) << action;
    return outcome.err;
  };
  EXPECT_NE(refusal({{"compare", "wipe"}}).find("no light is pinned"), std::string::npos);
  EXPECT_NE(refusal({{"compare", "sideways"}}).find("no comparison is called 'sideways'"),
            std::string::npos);
  EXPECT_NE(refusal("undo").find("nothing to undo"), std::string::npos);
}

}  // namespace
}  // namespace radiosity::test
