#include "radiosity/picture/lightmap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <tuple>
#include <vector>

#include "radiosity/base/error.h"
#include "radiosity/picture/patch_interpolation.h"
#include "radiosity/scene/corner_values.h"
#include "tests/support/shapes.h"

namespace radiosity {
namespace {

/// A square as two polygons of four triangles each, an oblique quad and, on its own, a sliver.
PatchMesh oblique_mesh() {
  PatchMesh mesh;
  mesh.surface_names = {"square", "quad", "sliver"};
  mesh.surface_two_sided = {false, false, false};
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0},    {1, 1, 0}, {2, 1, 0},
                   {0, 2, 0}, {1, 2, 0}, {2, 2, 0}, {3, 0, 0},    {4, 1, 1}, {4, 3, 1},
                   {3, 2, 0}, {0, 0, 3}, {2, 0, 3}, {2, 0.001, 3}};
  const auto halves = [&](int a, int b, int c, int d, int polygon) {
    mesh.add_patch({a, b, c, -1}, 0, polygon);
    mesh.add_patch({a, c, d, -1}, 0, polygon);
  };
  // The diagonal from (0, 0) to (2, 2) lies between polygons 0 and 1.
  mesh.add_patch({0, 1, 4, -1}, 0, 0);
  halves(1, 2, 5, 4, 0);
  mesh.add_patch({4, 5, 8, -1}, 0, 0);
  mesh.add_patch({0, 4, 3, -1}, 0, 1);
  halves(3, 4, 7, 6, 1);
  mesh.add_patch({4, 8, 7, -1}, 0, 1);
  mesh.add_patch({9, 10, 11, 12}, 1, 2);
  mesh.add_patch({13, 14, 15, -1}, 2, 3);
  return mesh;
}

/// The inside of a box.
PatchMesh room(const Vec3& size) {
  PatchMesh mesh;
  test::add_box(mesh, Vec3::Zero(), size, 2, test::Facing::inwards);
  // Each wall is a polygon.
  for (Index i = 0; i < mesh.size(); ++i) mesh.polygon[i] = static_cast<std::int32_t>(i / 4);
  return mesh;
}

/// A radiosity that changes evenly in space.
struct EvenField {
  Vec3 slope = Vec3(0.2, -0.3, 0.1);
  [[nodiscard]] double at(const Vec3& point) const { return 5 + slope.dot(point); }
  [[nodiscard]] Eigen::MatrixXd of(const PatchMesh& mesh) const {
    Eigen::MatrixXd values(mesh.size(), 1);
    for (Index i = 0; i < mesh.size(); ++i) values(i, 0) = at(mesh.centroid[i]);
    return values;
  }
};

/// The value between four texels, as a renderer shows it.
double between_texels(const Image& image, const Eigen::Vector2d& at) {
  const int x = static_cast<int>(std::floor(at.x() - 0.5));
  const int y = static_cast<int>(std::floor(at.y() - 0.5));
  const double s = at.x() - 0.5 - x;
  const double t = at.y() - 0.5 - y;
  double sum = 0;
  for (const auto& [dx, dy, weight] : {std::tuple(0, 0, (1 - s) * (1 - t)),
                                       {1, 0, s * (1 - t)},
                                       {0, 1, (1 - s) * t},
                                       {1, 1, s * t}}) {
    // At the border of a picture of which no more is asked.
    if (weight < 1e-9) continue;
    const Index pixel = Index{y + dy} * image.width + (x + dx);
    EXPECT_EQ(image.alpha[static_cast<std::size_t>(pixel)], 1) << at.transpose();
    sum += weight * image.values(pixel, 0);
  }
  return sum;
}

Vec3 random_point(const PatchMesh& mesh, Index patch, std::mt19937& random) {
  std::uniform_real_distribution<double> share(0, 1);
  const double s = std::sqrt(share(random));
  const double t = share(random);
  return (1 - s) * mesh.corner(patch, 0) + s * (1 - t) * mesh.corner(patch, 1) +
         s * t * mesh.corner(patch, 2);
}

TEST(LightAtlas, ChartsLieApartAndHoldTheirPatches) {
  for (const int size : {24, 100, 333}) {
    const PatchMesh mesh = oblique_mesh();
    const LightAtlas atlas = make_light_atlas(mesh, size);
    ASSERT_EQ(atlas.charts.size(), 4U);
    EXPECT_LE(atlas.width, size);
    EXPECT_LE(atlas.height, size);
    std::vector<int> owner(static_cast<std::size_t>(atlas.width) * atlas.height, -1);
    for (int k = 0; k < std::ssize(atlas.charts); ++k) {
      const AtlasChart& chart = atlas.charts[static_cast<std::size_t>(k)];
      for (int y = chart.y; y < chart.y + chart.height; ++y) {
        for (int x = chart.x; x < chart.x + chart.width; ++x) {
          ASSERT_TRUE(x < atlas.width && y < atlas.height);
          int& of_texel = owner[static_cast<std::size_t>(y) * atlas.width + x];
          EXPECT_EQ(of_texel, -1) << "charts " << k << " and " << of_texel;
          of_texel = k;
        }
      }
      for (const std::int32_t patch : chart.patches) {
        EXPECT_EQ(atlas.chart[patch], k);
        for (int c = 0; c < mesh.n_corners(patch); ++c) {
          // A texel of gutter, then half a texel to the middle of the outermost.
          const Eigen::Vector2d at = atlas.coordinates(chart, mesh.corner(patch, c));
          EXPECT_GE(at.x(), chart.x + 1.5 - 1e-9);
          EXPECT_LE(at.x(), chart.x + chart.width - 1.5 + 1e-9);
          EXPECT_GE(at.y(), chart.y + 1.5 - 1e-9);
          EXPECT_LE(at.y(), chart.y + chart.height - 1.5 + 1e-9);
        }
      }
    }
  }
}

