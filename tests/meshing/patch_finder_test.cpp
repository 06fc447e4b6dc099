/// Patches near points and lines, out of those of a polygon.

#include "meshing/patches/patch_finder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "radiosity/scene/patch_mesh.h"
#include "tests/support/shapes.h"

namespace {

using meshing::PatchFinder;
using meshing::Segment;
using radiosity::Index;
using radiosity::PatchMesh;
using radiosity::Vec3;

constexpr int kCells = 20;
constexpr double kTolerance = 1e-9;

PatchMesh grid() {
  PatchMesh mesh;
  radiosity::test::add_grid(mesh, Vec3::Zero(), Vec3(1, 0, 0), Vec3(0, 1, 0), kCells, kCells);
  return mesh;
}

TEST(PatchFinder, FindsAllThatASlantedLineMeetsAndFewOthers) {
  const PatchMesh mesh = grid();
  const Segment diagonal = {Vec3(0, 0, 0), Vec3(1, 1, 0)};
  const std::vector<std::vector<Segment>> lines = {{diagonal}};
  const PatchFinder finder(mesh, lines, kTolerance);
  const std::vector<std::int32_t> found = finder.near(diagonal, mesh.polygon[0]);
  EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
  // Corners may move by 0.3 of an edge, for which boxes have as much of a diagonal: patches may be
  // a row away.
  EXPECT_LE(found.size(), 3 * kCells);
  constexpr int kPoints = 1000;
  for (int k = 0; k <= kPoints; ++k) {
    const double t = static_cast<double>(k) / kPoints;
    for (Index i = 0; i < mesh.size(); ++i) {
      const Vec3 point(t, t, 0);
      if (!patch_box(mesh, i).contains(point)) continue;
      EXPECT_TRUE(std::binary_search(found.begin(), found.end(), static_cast<std::int32_t>(i)));
      const std::vector<std::int32_t> near = finder.near(point, mesh.polygon[0]);
      EXPECT_TRUE(std::binary_search(near.begin(), near.end(), static_cast<std::int32_t>(i)));
    }
  }
  EXPECT_TRUE(finder.near(diagonal, mesh.polygon[0] + 1).empty());
}

TEST(PatchFinder, FindsWhatALineAlongAnEdgeTouches) {
  const PatchMesh mesh = grid();
  const Segment line = {Vec3(0.5, 0, 0), Vec3(0.5, 1, 0)};
  const std::vector<std::vector<Segment>> lines = {{line}};
  const PatchFinder finder(mesh, lines, kTolerance);
  // On both sides.
  EXPECT_EQ(finder.near(line, mesh.polygon[0]).size(), 2U * kCells);
}

}  // namespace
