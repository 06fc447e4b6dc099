#include "io/result/color_glb.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "io/result/colored_mesh.h"
#include "io/result/glb_file.h"

namespace io {
namespace {

/// The linear value of an 8-bit one of sRGB (IEC 61966-2-1), of which 65535 is white.
std::uint16_t linear(std::uint8_t srgb) {
  const double value = srgb / 255.0;
  const double result = value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
  return static_cast<std::uint16_t>(std::lround(65535 * result));
}

}  // namespace

void write_color_glb(const std::filesystem::path& path, const radiosity::PatchMesh& mesh,
                     const CornerColors& colors, UpAxis up) {
  const ColoredMesh colored = color_corners(mesh, colors);
  std::array<std::uint16_t, 256> linear_of{};
  for (std::size_t k = 0; k < 256; ++k) linear_of[k] = linear(static_cast<std::uint8_t>(k));
  GlbMesh glb;
  for (const ColoredMesh::Vertex& vertex : colored.vertices) {
    const Eigen::Vector3f place = mesh.vertices[vertex.vertex].cast<float>();
    glb.places.push_back({place.x(), place.y(), place.z()});
    const auto& [red, green, blue] = vertex.color;
    glb.colors.push_back({linear_of[red], linear_of[green], linear_of[blue], 65535});
  }
  const auto vertex = [&](std::int32_t patch, int k) { return colored.corners[patch][k]; };
  add_triangles(mesh, vertex, glb);
  write_glb(path, mesh.surface_names, glb, up);
}

}  // namespace io