TEST(LightAtlas, UsesMostOfItsRoomAndNoMore) {
  const PatchMesh mesh = room(Vec3(4, 5, 3));
  const LightAtlas atlas = make_light_atlas(mesh, 256);
  double used = 0;
  for (const AtlasChart& chart : atlas.charts) used += double(chart.width) * chart.height;
  // Rows of equal rectangles of three shapes: at worst each row is half empty.
  EXPECT_GT(used, 0.5 * atlas.width * atlas.height);
  EXPECT_NEAR(atlas.texel, make_light_atlas(mesh, 1024).texel * 4, 0.1 * atlas.texel);
  EXPECT_THROW(make_light_atlas(oblique_mesh(), 7), MeshError);
}

TEST(Lightmap, TexelsInPolygonsHaveTheLightThere) {
  const PatchMesh mesh = oblique_mesh();
  const EvenField field;
  const LightAtlas atlas = make_light_atlas(mesh, 100);
  const Eigen::MatrixXd corners = corner_values(mesh, field.of(mesh));
  const Image image = make_lightmap(mesh, atlas, field.of(mesh));
  std::mt19937 random(7);
  // Between texels it is off by what one of them has moved to the polygon's border, and patches'
  // own steepest slope; single precision is 1e-7.
  double slope = 0;
  for (Index i = 0; i < mesh.size(); ++i) {
    for (int k = 0; k < mesh.n_corners(i); ++k) {
      const int next = (k + 1) % mesh.n_corners(i);
      slope = std::max(slope, std::abs(corners(4 * i + k, 0) - corners(4 * i + next, 0)) /
                                  (mesh.corner(i, k) - mesh.corner(i, next)).norm());
    }
  }
  const double tolerance = 2 * std::sqrt(2.) * atlas.texel * 2 * slope / kPi + 1e-6;
  ASSERT_LT(tolerance, 0.1);
  for (Index i = 0; i < mesh.size(); ++i) {
    for (int k = 0; k < 200; ++k) {
      const Vec3 point = random_point(mesh, i, random);
      const AtlasChart& chart = atlas.charts[atlas.chart[i]];
      const double shown = between_texels(image, atlas.coordinates(chart, point));
      EXPECT_NEAR(shown, interpolate(mesh, corners, i, point)[0] / kPi, tolerance) << "patch " << i;
    }
  }
}

TEST(Lightmap, NeighboursMeetWithoutASeam) {
  const PatchMesh mesh = oblique_mesh();
  const EvenField field;
  for (const int size : {50, 200}) {
    const LightAtlas atlas = make_light_atlas(mesh, size);
    const Image image = make_lightmap(mesh, atlas, field.of(mesh));
    // Each side is off by what texels have moved, up to the diagonal of one.
    const double tolerance = 2 * std::sqrt(2.) * atlas.texel * field.slope.norm() / kPi + 1e-6;
    for (int k = 0; k <= 100; ++k) {
      const Vec3 point(0.02 * k, 0.02 * k, 0);
      const double a = between_texels(image, atlas.coordinates(atlas.charts[0], point));
      const double b = between_texels(image, atlas.coordinates(atlas.charts[1], point));
      EXPECT_NEAR(a, b, tolerance);
    }
  }
}

TEST(Lightmap, AnEvenLightIsEvenInEveryTexel) {
  const PatchMesh mesh = oblique_mesh();
  const Image image =
      make_lightmap(mesh, make_light_atlas(mesh, 64), Eigen::MatrixXd::Constant(mesh.size(), 2, 3));
  for (Index k = 0; k < image.values.rows(); ++k) {
    const float expected = image.alpha[static_cast<std::size_t>(k)] == 1 ? float(3 / kPi) : 0.F;
    EXPECT_EQ(image.values(k, 0), expected);
    EXPECT_EQ(image.values(k, 1), expected);
  }
}

TEST(Lightmap, GatheredInAFurnaceIsEven) {
  const PatchMesh mesh = room(Vec3(2, 3, 4));
  const Eigen::MatrixXd radiosity = Eigen::MatrixXd::Constant(mesh.size(), 1, 2);
  const Eigen::MatrixXd half = Eigen::MatrixXd::Constant(mesh.size(), 1, 0.5);
  const FinalGather gather(mesh, radiosity);
  const LightAtlas atlas = make_light_atlas(mesh, 40);
  const Image image = make_gathered_lightmap(mesh, atlas, gather, {2 * half, half});
  // B = M + rho H with H = B, but for single precision, and for texels at an edge, which are a
  // millionth of the room away from it.
  for (Index k = 0; k < image.values.rows(); ++k) {
    if (image.alpha[static_cast<std::size_t>(k)] == 0) continue;
    EXPECT_NEAR(image.values(k, 0), 2 / kPi, 1e-5);
  }
}

}  // namespace
}  // namespace radiosity
