#pragma once

#include <cstdint>
#include <vector>

namespace meshing {

/// A polygon with divided edges: vertex indices all around, and where its corners are among them.
struct PolygonCell {
  std::vector<std::int32_t> boundary;
  std::vector<std::int32_t> corners;

  [[nodiscard]] int n_corners() const { return static_cast<int>(corners.size()); }
  [[nodiscard]] std::int32_t n_pieces(int side) const {
    const std::int32_t end =
        side + 1 < n_corners() ? corners[side + 1] : static_cast<std::int32_t>(boundary.size());
    return end - corners[side];
  }
  /// Vertex k of a side, 0 <= k <= n_pieces(side).
  [[nodiscard]] std::int32_t vertex(int side, std::int32_t k) const {
    return boundary[(corners[side] + k) % boundary.size()];
  }
  [[nodiscard]] bool is_undivided() const { return boundary.size() == corners.size(); }
  [[nodiscard]] bool is_evenly_divided() const {
    for (int side = 1; side < n_corners(); ++side) {
      if (n_pieces(side) != n_pieces(0)) return false;
    }
    return true;
  }
  void clear() {
    boundary.clear();
    corners.clear();
  }
};

}  // namespace meshing
