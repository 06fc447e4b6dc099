#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/patch_mesh.h"

namespace meshing {

using Loop = std::vector<std::int32_t>;  ///< vertices around something, counter-clockwise

/// A convex part of a patch: the vertices around it, those on its straight edges included.
struct Cell {
  Loop loop;
  std::int32_t patch;
};

/// Patches of a mesh, which it refers to, on their way to being cut: each starts as one cell. What
/// is done to an edge is done to all cells that have it, so that no T-vertices come up. Of two
/// patches back to back the front has the cells.
class PatchCells {
 public:
  /// Has cells of `patches` only, among which must be all that have a corner in common with one
  /// that is cut or moved. The first `n_fixed` vertices are locked.
  PatchCells(const radiosity::PatchMesh& mesh, radiosity::Index n_fixed,
             std::span<const std::int32_t> patches);

  [[nodiscard]] std::size_t size() const { return cells_.size(); }
  [[nodiscard]] const Cell& operator[](std::int32_t cell) const { return cells_[cell]; }
  /// A patch as it is in the mesh.
  [[nodiscard]] Cell whole(std::int32_t patch) const;
  /// The cells of a patch, in the order that they were made in.
  [[nodiscard]] const std::vector<std::int32_t>& of_patch(std::int32_t patch) const {
    return cells_of_[patch];
  }
  /// Calls visit(cell) for the cells that a patch has now, in that order, if their box meets the
  /// given one when it is their turn. `visit` may cut them and move their corners.
  template <typename Visit>
  void for_each_near(std::int32_t patch, const radiosity::Box3& box, const Visit& visit) const {
    const std::size_t n = cells_of_[patch].size();
    for (std::size_t first = 0; first < n; first += kRow) {
      if (!rows_of_[patch][first / kRow].intersects(box)) continue;
      for (std::size_t k = first; k < std::min(n, first + kRow); ++k) {
        const std::int32_t cell = cells_of_[patch][k];
        if (boxes_[cell].intersects(box)) visit(cell);
      }
    }
  }
  [[nodiscard]] const std::vector<radiosity::Vec3>& vertices() const { return vertices_; }
  [[nodiscard]] const radiosity::Vec3& at(std::int32_t vertex) const { return vertices_[vertex]; }
  /// The shortest edge that meets a vertex, m.
  [[nodiscard]] double shortest_edge(std::int32_t vertex) const;
  /// Sines of the corners of a loop about a normal, negative where they are concave.
  [[nodiscard]] std::vector<double> sines_in(const Loop& loop, const radiosity::Vec3& normal) const;

  /// Keeps a vertex where it is.
  void lock(std::int32_t vertex) { is_locked_[vertex] = true; }
  /// Moves a vertex within its polygon, or along its outline, and locks it; does nothing and
  /// returns false where that spoils a patch.
  bool move(std::int32_t vertex, const radiosity::Vec3& to);
  /// Puts a locked vertex on an edge of all cells that have it.
  void split_edge(std::int32_t a, std::int32_t b, const radiosity::Vec3& point);
  /// Cuts a cell between two of its vertices, given by their places in the loop, from < to.
  void split_cell(std::int32_t cell, std::size_t from, std::size_t to);

 private:
  using Edge = std::pair<std::int32_t, std::int32_t>;  // vertices, the lower one first
  static constexpr std::size_t kRow = 64;
  struct EdgeHash {
    std::size_t operator()(const Edge& edge) const {
      return std::hash<std::int64_t>{}(static_cast<std::int64_t>(edge.first) << 32 | edge.second);
    }
  };

  [[nodiscard]] bool is_inside_polygon(const Edge& edge) const;
  [[nodiscard]] bool may_move(std::int32_t vertex, const radiosity::Vec3& direction) const;
  [[nodiscard]] double area_in(const Loop& loop, const radiosity::Vec3& normal) const;
  void add_cell(Loop loop, std::int32_t patch);
  /// Makes the boxes of a cell hold a point.
  void extend_boxes(std::int32_t cell, const radiosity::Vec3& point);
  void enter(std::int32_t cell);
  void take_out(std::int32_t cell);

  const radiosity::PatchMesh& mesh_;
  std::vector<radiosity::Vec3> vertices_;
  std::vector<bool> is_locked_;  // corners of the input, and what lies on a contact line
  std::vector<Cell> cells_;
  std::vector<radiosity::Box3> boxes_;                 // that hold them, and what they were
  std::vector<std::int32_t> place_;                    // of the cells in `cells_of_`
  std::vector<std::vector<std::int32_t>> cells_at_;    // per vertex
  std::vector<std::vector<std::int32_t>> cells_of_;    // per patch
  std::vector<std::vector<radiosity::Box3>> rows_of_;  // per patch: boxes of kRow cells together
  std::unordered_map<Edge, std::vector<std::int32_t>, EdgeHash> cells_on_;
};

}  // namespace meshing
