#include "io/result/color_glb.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "io/scene/scene_file.h"
#include "meshing/patches/patches.h"
#include "tests/support/glb.h"
#include "tests/support/output_folder.h"
#include "tests/support/shapes.h"

namespace {

using radiosity::test::Glb;
using radiosity::test::read_glb;
using radiosity::test::sample_patches;
using Json = nlohmann::json;
using radiosity::Index;
using radiosity::PatchMesh;
using radiosity::Vec3;

class ColorGlb : public OutputFolder {};

io::CornerColors colors_of(const PatchMesh& mesh) {
  io::CornerColors colors(4 * mesh.size(), {255, 128, 0});
  for (int k = 0; k < 4; ++k) colors[8 + k] = {10, 200, 255};
  return colors;
}

TEST_F(ColorGlb, ShowsTheColoursUnlit) {
  const PatchMesh mesh = sample_patches();
  io::write_color_glb(folder() / "a.glb", mesh, colors_of(mesh));
  const Glb glb = read_glb(folder() / "a.glb");
  EXPECT_TRUE(glb.description["materials"][0]["extensions"].contains("KHR_materials_unlit"));
  EXPECT_EQ(glb.description["extensionsUsed"], Json({"KHR_materials_unlit"}));
  EXPECT_EQ(glb.description["buffers"][0]["byteLength"], glb.binary.size());
  // Two corners of the floor are shared; the wall has others, for its colour.
  ASSERT_EQ(glb.description["accessors"][0]["count"], 8 + 1);
  EXPECT_EQ(glb.description["accessors"][0]["max"], Json({2.0, 1.0, 1.0}));
  ASSERT_EQ(glb.description["accessors"][1]["normalized"], true);
  const double half = std::pow((128 / 255.0 + 0.055) / 1.055, 2.4);
  EXPECT_EQ(glb.value<std::uint16_t>(1, 0), 65535);
  EXPECT_NEAR(glb.value<std::uint16_t>(1, 2) / 65535.0, half, 1e-5);
  EXPECT_EQ(glb.value<std::uint16_t>(1, 4), 0);
  ASSERT_EQ(glb.description["meshes"].size(), 2U);
  EXPECT_EQ(glb.description["nodes"][1]["name"], "wall");
}

TEST_F(ColorGlb, IsReadAgainWithTheSameSurfaces) {
  const PatchMesh mesh = sample_patches();
  io::write_color_glb(folder() / "a.glb", mesh, colors_of(mesh));
  const radiosity::Scene scene = io::read_scene(folder() / "a.glb");
  EXPECT_EQ(scene.n_polygons(), 5);
  const PatchMesh again = meshing::make_patches(scene);
  EXPECT_DOUBLE_EQ(again.area[0] + again.area[1], 1);
  EXPECT_EQ(again.normal[4], mesh.normal[2]);
  ASSERT_EQ(scene.surfaces.size(), 2U);
}

TEST_F(ColorGlb, StandsUprightWhateverAxisIsUp) {
  const PatchMesh mesh = sample_patches();
  io::write_color_glb(folder() / "a.glb", mesh, colors_of(mesh), io::UpAxis::z);
  const PatchMesh turned = meshing::make_patches(io::read_scene(folder() / "a.glb"));
  // The floor's normal, z there, is y here.
  EXPECT_NEAR((turned.normal[0] - Vec3::UnitY()).norm(), 0, 1e-7);
}

}  // namespace
