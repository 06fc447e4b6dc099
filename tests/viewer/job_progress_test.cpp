// How far the work is, as a person is told.
#include <gtest/gtest.h>

#include <string>

#include "viewer/work/job_progress.h"

namespace {

viewer::WorkStatus stage(const char* name, double done) {
  return {.is_busy = true, .stage = name, .done = done, .total = 1};
}

TEST(JobProgress, NeverRunsBackwardsAndTellsRoundsAndTime) {
  viewer::JobProgress job;
  job.set_rounds(true);
  EXPECT_EQ(job.text(), "");
  double fraction = 0;
  double now = 0;
  for (const auto& status :
       {stage("form factors", 0), stage("form factors", 0.4), stage("form factors", 0.75),
        stage("form factors", 0.7), stage("solve", 0.2), stage("patch size", 1),
        stage("form factors", 0.1), stage("form factors", 0.2), stage("solve", 0.5)}) {
    job.update(status, now += 10);
    EXPECT_GE(job.fraction(), fraction);
    EXPECT_LT(job.fraction(), 1);
    fraction = job.fraction();
  }
  EXPECT_NE(job.text().find("round 2: light"), std::string::npos) << job.text();
  EXPECT_LT(fraction, 0.5);  // there may be more
  job.update({}, now);
  EXPECT_EQ(job.text(), "");
  job.update(stage("form factors", 0.01), now);
  job.update(stage("form factors", 0.2), now + 10);
  EXPECT_EQ(job.text(), "form factors 20 %, about 40 s left");
  EXPECT_GT(job.fraction(), 0);
}

// A stage that does not tell how far it is shows that it is alive, and leaves room for the others.
TEST(JobProgress, GoesOnThroughStagesThatTellNothing) {
  viewer::JobProgress job;
  const viewer::WorkStatus silent = {.is_busy = true, .stage = "dividing"};
  double fraction = 0;
  job.update(silent, 0);
  EXPECT_EQ(job.text(), "dividing into patches");
  for (const double now : {0.5, 3.0, 12.0, 500.0}) {
    job.update(silent, now);
    EXPECT_GT(job.fraction(), fraction);
    fraction = job.fraction();
  }
  EXPECT_LT(fraction, 0.2);
  EXPECT_EQ(job.text(), "dividing into patches, 8 min so far");
  job.update({.is_busy = true}, 501);
  EXPECT_GE(job.fraction(), fraction);
  fraction = job.fraction();
  job.update(stage("form factors", 0.01), 600);
  EXPECT_GE(job.fraction(), fraction);
  job.update(stage("form factors", 1), 700);
  EXPECT_GT(job.fraction(), 0.5);
}

// Of very many patches the division first tells nothing, and then how far it is; it is the shorter
// part of the work all the same.
TEST(JobProgress, TellsHowLongTheDivisionTakes) {
  viewer::JobProgress job;
  double fraction = 0;
  const auto update = [&](double done, double total, double now) {
    job.update({.is_busy = true, .stage = "dividing", .done = done, .total = total}, now);
    EXPECT_GE(job.fraction(), fraction);
    fraction = job.fraction();
  };
  update(0, 0, 0);
  update(0, 0, 2);
  EXPECT_EQ(job.text(), "dividing into patches, 2 s so far");
  update(1e4, 1e6, 2);
  update(2.5e5, 1e6, 8);
  EXPECT_EQ(job.text(), "dividing into patches 25 %, about 20 s left");
  update(1e6, 1e6, 30);
  EXPECT_EQ(job.text(), "dividing into patches 100 %");
  update(0, 0, 34);
  EXPECT_LT(fraction, 0.3);
}

}  // namespace
