// Light of now against light that was pinned.
#include "viewer/desk/comparison.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "tests/support/output_folder.h"
#include "tests/viewer/sessions.h"
#include "viewer/desk/desk.h"
#include "viewer/desk/painting.h"
#include "viewer/desk/pinning.h"

namespace {

using viewer::Comparison;
using namespace radiosity::test;

class Comparisons : public OutputFolder {
 protected:
  void open_box() { open_file(kBox); }
  void open_file(const std::string& path) {
    open(desk.session, path);
    viewer::update(desk);
  }
  void settle_all() {
    settle(desk.session);
    viewer::update(desk);
  }
  [[nodiscard]] bool was_told(const std::string& words) const {
    const auto& messages = desk.session.messages();
    return std::any_of(messages.begin(), messages.end(), [&](const viewer::Message& message) {
      return message.text.find(words) != std::string::npos;
    });
  }

  viewer::Desk desk{coarse()};
};

// A lamp at 30 % takes 70 % of every quantity of light away, everywhere.
TEST_F(Comparisons, DifferenceIsNowMinusBefore) {
  open_box();
  viewer::pin(desk);
  desk.session.set_emitter(0, 0.3, true);
  settle_all();
  // (Pinned light keeps no form factors of its own.)
  EXPECT_FALSE(desk.pinning.light->known.model.transport);
  const viewer::Known pinned =
      viewer::with_form_factors_of(desk.session.model(), desk.pinning.light->known);
  for (const char* name : {"illuminance", "radiosity", "direct", "indirect", "true-colour"}) {
    SCOPED_TRACE(name);
    viewer::show(desk, name);
    const auto difference = viewer::shown_difference(desk.session.known(), pinned, desk.look);
    ASSERT_TRUE(difference);
    viewer::Look look = desk.look;
    if (std::string(name) == "true-colour") viewer::show(desk, "luminance");
    const auto before = viewer::shown_field(pinned, desk.look);
    desk.look = look;
    const Eigen::VectorXd expected = -0.7 * before->values;
    EXPECT_LE((difference->values - expected).norm(), 1e-6 * expected.norm());
    EXPECT_EQ(difference->unit, before->unit);
    const auto back = viewer::shown_difference(pinned, desk.session.known(), desk.look);
    EXPECT_EQ(back->values, -difference->values);
  }
  EXPECT_FALSE(viewer::pinned_irradiance(desk));
  desk.session.select(20);
  viewer::update(desk);
  const Eigen::VectorXd now = desk.facts->irradiance;
  EXPECT_LE((0.3 * viewer::pinned_irradiance(desk).value() - now).norm(), 1e-6 * now.norm());
  viewer::show(desk, "form-factors");
  EXPECT_FALSE(viewer::shown_difference(desk.session.known(), pinned, desk.look));
}

TEST_F(Comparisons, DifferencesHaveAScaleAboutZeroAndTheirColours) {
  open_box();
  viewer::pin(desk);
  desk.session.set_emitter(0, 0.5, true);
  settle_all();
  viewer::show(desk, "illuminance");
  desk.look.logarithmic = true;  // which no difference is
  viewer::compare(desk, Comparison::difference);
  const viewer::Painting painting =
      viewer::make_painting({.known = desk.session.known(),
                             .look = desk.look,
                             .exposure = 1,
                             .subtracted = viewer::subtracted_light(desk)});
  ASSERT_TRUE(painting.legend);
  EXPECT_EQ(painting.legend->map, io::ColorMap::diverging);
  EXPECT_FALSE(painting.legend->scale.logarithmic);
  EXPECT_EQ(painting.legend->scale.low, -painting.legend->scale.high);
  EXPECT_LT(painting.legend->least, 0);
  EXPECT_LE(painting.legend->greatest, 0);
  desk.look.range = io::ColorScale{.low = -3, .high = 20};
  viewer::ShownField field{.title = {}, .values = painting.legend->values};
  const io::ColorScale scale = viewer::difference_scale(desk.look, field);
  EXPECT_EQ(scale.low, -20);
  EXPECT_EQ(scale.high, 20);
  // Where nothing has changed, no rounding must look like it.
  desk.look.range.reset();
  desk.session.undo_mix();
  settle_all();
  const auto none =
      viewer::shown_difference(desk.session.known(), desk.pinning.light->known, desk.look);
  ASSERT_TRUE(none);
  EXPECT_LT(none->values.cwiseAbs().maxCoeff(),
            0.01 * viewer::difference_scale(desk.look, *none).high);
}

TEST_F(Comparisons, NeedLightThatIsPinned) {
  EXPECT_THROW(viewer::pin(desk), std::runtime_error);
  EXPECT_THROW(viewer::compare(desk, Comparison::wipe), std::runtime_error);
  viewer::compare_otherwise(desk);
  EXPECT_EQ(desk.look.comparison, Comparison::none);
  open_box();
  viewer::pin(desk);
  for (const auto expected : {Comparison::wipe, Comparison::difference, Comparison::none}) {
    viewer::compare_otherwise(desk);
    EXPECT_EQ(desk.look.comparison, expected);
    EXPECT_EQ(viewer::comparison_named(viewer::comparison_name(expected)), expected);
  }
  viewer::compare(desk, Comparison::difference);
  EXPECT_TRUE(viewer::subtracted_light(desk));
  viewer::show(desk, "area");  // of which there is no other
  EXPECT_EQ(viewer::shown_comparison(desk), Comparison::none);
  viewer::unpin(desk);
  EXPECT_EQ(desk.look.comparison, Comparison::none);
  EXPECT_FALSE(desk.pinning.light);
  for (const double split : {-1., 0., 0.3, 1., 2.}) {
    viewer::set_split(desk, split);
    EXPECT_GT(desk.pinning.split, 0);
    EXPECT_LT(desk.pinning.split, 1);
  }
}

TEST_F(Comparisons, OutliveSolvingAgain) {
  open_box();
  viewer::pin(desk);
  viewer::compare(desk, Comparison::difference);
  const auto pinned = desk.pinning.light;
  // The same patches, made anew.
  desk.session.restart(coarse());
  settle_all();
  EXPECT_NE(desk.session.model().mesh, pinned->known.model.mesh);
  EXPECT_EQ(desk.pinning.light, pinned);
  EXPECT_EQ(viewer::shown_comparison(desk), Comparison::difference);
  // Other patches: side by side only, and it says so.
  desk.session.restart({.patches = {.n_patches = 100}});
  settle_all();
  EXPECT_EQ(desk.pinning.light, pinned);
  EXPECT_EQ(viewer::shown_comparison(desk), Comparison::wipe);
  EXPECT_THROW(viewer::compare(desk, Comparison::difference), std::runtime_error);
  EXPECT_TRUE(was_told("no difference: the pinned light is of other patches"));
}

TEST_F(Comparisons, EndWithTheSceneButGoOnWithItsResults) {
  open_box();
  const std::string before = (folder() / "before.vtp").string();
  viewer::save_result(desk, before);
  desk.session.set_emitter(0, 0.5, true);
  settle_all();
  const std::string after = (folder() / "after.vtp").string();
  viewer::save_result(desk, after);
  // Two results of the same patches.
  open_file(before);
  viewer::pin(desk);
  viewer::show(desk, "illuminance");
  viewer::compare(desk, Comparison::difference);
  open_file(after);
  ASSERT_TRUE(desk.pinning.light);
  EXPECT_EQ(viewer::shown_comparison(desk), Comparison::difference);
  const auto difference =
      viewer::shown_difference(desk.session.known(), desk.pinning.light->known, desk.look);
  ASSERT_TRUE(difference);
  EXPECT_LT(difference->values.minCoeff(), 0);
  EXPECT_LE(difference->values.maxCoeff(), 0);
  // Another scene.
  open_file(kRoom);
  EXPECT_FALSE(desk.pinning.light);
  EXPECT_EQ(desk.look.comparison, Comparison::none);
  EXPECT_TRUE(was_told("is given up"));
}

}  // namespace
