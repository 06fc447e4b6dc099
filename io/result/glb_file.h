#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"

namespace io {

/// Which axis of the scene points upwards; that of glTF is y.
enum class UpAxis { y, z };

/// The one that is nearly `up` for the camera; y if there is none.
UpAxis up_axis(const std::optional<radiosity::Camera>& camera);

/// Triangles as glTF holds them: vertices with a colour or, if there is a picture, with places in
/// it; the triangles of a surface follow each other.
struct GlbMesh {
  std::vector<std::array<float, 3>> places;          ///< m
  std::vector<std::array<std::uint16_t, 4>> colors;  ///< linear, 65535 is white
  std::vector<std::array<float, 2>> coordinates;     ///< from the left top of the picture, 0 to 1
  std::vector<std::uint32_t> indices;
  std::vector<std::size_t> first_indices;  ///< of each surface; one more is the end
  std::vector<std::uint8_t> picture;       ///< a PNG file; empty: there are colours
};

/// Appends the triangles of all patches, of which `vertex(patch, k)` is the vertex of corner k.
template <typename Vertex>
void add_triangles(const radiosity::PatchMesh& mesh, const Vertex& vertex, GlbMesh& glb) {
  std::vector<std::vector<std::int32_t>> patches(mesh.surface_names.size());
  for (radiosity::Index i = 0; i < mesh.size(); ++i) {
    patches[mesh.surface[i]].push_back(static_cast<std::int32_t>(i));
  }
  for (const std::vector<std::int32_t>& of_surface : patches) {
    glb.first_indices.push_back(glb.indices.size());
    for (const std::int32_t patch : of_surface) {
      for (int k = 2; k < mesh.n_corners(patch); ++k) {
        for (const int corner : {0, k - 1, k}) {
          glb.indices.push_back(static_cast<std::uint32_t>(vertex(patch, corner)));
        }
      }
    }
  }
  glb.first_indices.push_back(glb.indices.size());
}

/// Writes binary glTF 2.0 that shows colours or picture as they are (KHR_materials_unlit), with a
/// node for each surface that has triangles. Places in the picture are both TEXCOORD_0, which shows
/// it, and TEXCOORD_1, where engines look for light. Throws OutputError, also if the file would be
/// larger than the format allows (4 GB).
void write_glb(const std::filesystem::path& path, const std::vector<std::string>& surface_names,
               const GlbMesh& mesh, UpAxis up);

}  // namespace io
