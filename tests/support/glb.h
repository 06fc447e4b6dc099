#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

#include "radiosity/scene/patch_mesh.h"

namespace radiosity::test {

/// A square of two patches and a triangle on another surface.
inline PatchMesh sample_patches() {
  PatchMesh mesh;
  mesh.surface_names = {"floor", "wall"};
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                   {2, 0, 0}, {2, 1, 0}, {0, 0, 1}, {0, 1, 1}};
  mesh.add_patch({0, 1, 2, 3}, 0, 0);
  mesh.add_patch({1, 4, 5, 2}, 0, 0);
  mesh.add_patch({0, 3, 7, -1}, 1, 1);
  return mesh;
}

/// What a .glb file holds.
struct Glb {
  nlohmann::json description;
  std::string binary;

  template <typename T>
  [[nodiscard]] T value(std::size_t view, std::size_t offset) const {
    T result{};
    const std::size_t start = description["bufferViews"][view]["byteOffset"];
    std::memcpy(&result, binary.data() + start + offset, sizeof(T));
    return result;
  }
};

inline Glb read_glb(const std::filesystem::path& path) {
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
  return {nlohmann::json::parse(all.substr(20, length)), all.substr(28 + length)};
}

}  // namespace radiosity::test
