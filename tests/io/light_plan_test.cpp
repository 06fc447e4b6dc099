#include "io/scene/json_light_plan.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "io/scene/scene_writer.h"
#include "tests/support/scratch_files.h"

namespace {

using radiosity::GridPlan;
using radiosity::Vec3;

class LightPlans : public ScratchFiles {
 protected:
  static std::string scene(const std::string& more) {
    return R"({"unit": "mm", "bands": "grey",
      "materials": {"a": {"reflectance": 0.5, "maintenance_factor": 0.9}},
      "surfaces": [{"name": "floor", "material": "a",
                    "polygons": [[[0, 0, 0], [1000, 0, 0], [1000, 1000, 0], [0, 1000, 0]]]}], )" +
           more + "}";
  }
};

TEST_F(LightPlans, AreReadInMetres) {
  (void)file("eyes.csv", "x,y,z,nx,ny,nz\r\n100, 200 ,300,0,0,5\r\n# none\r\n1e2,0,0,3,0,4\r\n");
  const auto read_scene = read("room.json", scene(R"("maintenance_factor": 0.8,
    "grids": [
      {"name": "plane", "surface": "floor", "offset": 750, "spacing": 250, "border": 0,
       "cylindrical": true, "vertical": [[2, 0, 0]], "semi_cylindrical": [[0, -1, 0]],
       "luminance_from": [[100, 200, 1500]],
       "required": {"Em": 500, "U0": 0.6, "Ud": 0.4, "UGR": 19}},
      {"name": "desk", "corner": [0, 0, 700], "sides": [[500, 0, 0], [0, 250, 0]]},
      {"name": "eyes", "points": "eyes.csv"},
      {"name": "list", "points": [[1000, 0, 0]], "up": [0, 3, 0]}],
    "observers": [{"name": "a", "position": [0, 0, 1200], "look_at": [1000, 0, 1200], "UGR": 22}])"));
  const radiosity::LightPlan& plan = read_scene.light_plan;
  EXPECT_EQ(plan.maintenance_factor, 0.8);
  EXPECT_EQ(read_scene.materials[0].maintenance_factor, 0.9);
  ASSERT_EQ(plan.grids.size(), 4U);
  EXPECT_EQ(plan.grids[0].offset, 0.75);
  EXPECT_EQ(plan.grids[0].spacing, 0.25);
  EXPECT_EQ(plan.grids[0].border, 0);
  EXPECT_TRUE(plan.grids[0].is_cylindrical);
  EXPECT_EQ(plan.grids[0].vertical[0], Vec3(1, 0, 0));
  ASSERT_EQ(plan.grids[0].luminance_from.size(), 1U);
  EXPECT_LT((plan.grids[0].luminance_from[0] - Vec3(0.1, 0.2, 1.5)).norm(), 1e-15);
  EXPECT_EQ(plan.grids[0].required.glare, 19);
  EXPECT_EQ(plan.grids[1].sides[1], Vec3(0, 0.25, 0));
  ASSERT_EQ(plan.grids[2].points.size(), 2U);
  EXPECT_LT((plan.grids[2].points[0] - Vec3(0.1, 0.2, 0.3)).norm(), 1e-15);
  EXPECT_LT((plan.grids[2].normals[1] - Vec3(0.6, 0, 0.8)).norm(), 1e-15);
  EXPECT_EQ(plan.grids[3].normals[0], Vec3(0, 1, 0));
  ASSERT_EQ(plan.observers.size(), 1U);
  EXPECT_EQ(plan.observers[0].direction, Vec3(1, 0, 0));
  EXPECT_EQ(plan.observers[0].limit, 22);
  // The table is one of the scene's files, which outputs must not replace.
  EXPECT_TRUE(std::any_of(read_scene.files.begin(), read_scene.files.end(),
                          [](const auto& path) { return path.filename() == "eyes.csv"; }));

  // What is written reads the same.
  io::write_scene(folder() / "copy.json", read_scene);
  const auto copy = io::read_scene(folder() / "copy.json");
  EXPECT_EQ(io::light_plan_json(copy.light_plan), io::light_plan_json(plan));
  EXPECT_EQ(copy.materials[0].maintenance_factor, 0.9);
}

TEST_F(LightPlans, AreRefusedInOneLine) {
  const auto expect = [&](const std::string& text, const std::string& words) {
    EXPECT_CONTAINS(error_of("room.json", scene(text)), words);
  };
  expect(R"("grids": {})", "grids");
  expect(R"("grids": [{"surface": "floor"}])", "has no \"name\"");
  expect(R"("grids": [{"name": "a", "surface": "floor", "points": [[0, 0, 0]]}])",
         "expected one of");
  expect(R"("grids": [{"name": "a", "points": [[0, 0, 0]], "spacing": 1}])",
         "grids[0].spacing: does not go with \"points\"");
  expect(R"("grids": [{"name": "a", "points": [[0, 0, 0]], "normals": [[0, 0, 1], [1, 0, 0]]}])",
         "has 2 directions for 1 points");
  expect(R"("grids": [{"name": "a", "points": [[0, 0, 0]], "normals": [[0, 0, 0]]}])", "normals");
  expect(R"("grids": [{"name": "a", "corner": [0, 0, 0], "sides": [[1, 0, 0]]}])",
         "expected the two sides");
  expect(R"("grids": [{"name": "a", "surface": "floor", "border": -1}])", "border: is negative");
  expect(R"("grids": [{"name": "a", "surface": "floor", "vertical": []}])", "has no direction");
  expect(R"("grids": [{"name": "a", "surface": "floor", "luminance_from": []}])", "has no point");
  expect(R"("grids": [{"name": "a", "surface": "floor", "luminance_from": [[0, 0]]}])", "three");
  expect(R"("grids": [{"name": "a", "surface": "floor", "spacings": 1}])", "spacing");
  expect(R"("observers": [{"name": "a", "position": [0, 0, 0], "look_at": [0, 0, 0]}])",
         "is the observer's position");
  expect(R"("maintenance_factor": 1.1)", "more than 0 and at most 1");
}

}  // namespace
