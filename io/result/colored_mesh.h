#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "radiosity/scene/patch_mesh.h"

namespace io {

/// 8-bit sRGB of the patches' corners: rows 4 i + k as of `radiosity::corner_values`.
using CornerColors = std::vector<std::array<std::uint8_t, 3>>;

/// The patches' corners with a colour each; corners that agree in place and colour share a vertex.
struct ColoredMesh {
  struct Vertex {
    std::int32_t vertex;                ///< of the mesh
    std::array<std::uint8_t, 3> color;  ///< 8-bit sRGB
  };
  std::vector<Vertex> vertices;
  std::vector<std::array<std::int32_t, 4>> corners;  ///< per patch; [3] = -1 for a triangle
};

ColoredMesh color_corners(const radiosity::PatchMesh& mesh, const CornerColors& colors);

}  // namespace io
