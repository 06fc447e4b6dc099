// What tells where one is: outlines of what is not drawn, and the axes.
#include "viewer/desk/back_outlines.h"

#include <gtest/gtest.h>

#include <cmath>

#include "io/scene/scene_file.h"
#include "meshing/patches/patches.h"
#include "viewer/desk/axes.h"

namespace {

using radiosity::PatchMesh;
using radiosity::Vec3;
using viewer::OutlinePiece;

PatchMesh mesh_named(const std::string& name, radiosity::Index n_patches) {
  return meshing::make_patches(io::read_scene(std::string(RADIOSITY_SCENES) + "/" + name + ".json"),
                               {.n_patches = n_patches});
}

double length(const std::vector<OutlinePiece>& pieces) {
  double sum = 0;
  for (const OutlinePiece& piece : pieces) sum += (piece.to - piece.from).norm();
  return sum;
}

std::vector<OutlinePiece> pieces_of(const PatchMesh& mesh, const Vec3& eye) {
  return viewer::BackOutlines(mesh).of_hidden_backs(eye, radiosity::Visibility(mesh));
}

// Two squares that face each other: from outside one has its back to the eye, from between none.
TEST(BackOutlines, AreOfWhatIsSeenFromTheBack) {
  const PatchMesh mesh = mesh_named("opposed-squares", 64);
  const radiosity::Box3 box = radiosity::bounds(mesh);
  const Vec3 middle = box.center();
  Eigen::Index axis = 0;
  mesh.normal[0].cwiseAbs().maxCoeff(&axis);
  Vec3 above = middle;
  above[axis] = box.max()[axis] + 1;
  above += 0.3 * mesh.normal[0].unitOrthogonal();
  const auto pieces = pieces_of(mesh, above);
  // All four edges, whatever the patches, for nothing is before them.
  EXPECT_NEAR(length(pieces), 4, 1e-9);
  for (const OutlinePiece& piece : pieces) {
    EXPECT_NEAR(piece.from[axis], box.max()[axis], 1e-12);
    EXPECT_NEAR(piece.to[axis], box.max()[axis], 1e-12);
  }
  EXPECT_TRUE(pieces_of(mesh, middle).empty());
}

// A closed room from outside: edges between walls that face away show, those that end at a wall
// that is drawn do not; from inside there is nothing to tell.
TEST(BackOutlines, OfARoomAreBetweenTheWallsThatOneLooksThrough) {
  const PatchMesh mesh = mesh_named("furnace-cube", 54);
  const radiosity::Box3 box = radiosity::bounds(mesh);
  const Vec3 outside = box.center() + 3 * box.sizes();
  // From a corner three walls face away, with three edges between them.
  EXPECT_NEAR(length(pieces_of(mesh, outside)), 3, 1e-6);
  EXPECT_TRUE(pieces_of(mesh, box.center()).empty());
}

// What a front hides is left out, and no more than that.
TEST(BackOutlines, AreCutWhereSomethingHidesThem) {
  PatchMesh mesh;
  mesh.surface_names = {"back", "screen"};
  mesh.surface_two_sided = {false, false};
  // A square at z = 0 that faces down, and a screen before its right half that faces up.
  mesh.vertices = {{0, 0, 0},     {0, 1, 0},   {1, 1, 0},  {1, 0, 0},
                   {0.5, -1, 10}, {2, -1, 10}, {2, 2, 10}, {0.5, 2, 10}};
  mesh.add_patch({0, 1, 2, 3}, 0, 0);
  mesh.add_patch({4, 5, 6, 7}, 1, 1);
  const auto pieces = pieces_of(mesh, Vec3(0.5, 0.5, 1000));
  // Of the four edges the left one and half of two.
  EXPECT_NEAR(length(pieces), 2, 0.02);
  for (const OutlinePiece& piece : pieces) EXPECT_LE(std::max(piece.from.x(), piece.to.x()), 0.51);
}

TEST(Axes, AreAsTheCameraSeesThem) {
  radiosity::Camera camera;  // along -z, y up
  const auto axes = viewer::shown_axes(camera);
  EXPECT_EQ(axes[2].name, 'z');  // drawn last, for it comes towards the eye
  EXPECT_NEAR(axes[2].nearness, 1, 1e-15);
  EXPECT_NEAR(axes[2].right, 0, 1e-15);
  for (const viewer::ShownAxis& axis : axes) {
    EXPECT_NEAR(std::hypot(axis.right, axis.up, axis.nearness), 1, 1e-12);
    if (axis.name == 'x') {
      EXPECT_NEAR(axis.right, 1, 1e-15);
    }
    if (axis.name == 'y') {
      EXPECT_NEAR(axis.up, 1, 1e-15);
    }
  }
}

}  // namespace
