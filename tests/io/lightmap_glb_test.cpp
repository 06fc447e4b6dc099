#include "io/result/lightmap_glb.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/scene/scene_file.h"
#include "meshing/patches/patches.h"
#include "radiosity/picture/lightmap.h"
#include "tests/support/glb.h"
#include "tests/support/output_folder.h"

namespace {

using radiosity::AtlasChart;
using radiosity::Image;
using radiosity::LightAtlas;
using radiosity::PatchMesh;
using radiosity::test::Glb;
using radiosity::test::read_glb;
using radiosity::test::sample_patches;
using Json = nlohmann::json;

class LightmapGlb : public OutputFolder {};

TEST_F(LightmapGlb, ShowsThePictureWhereTheAtlasHasThePatches) {
  const PatchMesh mesh = sample_patches();
  const LightAtlas atlas = radiosity::make_light_atlas(mesh, 40);
  const Eigen::MatrixXd light = Eigen::Vector3d(1, 2, 3);
  const Image lightmap = radiosity::make_lightmap(mesh, atlas, light);
  io::write_lightmap_glb(folder() / "a.glb", mesh, atlas, lightmap, {.exposure = 1});
  const Glb glb = read_glb(folder() / "a.glb");
  EXPECT_EQ(glb.description["buffers"][0]["byteLength"], glb.binary.size());
  EXPECT_EQ(glb.binary.size() % 4, 0U);
  const Json& material = glb.description["materials"][0];
  EXPECT_TRUE(material["extensions"].contains("KHR_materials_unlit"));
  EXPECT_EQ(material["pbrMetallicRoughness"]["baseColorTexture"]["index"], 0);
  const Json attributes = glb.description["meshes"][0]["primitives"][0]["attributes"];
  EXPECT_EQ(attributes["TEXCOORD_0"], attributes["TEXCOORD_1"]);
  EXPECT_FALSE(attributes.contains("COLOR_0"));  // which would darken it

  const Json& view = glb.description["bufferViews"][3];
  const auto expected = io::encode_png("a", io::srgb_picture(lightmap, {.exposure = 1}));
  const std::string picture = glb.binary.substr(view["byteOffset"], view["byteLength"]);
  EXPECT_EQ(picture, std::string(expected.begin(), expected.end()));

  // The two patches of the square share two vertices, the wall has its own.
  ASSERT_EQ(glb.description["accessors"][1]["count"], 6 + 3);
  std::size_t vertex = 0;
  for (const AtlasChart& chart : atlas.charts) {
    const std::size_t n = chart.patches.size() == 2 ? 6 : 3;
    for (std::size_t k = 0; k < n; ++k, ++vertex) {
      radiosity::Vec3 place;
      for (int axis = 0; axis < 3; ++axis) {
        place[axis] = glb.value<float>(0, 12 * vertex + 4 * static_cast<std::size_t>(axis));
      }
      const Eigen::Vector2d at = atlas.coordinates(chart, place);
      EXPECT_NEAR(glb.value<float>(1, 8 * vertex) * static_cast<float>(atlas.width), at.x(), 1e-4);
      EXPECT_NEAR(glb.value<float>(1, 8 * vertex + 4) * static_cast<float>(atlas.height), at.y(),
                  1e-4);
    }
  }
}

TEST_F(LightmapGlb, IsReadAgainWithTheSameSurfaces) {
  const PatchMesh mesh = sample_patches();
  const LightAtlas atlas = radiosity::make_light_atlas(mesh, 40);
  const Image lightmap = radiosity::make_lightmap(mesh, atlas, Eigen::MatrixXd::Ones(3, 1));
  io::write_lightmap_glb(folder() / "a.glb", mesh, atlas, lightmap, {}, io::UpAxis::z);
  const PatchMesh again = meshing::make_patches(io::read_scene(folder() / "a.glb"));
  double area = 0;
  for (const double each : again.area) area += each;
  EXPECT_DOUBLE_EQ(area, 2.5);
  EXPECT_NEAR((again.normal[0] - radiosity::Vec3::UnitY()).norm(), 0, 1e-7);
}

}  // namespace
