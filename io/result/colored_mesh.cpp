#include "io/result/colored_mesh.h"

#include <unordered_map>

namespace io {

using radiosity::Index;
using radiosity::PatchMesh;

ColoredMesh color_corners(const PatchMesh& mesh, const CornerColors& colors) {
  ColoredMesh colored;
  std::unordered_map<std::uint64_t, std::int32_t> index_of;
  for (Index i = 0; i < mesh.size(); ++i) {
    std::array<std::int32_t, 4> corners = {-1, -1, -1, -1};
    for (int k = 0; k < mesh.n_corners(i); ++k) {
      const std::int32_t vertex = mesh.corners[i][k];
      const auto& rgb = colors[4 * i + k];
      const std::uint64_t key = std::uint64_t(vertex) << 24 | std::uint64_t(rgb[0]) << 16 |
                                std::uint64_t(rgb[1]) << 8 | rgb[2];
      const auto [entry, is_new] =
          index_of.try_emplace(key, static_cast<std::int32_t>(colored.vertices.size()));
      if (is_new) colored.vertices.push_back({vertex, rgb});
      corners[k] = entry->second;
    }
    colored.corners.push_back(corners);
  }
  return colored;
}

}  // namespace io
