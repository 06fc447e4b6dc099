// Changes of lamps and materials, back and forth.
#include "viewer/work/mix_history.h"

#include <gtest/gtest.h>

#include "tests/viewer/sessions.h"

namespace {

using viewer::LightMix;
using viewer::MixHistory;
using namespace radiosity::test;

LightMix mix_of(double scale) {
  LightMix mix;
  mix.emitters.push_back({.name = "lamp", .surfaces = {}, .scale = scale});
  return mix;
}

double scale_of(const LightMix& mix) { return mix.emitters[0].scale; }

constexpr MixHistory::Item kLamp = {MixHistory::Item::Kind::emitter, 0};
constexpr MixHistory::Item kWall = {MixHistory::Item::Kind::material, 0};

TEST(MixHistory, GoesBackAndForth) {
  MixHistory history;
  EXPECT_FALSE(history.can_undo());
  history.note(kLamp, mix_of(0));
  history.note(kWall, mix_of(1));
  history.note(kLamp, mix_of(2));
  LightMix now = mix_of(3);
  for (const double expected : {2, 1, 0}) {
    ASSERT_TRUE(history.can_undo());
    now = history.undo(now);
    EXPECT_EQ(scale_of(now), expected);
  }
  EXPECT_FALSE(history.can_undo());
  for (const double expected : {1, 2, 3}) {
    ASSERT_TRUE(history.can_redo());
    now = history.redo(now);
    EXPECT_EQ(scale_of(now), expected);
  }
  EXPECT_FALSE(history.can_redo());
  // What is changed after an undo has no other future.
  now = history.undo(now);
  history.note(kLamp, now);
  EXPECT_FALSE(history.can_redo());
}

TEST(MixHistory, TakesADragAsOneStep) {
  MixHistory history;
  for (const double scale : {0., 1., 2.}) history.note(kLamp, mix_of(scale));
  history.begin_step();
  for (const double scale : {3., 4.}) history.note(kLamp, mix_of(scale));
  LightMix now = history.undo(mix_of(5));
  EXPECT_EQ(scale_of(now), 3);
  now = history.undo(now);
  EXPECT_EQ(scale_of(now), 0);
  EXPECT_FALSE(history.can_undo());
  // A drag that goes on after an undo is another step.
  history.note(kLamp, now);
  EXPECT_TRUE(history.can_undo());
}

TEST(MixHistory, ForgetsWhatIsLongAgo) {
  MixHistory history;
  for (int k = 0; k < 250; ++k) {
    history.begin_step();
    history.note(kLamp, mix_of(k));
  }
  int n_steps = 0;
  LightMix now = mix_of(250);
  for (; history.can_undo(); ++n_steps) now = history.undo(now);
  EXPECT_EQ(n_steps, 100);
  EXPECT_EQ(scale_of(now), 150);
}

TEST(Session, UndoesChangesAndResetsSingleOnes) {
  viewer::Session session(coarse());
  open(session, kBox);
  const Eigen::MatrixXd before = session.light()->solution.radiosity;
  const Eigen::VectorXd white = session.mix().reflectance[0];
  session.set_emitter(0, 0.5, true);
  session.set_reflectance(0, Eigen::Vector3d::Constant(0.2));
  settle(session);
  session.undo_mix();
  EXPECT_EQ(session.mix().reflectance[0], white);
  EXPECT_EQ(session.mix().emitters[0].scale, 0.5);
  session.undo_mix();
  settle(session);
  EXPECT_LE((session.light()->solution.radiosity - before).norm(), 1e-6 * before.norm());
  EXPECT_FALSE(session.mix_history().can_undo());
  session.undo_mix();  // nothing to do
  session.redo_mix();
  session.redo_mix();
  EXPECT_EQ(session.mix().emitters[0].scale, 0.5);
  EXPECT_EQ(session.mix().reflectance[0], Eigen::Vector3d::Constant(0.2));
  session.reset_emitter(0);
  EXPECT_EQ(session.mix().emitters[0].scale, 1);
  EXPECT_EQ(session.mix().reflectance[0], Eigen::Vector3d::Constant(0.2));
  session.reset_material(0);
  EXPECT_EQ(session.mix().reflectance[0], white);
  // Solving again keeps the changes and the way back; another file knows neither.
  session.restart({.patches = {.n_patches = 100}});
  settle(session);
  session.undo_mix();
  EXPECT_EQ(session.mix().reflectance[0], Eigen::Vector3d::Constant(0.2));
  open(session, kRoom);
  EXPECT_FALSE(session.mix_history().can_undo());
  EXPECT_FALSE(session.mix_history().can_redo());
}

}  // namespace
