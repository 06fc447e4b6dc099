#include "meshing/base/weld.h"

#include <bit>
#include <cassert>
#include <cmath>
#include <unordered_map>
#include <utility>

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

/// Finds positions that are near to earlier ones by a grid with cells of twice the tolerance: these
/// are in one of eight cells.
class NearPositionTable {
 public:
  NearPositionTable(std::size_t n, double tolerance) : tolerance_(tolerance) { cells_.reserve(n); }

  /// Index of the first vertex near to p, which is appended if there is none.
  std::int32_t index_of(const Vec3& p, std::vector<Vec3>& vertices) {
    std::int32_t first = -1;
    for (int k = 0; k < 8; ++k) {
      const Vec3 side((k & 1) != 0 ? 1 : -1, (k & 2) != 0 ? 1 : -1, (k & 4) != 0 ? 1 : -1);
      const auto [begin, end] = cells_.equal_range(hash(cell(p + tolerance_ * side)));
      for (auto entry = begin; entry != end; ++entry) {
        const std::int32_t v = entry->second;
        const bool is_near = (vertices[v] - p).cwiseAbs().maxCoeff() <= tolerance_;
        if (is_near && (first < 0 || v < first)) first = v;
      }
    }
    if (first >= 0) return first;
    const auto added = static_cast<std::int32_t>(vertices.size());
    vertices.push_back(p);
    cells_.emplace(hash(cell(p)), added);
    return added;
  }

 private:
  [[nodiscard]] Vec3 cell(const Vec3& p) const { return (p / (2 * tolerance_)).array().floor(); }

  double tolerance_;
  std::unordered_multimap<std::uint64_t, std::int32_t> cells_;
};

/// Per scene vertex: its index among the distinct positions, or -1 if no polygon uses it.
template <typename Table>
std::vector<std::int32_t> distinct_vertices(const radiosity::Scene& scene, Table table,
                                            std::vector<Vec3>& vertices) {
  constexpr std::int32_t kUsed = 0;
  std::vector<std::int32_t> index(scene.vertices.size(), -1);
  for (const std::int32_t corner : scene.corners) index[corner] = kUsed;
  for (std::size_t v = 0; v < index.size(); ++v) {
    assert(scene.vertices[v].allFinite());
    if (index[v] == kUsed) index[v] = table.index_of(scene.vertices[v], vertices);
  }
  return index;
}

WeldedPolygons weld_by(const radiosity::Scene& scene, auto table) {
  WeldedPolygons result;
  const std::vector<std::int32_t> index =
      distinct_vertices(scene, std::move(table), result.vertices);
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

}  // namespace

WeldedPolygons weld(const radiosity::Scene& scene) {
  return weld_by(scene, PositionTable(scene.vertices.size()));
}

WeldedPolygons weld(const radiosity::Scene& scene, double tolerance) {
  if (!(tolerance > 0)) return weld(scene);
  return weld_by(scene, NearPositionTable(scene.vertices.size(), tolerance));
}

}  // namespace meshing
