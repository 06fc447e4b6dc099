// Iterations that are recorded, played and compared.
#include "viewer/desk/watching.h"

#include <gtest/gtest.h>

#include "tests/viewer/sessions.h"
#include "viewer/desk/desk.h"

namespace {

using radiosity::Index;
using radiosity::Method;
using namespace radiosity::test;

class Watchings : public ::testing::Test {
 protected:
  void SetUp() override {
    open(desk_.session, kBox);
    viewer::update(desk_);
  }
  const viewer::IterationRecord& record(Method method) {
    viewer::record_iteration(desk_, method);
    settle(desk_.session);
    return *desk_.session.iteration();
  }

  viewer::Desk desk_{coarse()};
};

// The same amount of work lies at the same place of the plot, whatever the method calls a step.
TEST_F(Watchings, CountWorkInProducts) {
  const auto n = static_cast<double>(desk_.session.model().mesh->size());
  for (const auto& frame : record(Method::jacobi).frames) {
    EXPECT_EQ(frame->work, frame->iteration);
    EXPECT_FALSE(frame->shooter);
  }
  const viewer::IterationRecord& shots = record(Method::southwell);
  for (const auto& frame : shots.frames) EXPECT_NEAR(frame->work, frame->iteration / n, 1e-9);
  ASSERT_EQ(shots.work.size(), shots.bounds.size());
  EXPECT_EQ(shots.work.front(), 0);
}

TEST_F(Watchings, TellWhichPatchShootsNext) {
  const viewer::IterationRecord& shots = record(Method::southwell);
  const auto& solution = desk_.session.light()->solution;
  ASSERT_TRUE(shots.frames[0]->shooter);
  EXPECT_GT(solution.exitance.row(*shots.frames[0]->shooter).sum(), 0);  // only lamps have light
  for (std::size_t k = 0; k < 10; ++k) {
    const auto& frame = *shots.frames[k];
    ASSERT_EQ(shots.frames[k + 1]->iteration, frame.iteration + 1);
    ASSERT_TRUE(frame.shooter);
    EXPECT_GT(frame.unshot.row(*frame.shooter).sum(), 0);
    EXPECT_EQ(shots.frames[k + 1]->unshot.row(*frame.shooter).sum(),
              0);  // it has no view of itself
  }
  EXPECT_FALSE(shots.frames.back()->shooter);
  EXPECT_EQ(viewer::shown_shooter(desk_.session, desk_.look), shots.frames[0]->shooter);
  viewer::show(desk_, "illuminance");
  EXPECT_FALSE(viewer::shown_shooter(desk_.session, desk_.look));
}

TEST_F(Watchings, AreComparedUntilTheLightChanges) {
  record(Method::jacobi);
  record(Method::southwell);
  record(Method::conjugate_gradients);
  const auto methods = [&] {
    std::vector<Method> found;
    for (const auto& other : desk_.session.compared()) {
      EXPECT_TRUE(other->frames.empty());
      EXPECT_FALSE(other->bounds.empty());
      found.push_back(other->method);
    }
    return found;
  };
  EXPECT_EQ(methods(), (std::vector{Method::jacobi, Method::southwell}));
  record(Method::jacobi);  // replaces the one that there was
  EXPECT_EQ(methods(), (std::vector{Method::southwell, Method::conjugate_gradients}));
  EXPECT_FALSE(desk_.session.is_iteration_stale());
  EXPECT_EQ(viewer::watched_text(desk_.session, desk_.look),
            "Jacobi: emitted light, not reflected yet");
  desk_.session.set_emitter(0, 0.5, true);
  settle(desk_.session);
  EXPECT_TRUE(desk_.session.is_iteration_stale());
  EXPECT_NE(viewer::watched_text(desk_.session, desk_.look).find("before"), std::string::npos);
  record(Method::chebyshev);
  EXPECT_TRUE(desk_.session.compared().empty());
  EXPECT_FALSE(desk_.session.is_iteration_stale());
}

TEST_F(Watchings, TellWhatTheStepKnowsOfAPatch) {
  const viewer::IterationRecord& jacobi = record(Method::jacobi);
  EXPECT_FALSE(viewer::step_facts(desk_.session, desk_.look));
  desk_.session.select(7);
  for (const std::size_t step : {0, 1, 3}) {
    desk_.look.step = step;
    const auto facts = viewer::step_facts(desk_.session, desk_.look);
    ASSERT_TRUE(facts);
    const viewer::IterationFrame& frame = *jacobi.frames[step];
    EXPECT_EQ(facts->radiosity, frame.radiosity.row(7).transpose().cast<double>());
    EXPECT_EQ(facts->unshot, frame.unshot.row(7).transpose().cast<double>());
  }
  viewer::show(desk_, "true-colour");
  EXPECT_FALSE(viewer::step_facts(desk_.session, desk_.look));
}

viewer::IterationRecord three_frames() {
  viewer::IterationRecord record;
  for (int k = 0; k < 3; ++k) {
    auto frame = std::make_shared<viewer::IterationFrame>();
    frame->iteration = k;
    record.frames.push_back(std::move(frame));
  }
  record.is_complete = true;
  return record;
}

TEST(Watching, PlaysAtItsSpeedToTheEnd) {
  const viewer::IterationRecord record = three_frames();
  viewer::Watching watching;
  viewer::Look look;
  EXPECT_FALSE(viewer::advance(watching, look, record, 5));
  viewer::play(watching, look, &record, 2, 5);
  EXPECT_FALSE(viewer::advance(watching, look, record, 5.4));
  EXPECT_TRUE(viewer::advance(watching, look, record, 5.5));
  EXPECT_EQ(look.step, 1U);
  watching.speed = 10;  // which counts at once
  EXPECT_FALSE(viewer::advance(watching, look, record, 5.55));
  EXPECT_TRUE(viewer::advance(watching, look, record, 5.7));
  EXPECT_EQ(look.step, 2U);
  EXPECT_FALSE(viewer::advance(watching, look, record, 6));
  EXPECT_FALSE(watching.is_playing);
  viewer::play(watching, look, &record, 1000, 7);  // from the start
  EXPECT_EQ(look.step, 0U);
  EXPECT_EQ(watching.speed, viewer::kFastest);
}

TEST(Watching, NamesStepsByWhatTheyDo) {
  EXPECT_EQ(viewer::step_text(Method::jacobi, 1), "light after 1 reflection");
  EXPECT_EQ(viewer::step_text(Method::jacobi, 3), "light after 3 reflections");
  EXPECT_EQ(viewer::step_text(Method::southwell, 120), "after 120 shots");
  EXPECT_EQ(viewer::step_text(Method::gauss_seidel, 1), "after 1 sweep");
  EXPECT_EQ(viewer::step_text(Method::chebyshev, 2), "after 2 steps");
}

}  // namespace
