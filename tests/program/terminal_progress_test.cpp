// The lines of progress that the program writes to stderr.

#include "apps/terminal/terminal_progress.h"

#include <gtest/gtest.h>

#include <string>

namespace {

using apps::TerminalProgress;

int count(const std::string& text, const std::string& part) {
  int n = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(TerminalProgress, CountsEachRoundOfAStageByItself) {
  TerminalProgress progress(TerminalProgress::Style::lines);
  ::testing::internal::CaptureStderr();
  for (const double total : {10.0, 1000.0, 10.0}) {
    progress.report("form factors", 0, total, "parts");
    progress.report("form factors", total, total, "parts");
  }
  EXPECT_EQ(count(::testing::internal::GetCapturedStderr(), "form factors: 100 %, took 0.0"), 3);
}

TEST(TerminalProgress, TellsAnEndOnceAndMindsNoReportsOutOfOrder) {
  TerminalProgress progress(TerminalProgress::Style::lines);
  ::testing::internal::CaptureStderr();
  for (const double done : {0.0, 2.0, 1.0, 3.0, 4.0, 4.0}) {
    progress.report("form factors", done, 4, "parts");
  }
  EXPECT_EQ(count(::testing::internal::GetCapturedStderr(), "form factors"), 1);
}

}  // namespace
