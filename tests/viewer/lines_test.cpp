// Lines over the surfaces: isolines and outlines.
#include <gtest/gtest.h>

#include <memory>
#include <numeric>
#include <optional>

#include "radiosity/visibility/visibility.h"
#include "tests/support/shapes.h"
#include "viewer/desk/isolines.h"
#include "viewer/desk/outlines.h"
#include "viewer/desk/patch_points.h"
#include "viewer/desk/ray_picture.h"

namespace {

using radiosity::Index;
using radiosity::PatchMesh;
using radiosity::Vec3;
using viewer::SurfaceLine;
using namespace radiosity::test;

double length_of(const std::vector<SurfaceLine>& lines) {
  double sum = 0;
  for (const SurfaceLine& line : lines) sum += (line.ends[1] - line.ends[0]).norm();
  return sum;
}

/// A square of 2 m that faces up the z axis, and a field that grows along x from 0.1 to 0.9.
struct Slope {
  explicit Slope(int n) {
    auto grid = std::make_shared<PatchMesh>();
    add_grid(*grid, Vec3(-1, -1, 0), 2 * Vec3::UnitX(), 2 * Vec3::UnitY(), n, n);
    mesh = grid;
    points.emplace(mesh);
    for (const Vec3& point : points->positions()) values.push_back(value(point));
  }
  static float value(const Vec3& point) { return static_cast<float>(0.5 + 0.4 * point.x()); }
  [[nodiscard]] viewer::BlendedTriangles field() const {
    return {points->positions(), points->triangles(), points->surfaces(), values};
  }

