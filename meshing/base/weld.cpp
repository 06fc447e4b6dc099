#include "meshing/base/weld.h"

#include <bit>
#include <cassert>

namespace meshing {
namespace {

using radiosity::Index;
using radiosity::Vec3;

std::uint64_t hash(const Vec3& p) {
  std::uint64_t h = 0;
  for (int k = 0; k < 3; ++k) {
    h ^= std::bit_cast<std::uint64_t>(p[k] + 0.0);  // + 0.0 turns -0 into 0
    h *= 0x9E3779B97F4A7C15U;
    h ^= h >> 29U;
  }
  return h;
}

/// Open-addressing table from position to index in `vertices`.
class PositionTable {
 public:
  explicit PositionTable(std::size_t n) : slots_(std::bit_ceil(2 * n + 1), -1) {}

  /// Index of p, which is appended if it is new.
  std::int32_t index_of(const Vec3& p, std::vector<Vec3>& vertices) {
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t i = hash(p) & mask;; i = (i + 1) & mask) {
      if (slots_[i] < 0) {
        slots_[i] = static_cast<std::int32_t>(vertices.size());
        vertices.push_back(p);
        return slots_[i];
      }
      if (vertices[slots_[i]] == p) return slots_[i];
    }
  }

 private:
  std::vector<std::int32_t> slots_;
};

/// Per scene vertex: its index among the distinct positions, or -1 if no polygon uses it.
std::vector<std::int32_t> distinct_vertices(const radiosity::Scene& scene,
                                            std::vector<Vec3>& vertices) {
  constexpr std::int32_t kUsed = 0;
  std::vector<std::int32_t> index(scene.vertices.size(), -1);
  for (const std::int32_t corner : scene.corners) index[corner] = kUsed;
  PositionTable table(scene.vertices.size());
  for (std::size_t v = 0; v < index.size(); ++v) {
    assert(scene.vertices[v].allFinite());
    if (index[v] == kUsed) index[v] = table.index_of(scene.vertices[v], vertices);
  }
  return index;
}

}  // namespace

WeldedPolygons weld(const radiosity::Scene& scene) {
  WeldedPolygons result;
  const std::vector<std::int32_t> index = distinct_vertices(scene, result.vertices);
  result.corners.reserve(scene.corners.size());
  result.first_corner.reserve(scene.first_corner.size());
  for (Index i = 0; i < scene.n_polygons(); ++i) {
    const std::span<const std::int32_t> polygon = scene.polygon(i);
    std::int32_t previous = polygon.empty() ? -1 : index[polygon.back()];
    for (const std::int32_t corner : polygon) {
      if (index[corner] != previous) result.corners.push_back(index[corner]);
      previous = index[corner];
    }
    result.first_corner.push_back(static_cast<std::int64_t>(result.corners.size()));
  }
  return result;
}

}  // namespace meshing
