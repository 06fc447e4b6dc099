#include "io/result/lightmap_glb.h"

#include <cassert>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace io {

using radiosity::AtlasChart;

void write_lightmap_glb(const std::filesystem::path& path, const radiosity::PatchMesh& mesh,
                        const radiosity::LightAtlas& atlas, const radiosity::Image& lightmap,
                        const ImageOptions& options, UpAxis up) {
  assert(lightmap.width == atlas.width && lightmap.height == atlas.height);
  GlbMesh glb;
  glb.picture = encode_png(path, srgb_picture(lightmap, options));
  // By patch and corner, as of `corner_values`.
  std::vector<std::uint32_t> vertices(4 * static_cast<std::size_t>(mesh.size()));
  for (const AtlasChart& chart : atlas.charts) {
    std::unordered_map<std::int32_t, std::uint32_t> of_chart;
    for (const std::int32_t patch : chart.patches) {
      for (int k = 0; k < mesh.n_corners(patch); ++k) {
        const std::int32_t corner = mesh.corners[patch][k];
        const auto [entry, is_new] =
            of_chart.try_emplace(corner, static_cast<std::uint32_t>(glb.places.size()));
        vertices[4 * static_cast<std::size_t>(patch) + k] = entry->second;
        if (!is_new) continue;
        const Eigen::Vector3f place = mesh.vertices[corner].cast<float>();
        const Eigen::Vector2d texel = atlas.coordinates(chart, mesh.vertices[corner]);
        glb.places.push_back({place.x(), place.y(), place.z()});
        glb.coordinates.push_back({static_cast<float>(texel.x() / atlas.width),
                                   static_cast<float>(texel.y() / atlas.height)});
      }
    }
  }
  const auto vertex = [&](std::int32_t patch, int k) {
    return vertices[4 * static_cast<std::size_t>(patch) + k];
  };
  add_triangles(mesh, vertex, glb);
  write_glb(path, mesh.surface_names, glb, up);
}

}  // namespace io
