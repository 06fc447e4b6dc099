// What lies over the picture leaves room for each other, in windows of any size.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/viewer/sessions.h"
#include "viewer/desk/desk.h"
#include "viewer/desk/labels.h"
#include "viewer/desk/picture_plan.h"
#include "viewer/desk/picture_words.h"
#include "viewer/desk/status_parts.h"
#include "viewer/work/standing.h"

namespace {

using viewer::Box;
using viewer::PicturePlan;
using viewer::PictureWords;
using viewer::Region;
using namespace radiosity::test;

constexpr float kPlainLine = 17;

/// As if each letter were half as wide as a line is high, and words could be broken anywhere.
viewer::TextSizes plain_sizes(float scale) {
  const float line = kPlainLine * scale;
  return {.scale = scale, .line = line, .measure = [line](const std::string& text, float width) {
            const float length = 0.5F * line * static_cast<float>(text.size());
            return viewer::TextExtent{std::min(length, width), line * std::ceil(length / width)};
          }};
}

viewer::Legend long_legend() {
  viewer::Legend legend;
  legend.title = {"light sent to patch 1234", "W/m² per m²", "mean of 3 bands", "logarithmic"};
  legend.fit = "0 to 98 % of patches";
  return legend;
}

std::vector<Box> boxes(const PicturePlan& plan) {
  std::vector<Box> all;
  for (const auto& box : {plan.badge, plan.pinned, plan.message, plan.axes}) {
    if (box) all.push_back(*box);
  }
  if (plan.legend) all.push_back(plan.legend->box);
  return all;
}

void expect_tidy(const PicturePlan& plan, const Region& region) {
  const std::vector<Box> all = boxes(plan);
  const auto left = static_cast<float>(region.left);
  const auto top = static_cast<float>(region.top);
  for (std::size_t k = 0; k < all.size(); ++k) {
    EXPECT_GE(all[k].left, left - 0.01F);
    EXPECT_GE(all[k].top, top - 0.01F);
    EXPECT_LE(all[k].right(), left + static_cast<float>(region.width) + 0.01F);
    EXPECT_LE(all[k].bottom(), top + static_cast<float>(region.height) + 0.01F);
    for (std::size_t other = 0; other < k; ++other) EXPECT_FALSE(all[k].overlaps(all[other]));
  }
  if (!plan.legend) return;
  const Box& bar = plan.legend->bar;
  EXPECT_GE(bar.height, 2 * kPlainLine * 0.5F);
  EXPECT_GT(bar.left, plan.legend->box.left);
  EXPECT_GT(bar.top, plan.legend->box.top);
  EXPECT_LT(bar.bottom(), plan.legend->box.bottom());
  EXPECT_EQ(plan.legend->position(bar.top), 1);
  EXPECT_EQ(plan.legend->position(bar.bottom()), 0);
}

TEST(PicturePlan, LaysNothingOverAnythingElse) {
  const viewer::Legend legend = long_legend();
  for (const float scale : {0.5F, 1.F, 1.5F, 2.F, 3.F}) {
    for (const int width : {20, 90, 160, 210, 370, 400, 640, 1600, 3840}) {
      for (const int height : {20, 60, 110, 190, 240, 500, 2100}) {
        for (const double split : {0.0, 0.03, 0.4, 0.8, 1.0}) {
          for (const bool has_legend : {false, true}) {
            SCOPED_TRACE(testing::Message() << scale << ": " << width << " x " << height << ", "
                                            << split << ", " << has_legend);
            const Region region{.left = 270, .top = 21, .width = width, .height = height};
            const PictureWords words{
                .badge = "preview: form factors to about 9 % (being painted)",
                .pinned = split > 0 ? "pinned: solved, known to ± 0.8 % (2 σ)" : "",
                .message = "Evaluating the form factors of this patch ...",
                .split = split,
                .legend = has_legend ? &legend : nullptr};
            expect_tidy(make_picture_plan(region, words, plain_sizes(scale)), region);
          }
        }
      }
    }
  }
}

// What one cannot do without is there in the smallest window, of 400 x 300 pixels.
TEST(PicturePlan, KeepsBadgeAndBarInSmallWindows) {
  const viewer::Legend legend = long_legend();
  const PictureWords words{.badge = "solved, known to ± 0.59 % (2 σ)", .legend = &legend};
  for (const Region& region :
       {Region{.top = 21, .width = 400, .height = 190}, Region{.width = 370, .height = 340},
        Region{.width = 160, .height = 400}, Region{.width = 400, .height = 300}}) {
    SCOPED_TRACE(testing::Message() << region.width << " x " << region.height);
    const PicturePlan plan = make_picture_plan(region, words, plain_sizes(1));
    expect_tidy(plan, region);
    EXPECT_TRUE(plan.badge);
    ASSERT_TRUE(plan.legend);
    EXPECT_GE(plan.legend->n_titles, 1U);
  }
  // With room there are all words, and the bar is as wide as ever.
  const PicturePlan plan = make_picture_plan({.width = 1000, .height = 700}, words, plain_sizes(2));
  EXPECT_EQ(plan.legend->n_titles, legend.title.size());
  EXPECT_TRUE(plan.legend->has_details);
  EXPECT_TRUE(plan.axes);
  EXPECT_EQ(plan.legend->box.width, 320);
}

// One figure tells how well the light is known, wherever it is told.
TEST(PictureWords, TellTheAccuracyAsTheStatusDoes) {
  viewer::Desk desk({.patches = {.n_patches = 100}});
  open(desk.session, kBox);
  viewer::update(desk);
  const std::string accuracy = viewer::accuracy_text(desk.session);
  EXPECT_TRUE(accuracy.starts_with("known to ± ")) << accuracy;
  EXPECT_TRUE(accuracy.ends_with(" % (2 σ)")) << accuracy;
  EXPECT_EQ(viewer::picture_words(desk).badge, "solved, " + accuracy);
  const auto parts = viewer::status_parts(desk.session);
  ASSERT_EQ(parts.size(), 4U);
  EXPECT_EQ(parts[0], "ready");
  EXPECT_EQ(parts[2], accuracy);
  EXPECT_EQ(viewer::asked_text(desk.session), "asked of the form factors: 1 %");
}

TEST(PictureWords, TellWhatIsMissing) {
  viewer::Desk desk;
  EXPECT_TRUE(viewer::picture_words(desk).is_message_central);
  EXPECT_NE(viewer::picture_words(desk).message, "");
  EXPECT_EQ(viewer::status_parts(desk.session), std::vector<std::string>{"no scene"});
}

// What is written at places of the scene has to find room between them.
TEST(PicturePlan, TellsWhereThereIsRoomLeft) {
  const viewer::Legend legend = long_legend();
  const PictureWords words = {.badge = "preview: 43 % of the light still on its way",
                              .pinned = "pinned: solved",
                              .message = "No light is known.",
                              .split = 0.5,
                              .legend = &legend};
  for (const Region& region : {Region{.left = 0, .top = 0, .width = 400, .height = 300},
                               Region{.left = 310, .top = 22, .width = 1000, .height = 700}}) {
    const PicturePlan plan = make_picture_plan(region, words, plain_sizes(1));
    ASSERT_TRUE(plan.legend && plan.badge);
    int n_clear = 0;
    for (int x = -20; x < region.width + 20; x += 7) {
      for (int y = -20; y < region.height + 20; y += 7) {
        const Box box = {static_cast<float>(region.left + x), static_cast<float>(region.top + y),
                         30, 17};
        const bool is_inside =
            x >= 0 && y >= 0 && x + 30 <= region.width && y + 17 <= region.height;
        const std::vector<Box> taken = boxes(plan);
        const bool is_free = std::none_of(taken.begin(), taken.end(),
                                          [&](const Box& other) { return other.overlaps(box); });
        EXPECT_EQ(is_clear(plan, region, box), is_inside && is_free) << x << ' ' << y;
        n_clear += is_inside && is_free ? 1 : 0;
      }
    }
    EXPECT_GT(n_clear, 0);
  }
}

// Readings close together, and numbers among them: each is whole, or is not there.
TEST(Labels, LieOverNothing) {
  const Region region = {.left = 310, .top = 22, .width = 400, .height = 300};
  const viewer::Legend legend = long_legend();
  const PicturePlan plan =
      make_picture_plan(region, {.badge = "solved", .legend = &legend}, plain_sizes(1));
  viewer::Labels labels(plan, region);
  std::vector<Box> taken = boxes(plan);
  int n_taken = 0;
  for (int k = 0; k < 400; ++k) {
    const auto left = static_cast<float>(region.left + (k * 89) % 400);
    const auto top = static_cast<float>(region.top + (k * 53) % 300);
    const auto place = labels.take({{left, top, 60, 17}, {left - 80, top, 60, 17}});
    if (!place) continue;
    ++n_taken;
    EXPECT_TRUE(is_clear(plan, region, *place));
    for (const Box& other : taken) EXPECT_FALSE(other.overlaps(*place)) << k;
    taken.push_back(*place);
  }
  EXPECT_GT(n_taken, 10);
  // What has to be told is, and others keep clear of it, too.
  const Box first = taken.back();
  EXPECT_EQ(labels.take_any({first}).left, first.left);
  EXPECT_FALSE(labels.take({first}));
}

}  // namespace
