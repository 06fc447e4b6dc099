// What an empty window offers, and the tour.
#include "viewer/desk/examples.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <stdexcept>

#include "io/scene/scene_file.h"
#include "tests/support/output_folder.h"
#include "tests/support/wait_until.h"
#include "viewer/desk/desk.h"
#include "viewer/desk/ray_picture.h"
#include "viewer/desk/tour.h"

namespace {

using radiosity::test::wait_until;
namespace fs = std::filesystem;

/// Share of the pixels that are not the background.
double shown_share(const io::RgbPicture& picture, std::set<io::Rgb>& colors) {
  int n_shown = 0;
  const int n = picture.width * picture.height;
  for (int i = 0; i < n; ++i) {
    const io::Rgb color = {picture.bytes[3 * i], picture.bytes[3 * i + 1],
                           picture.bytes[3 * i + 2]};
    colors.insert(color);
    n_shown += color != viewer::kBackgroundColor ? 1 : 0;
  }
  return static_cast<double>(n_shown) / n;
}

TEST(Examples, HavePicturesThatShowThem) {
  for (const char* name : {"cornell-box", "thermal-enclosure", "opposed-squares"}) {
    SCOPED_TRACE(name);
    const auto scene = io::read_scene(fs::path(RADIOSITY_SCENES) / (std::string(name) + ".json"));
    const io::RgbPicture picture = viewer::example_picture(scene, {});
    EXPECT_EQ(picture.width, viewer::kExampleWidth);
    EXPECT_EQ(picture.height, viewer::kExampleHeight);
    ASSERT_EQ(picture.bytes.size(), 3U * picture.width * picture.height);
    std::set<io::Rgb> colors;
    EXPECT_GT(shown_share(picture, colors), 0.05);
    EXPECT_EQ(viewer::example_picture(scene, {}).bytes, picture.bytes);
    if (std::string(name) == "cornell-box") {
      EXPECT_GT(colors.size(), 1000U);
    }
  }
}

class ExampleFolders : public OutputFolder {};

TEST_F(ExampleFolders, AreReadInTheBackgroundOnceSomebodyLooks) {
  fs::copy_file(fs::path(RADIOSITY_SCENES) / "l-room.json", folder() / "l-room.json");
  std::ofstream(folder() / "broken.json") << "{";
  std::ofstream(folder() / "notes.txt") << "no scene";
  viewer::Examples examples;
  examples.find(folder());
  ASSERT_EQ(examples.list().size(), 2U);
  EXPECT_EQ(examples.list()[0].name, "broken");
  EXPECT_EQ(examples.list()[1].name, "l-room");
  EXPECT_FALSE(examples.is_busy());
  examples.look();
  ASSERT_TRUE(wait_until([&] {
    examples.update();
    return !examples.is_busy();
  }));
  EXPECT_EQ(examples.list()[1].name, "L-shaped room");
  EXPECT_FALSE(examples.list()[1].description.empty());
  EXPECT_TRUE(examples.list()[1].picture);
  EXPECT_FALSE(examples.list()[0].picture);
  EXPECT_EQ(examples.named("l-room"), &examples.list()[1]);
  EXPECT_EQ(examples.named("L-shaped room"), nullptr);
  EXPECT_TRUE(viewer::find_examples(folder() / "nowhere").empty());
}

TEST(Tour, GoesFromStepToStepAndEnds) {
  viewer::Desk desk;
  desk.shows_panels = false;
  viewer::show_tour(desk, 0);
  EXPECT_TRUE(desk.shows_panels);  // which it points at
  std::set<viewer::TourTarget> targets;
  for (int k = 0; desk.tour_step; ++k) {
    EXPECT_EQ(desk.tour_step, k);
    const viewer::TourStep& step = viewer::tour_steps()[static_cast<std::size_t>(k)];
    EXPECT_TRUE(targets.insert(step.target).second);
    EXPECT_NE(std::string(step.text), "");
    viewer::go_on_with_tour(desk);
  }
  EXPECT_EQ(targets.size(), viewer::tour_steps().size());
  EXPECT_THROW(viewer::show_tour(desk, -1), std::out_of_range);
  EXPECT_THROW(viewer::show_tour(desk, 5), std::out_of_range);
  viewer::show_tour(desk, 2);
  viewer::end_tour(desk);
  EXPECT_FALSE(desk.tour_step);
}

}  // namespace
