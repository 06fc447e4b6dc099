/// Cells of patches: what is done to an edge or a corner is done to all that have it.

#include "meshing/patches/patch_cells.h"

#include <gtest/gtest.h>

#include <array>

namespace {

using meshing::Cell;
using meshing::Loop;
using meshing::PatchCells;
using radiosity::PatchMesh;
using radiosity::Vec3;

/// Four unit squares of one polygon about the vertex 4, which are numbered along x first, as are
/// the vertices.
PatchMesh four_squares() {
  PatchMesh mesh;
  mesh.surface_names = {"floor"};
  mesh.surface_two_sided = {false};
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 3; ++x) mesh.vertices.emplace_back(x, y, 0);
  }
  for (const std::int32_t first : {0, 1, 3, 4}) {
    mesh.add_patch({first, first + 1, first + 4, first + 3}, 0, 0);
  }
  return mesh;
}

constexpr radiosity::Index kNoneFixed = 0;
constexpr std::array<std::int32_t, 4> kAll{0, 1, 2, 3};

TEST(PatchCells, AnEdgeIsSplitOnBothSides) {
  const PatchMesh mesh = four_squares();
  PatchCells cells(mesh, kNoneFixed, kAll);
  cells.split_edge(4, 1, {1, 0.5, 0});
  EXPECT_EQ(cells[0].loop, (Loop{0, 1, 9, 4, 3}));
  EXPECT_EQ(cells[1].loop, (Loop{1, 2, 5, 4, 9}));
  EXPECT_EQ(cells[2].loop, (Loop{3, 4, 7, 6}));
  EXPECT_EQ(cells.shortest_edge(4), 0.5);
  EXPECT_FALSE(cells.move(9, {1, 0.4, 0})) << "what is put on an edge stays";
  // Its halves are edges like others.
  cells.split_edge(1, 9, {1, 0.2, 0});
  EXPECT_EQ(cells[1].loop, (Loop{1, 2, 5, 4, 9, 10}));
}

TEST(PatchCells, ACellIsCutIntoTwoOfOnePatch) {
  const PatchMesh mesh = four_squares();
  PatchCells cells(mesh, kNoneFixed, kAll);
  cells.split_cell(0, 1, 3);
  ASSERT_EQ(cells.size(), 5U);
  EXPECT_EQ(cells.of_patch(0), (std::vector<std::int32_t>{0, 4}));
  EXPECT_EQ(cells[0].loop, (Loop{0, 1, 3}));
  EXPECT_EQ(cells[4].loop, (Loop{1, 4, 3}));
  EXPECT_EQ(cells[4].patch, 0);
  // The new edge belongs to both.
  cells.split_edge(1, 3, {0.5, 0.5, 0});
  EXPECT_EQ(cells[0].loop.size(), 4U);
  EXPECT_EQ(cells[4].loop.size(), 4U);
}

TEST(PatchCells, CornersMoveWithinThePolygonAndAlongItsOutline) {
  const PatchMesh mesh = four_squares();
  PatchCells cells(mesh, kNoneFixed, kAll);
  EXPECT_FALSE(cells.move(1, {1.2, 0.2, 0})) << "off the outline";
  EXPECT_TRUE(cells.move(1, {1.2, 0, 0}));
  EXPECT_TRUE(cells.move(4, {1.1, 0.9, 0}));
  EXPECT_EQ(cells.at(4), Vec3(1.1, 0.9, 0));
  EXPECT_FALSE(cells.move(4, {1, 1, 0})) << "once moved it stays";
}

TEST(PatchCells, NoMoveSpoilsAPatch) {
  const PatchMesh mesh = four_squares();
  PatchCells cells(mesh, kNoneFixed, kAll);
  EXPECT_FALSE(cells.move(4, {0.2, 0.2, 0}));
  EXPECT_EQ(cells.at(4), Vec3(1, 1, 0));
}

TEST(PatchCells, FixedVerticesStay) {
  const PatchMesh mesh = four_squares();
  PatchCells cells(mesh, 5, kAll);
  EXPECT_FALSE(cells.move(4, {1.1, 0.9, 0}));
  EXPECT_TRUE(cells.move(5, {2, 1.1, 0}));
  cells.lock(7);
  EXPECT_FALSE(cells.move(7, {1.1, 2, 0}));
}

}  // namespace
