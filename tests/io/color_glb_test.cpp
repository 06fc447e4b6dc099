#include "io/result/color_glb.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "io/scene/scene_file.h"
#include "meshing/patches/patches.h"
#include "tests/support/output_folder.h"
#include "tests/support/shapes.h"

namespace {

using Json = nlohmann::json;
using radiosity::Index;
using radiosity::PatchMesh;
using radiosity::Vec3;

class ColorGlb : public OutputFolder {};

/// A square of two patches and a triangle on another surface.
PatchMesh sample() {
  PatchMesh mesh;
  mesh.surface_names = {"floor", "wall"};
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                   {2, 0, 0}, {2, 1, 0}, {0, 0, 1}, {0, 1, 1}};
  mesh.add_patch({0, 1, 2, 3}, 0, 0);
  mesh.add_patch({1, 4, 5, 2}, 0, 0);
  mesh.add_patch({0, 3, 7, -1}, 1, 1);
  return mesh;
}

io::CornerColors colors_of(const PatchMesh& mesh) {
  io::CornerColors colors(4 * mesh.size(), {255, 128, 0});
  for (int k = 0; k < 4; ++k) colors[8 + k] = {10, 200, 255};
  return colors;
}

struct Glb {
  Json description;
  std::string binary;

  template <typename T>
  [[nodiscard]] T value(std::size_t view, std::size_t offset) const {
    T result{};
    const std::size_t start = description["bufferViews"][view]["byteOffset"];
    std::memcpy(&result, binary.data() + start + offset, sizeof(T));
    return result;
  }
};

Glb read_glb(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  const std::string all(std::istreambuf_iterator<char>(stream), {});
  const auto word = [&](std::size_t place) {
    std::uint32_t result = 0;
    std::memcpy(&result, all.data() + place, 4);
    return result;
  };
  EXPECT_EQ(all.substr(0, 4), "glTF");
  EXPECT_EQ(word(4), 2U);
  EXPECT_EQ(word(8), all.size());
  EXPECT_EQ(all.substr(16, 4), "JSON");
  const std::size_t length = word(12);
  EXPECT_EQ(length % 4, 0U);
  EXPECT_EQ(word(20 + length), all.size() - 28 - length);
  return {Json::parse(all.substr(20, length)), all.substr(28 + length)};
}

TEST_F(ColorGlb, ShowsTheColoursUnlit) {
  const PatchMesh mesh = sample();
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
  const PatchMesh mesh = sample();
  io::write_color_glb(folder() / "a.glb", mesh, colors_of(mesh));
  const radiosity::Scene scene = io::read_scene(folder() / "a.glb");
  EXPECT_EQ(scene.n_polygons(), 5);
  const PatchMesh again = meshing::make_patches(scene);
  EXPECT_DOUBLE_EQ(again.area[0] + again.area[1], 1);
  EXPECT_EQ(again.normal[4], mesh.normal[2]);
  ASSERT_EQ(scene.surfaces.size(), 2U);
}

TEST_F(ColorGlb, StandsUprightWhateverAxisIsUp) {
  const PatchMesh mesh = sample();
  io::write_color_glb(folder() / "a.glb", mesh, colors_of(mesh), io::UpAxis::z);
  const PatchMesh turned = meshing::make_patches(io::read_scene(folder() / "a.glb"));
  // The floor's normal, z there, is y here.
  EXPECT_NEAR((turned.normal[0] - Vec3::UnitY()).norm(), 0, 1e-7);
}

}  // namespace