  std::shared_ptr<const PatchMesh> mesh;
  std::optional<viewer::PatchPoints> points;
  std::vector<float> values;
};

constexpr viewer::IsoLevel kLevel = {.value = 300, .position = 0.62};  // at x = 0.3
constexpr double kFloat = 1e-6;  // of positions on the colour map

TEST(Isolines, RunWhereTheValueIs) {
  for (const int n : {3, 8}) {
    const Slope slope(n);
    const viewer::Isolines isolines =
        make_isolines(slope.field(), std::vector{kLevel}, io::ColorMap::viridis, {}, 0.5);
    EXPECT_NEAR(length_of(isolines.lines), 2, kFloat);
    for (const SurfaceLine& line : isolines.lines) {
      for (const Vec3& end : line.ends) EXPECT_NEAR(end.x(), 0.3, 10 * kFloat);
      EXPECT_LE((line.normals[0] - Vec3::UnitZ()).norm(), 1e-12);
    }
    ASSERT_GE(isolines.numbers.size(), 2U);
    for (std::size_t k = 0; k < isolines.numbers.size(); ++k) {
      EXPECT_EQ(isolines.numbers[k].value, 300);
      EXPECT_NEAR(isolines.numbers[k].place.x(), 0.3, 10 * kFloat);
      for (std::size_t j = 0; j < k; ++j) {
        EXPECT_GE((isolines.numbers[k].place - isolines.numbers[j].place).norm(), 0.5);
      }
    }
  }
}

TEST(Isolines, LeaveOutWhatIsNotKnown) {
  Slope slope(4);
  std::fill(slope.values.begin(), slope.values.end(), -1.F);
  EXPECT_TRUE(
      make_isolines(slope.field(), std::vector{kLevel}, io::ColorMap::grey, {}, 1).lines.empty());
}

TEST(Isolines, AreOfTheTicksWithinTheScale) {
  viewer::Legend legend;
  legend.scale = {.low = 0, .high = 10};
  legend.ticks = {0, 2, 5, 10};
  const auto levels = viewer::iso_levels(legend);
  ASSERT_EQ(levels.size(), 2U);
  EXPECT_EQ(levels[0].value, 2);
  EXPECT_DOUBLE_EQ(levels[1].position, 0.5);
}

TEST(Isolines, AreSeenOnEveryMap) {
  for (const io::ColorMap map : io::color_maps()) {
    for (const double position : {0.05, 0.3, 0.5, 0.7, 0.95}) {
      const io::Rgb line = viewer::isoline_color(position, map);
      const io::Rgb under = io::map_color(position, map);
      EXPECT_GT(std::abs(line[1] - under[1]), 50) << io::color_map_name(map) << position;
    }
  }
}

// The edges of a box, once each, whatever its patches are.
TEST(Outlines, OfABoxAreItsEdges) {
  for (const Facing facing : {Facing::inwards, Facing::outwards}) {
    for (const int n : {1, 3, 4}) {
      PatchMesh mesh;
      add_box(mesh, Vec3(0, 0, 0), Vec3(1, 2, 3), n, facing);
      const auto lines = viewer::make_outlines(mesh);
      EXPECT_NEAR(length_of(lines), 4 * (1 + 2 + 3), 1e-9) << n;
      for (const SurfaceLine& line : lines) EXPECT_TRUE(line.is_sharp);
    }
  }
}

TEST(Outlines, LeaveOutEdgesWithinASurface) {
  PatchMesh mesh;  // one large patch beside two small ones: a T
  mesh.surface_names = {"floor"};
  mesh.vertices = {{0, 0, 0}, {1, 0, 0},   {1, 0.5, 0},   {1, 1, 0},
                   {0, 1, 0}, {1.5, 0, 0}, {1.5, 0.5, 0}, {1.5, 1, 0}};
  mesh.add_patch({0, 1, 3, 4}, 0, 0);
  mesh.add_patch({1, 5, 6, 2}, 0, 0);
  mesh.add_patch({2, 6, 7, 3}, 0, 0);
  EXPECT_NEAR(length_of(viewer::make_outlines(mesh)), 2 * (1 + 1.5), 1e-12);
}

/// A round wall of 24 facets, 1 m in radius and height.
PatchMesh round_wall() {
  constexpr int kFacets = 24;
  PatchMesh mesh;
  mesh.surface_names = {"wall"};
  for (int k = 0; k < kFacets; ++k) {
    const double angle = 2 * radiosity::kPi * k / kFacets;
    mesh.vertices.emplace_back(std::cos(angle), std::sin(angle), 0);
    mesh.vertices.emplace_back(std::cos(angle), std::sin(angle), 1);
  }
  for (int k = 0; k < kFacets; ++k) {
    const int next = (k + 1) % kFacets;
    mesh.add_patch({2 * k, 2 * next, 2 * next + 1, 2 * k + 1}, 0, k);
  }
  return mesh;
}

TEST(Outlines, OfCurvedSurfacesAreWhereTheyTurnAway) {
  const auto lines = viewer::make_outlines(round_wall());
  double seen = 0;
  for (const SurfaceLine& line : lines) {
    if (!line.is_sharp && is_drawn(line, Vec3(5, 0.3, 0.5), viewer::Backs::hidden)) {
      seen += (line.ends[1] - line.ends[0]).norm();
    }
  }
  EXPECT_NEAR(seen, 2, 1e-12);  // left and right, as high as the wall
}

TEST(SurfaceLine, IsDrawnIfASurfaceFacesTheCamera) {
  SurfaceLine line{.ends = {Vec3(0, 0, 0), Vec3(1, 0, 0)},
                   .normals = {Vec3::UnitZ(), Vec3::UnitY()}};
  EXPECT_TRUE(is_drawn(line, Vec3(0, -1, 1), viewer::Backs::hidden));
  EXPECT_FALSE(is_drawn(line, Vec3(0, -1, -1), viewer::Backs::hidden));
  EXPECT_TRUE(is_drawn(line, Vec3(0, -1, -1), viewer::Backs::shown));
  line.is_sharp = false;
  EXPECT_TRUE(is_drawn(line, Vec3(0, -1, 1), viewer::Backs::hidden));
  EXPECT_FALSE(is_drawn(line, Vec3(0, 1, 1), viewer::Backs::hidden));
}

// As far as a sloping surface recedes within a pixel, and no further.
TEST(SurfaceLine, IsRaisedByWhatItsSurfacesRecede) {
  const SurfaceLine line{.ends = {Vec3(0, 0, 0), Vec3(1e-9, 0, 0)},
                         .normals = {Vec3::UnitZ(), Vec3::UnitZ()}};
  const auto raised = [&](const Vec3& position) {
    return (raised_ends(line, position, 0.001)[0] - line.ends[0]).norm();
  };
  EXPECT_EQ(raised(Vec3(0, 0, 2)), 0);
  EXPECT_NEAR(raised(Vec3(2, 0, 2)), 0.001 * Vec3(2, 0, 2).norm(), 1e-12);
  EXPECT_NEAR(raised(Vec3(2, 0, 1e-4)), 0.02, 1e-9);  // a hundredth of the distance at most
  EXPECT_EQ(raised(Vec3(2, 0, -1)), 0);
}

/// What a camera 1.25 m above the middle of the slope sees, which fills the picture but for its
/// border; 50 x 50 pixels.
class SlopePictures : public ::testing::Test {
 protected:
  SlopePictures() {
    for (Index i = 0; i < slope_.mesh->size(); ++i) {
      for (int k = 0; k < 4; ++k) {
        corners_.positions.push_back(Slope::value(slope_.mesh->corner(i, k)));
      }
    }
    camera_.position = Vec3(0, 0, 1.25);
    camera_.direction = -Vec3::UnitZ();
    camera_.vertical_fov = radiosity::kPi / 2;
  }
  /// The middle row.
  [[nodiscard]] std::vector<io::Rgb> row(bool has_outlines) const {
    const io::RgbPicture picture =
        viewer::ray_picture(*slope_.mesh, visibility_, corners_, camera_,
                            {.width = kSize, .height = kSize, .has_outlines = has_outlines});
    std::vector<io::Rgb> result;
    for (int x = 0; x < kSize; ++x) {
      const std::uint8_t* first = picture.bytes.data() + 3 * (kSize / 2 * kSize + x);
      result.push_back({first[0], first[1], first[2]});
    }
    return result;
  }

  static constexpr int kSize = 50;
  Slope slope_{7};
  radiosity::Visibility visibility_{*slope_.mesh};
  viewer::CornerColors corners_;
  radiosity::Camera camera_;
};

TEST_F(SlopePictures, HaveIsolinesOfAWidth) {
  const auto without = row(false);
  corners_.levels = {kLevel};
  const auto with = row(false);
  const int place = static_cast<int>(kSize * 0.5 * (1 + 0.3 / 1.25));
  int n_changed = 0;
  for (int x = 0; x < kSize; ++x) {
    if (with[x] == without[x]) continue;
    ++n_changed;
    EXPECT_EQ(with[x], viewer::isoline_color(kLevel.position, io::ColorMap::viridis));
    EXPECT_NEAR(x + 0.5, place, 1.5);
  }
  EXPECT_GE(n_changed, 1);
  EXPECT_LE(n_changed, 2);
}

TEST_F(SlopePictures, HaveOutlinesAtBordersOnly) {
  const auto without = row(false);
  const auto with = row(true);
  int n_changed = 0;
  for (int x = 0; x < kSize; ++x) n_changed += with[x] == without[x] ? 0 : 1;
  EXPECT_EQ(n_changed, 2);
  EXPECT_NE(with[4], without[4]);  // its left border is at x = 5
}

}  // namespace
