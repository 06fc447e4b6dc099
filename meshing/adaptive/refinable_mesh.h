#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "meshing/patches/contact_lines.h"
#include "radiosity/base/geometry.h"
#include "radiosity/scene/patch_mesh.h"

namespace meshing {

/// Patches that can be divided where they are too large: quads and triangles into four. Where
/// sizes change, a corner may lie on the edge of a neighbour (T-vertex); never does more than one
/// lie on an edge of a neighbour (balance), unless the patches given came so.
class RefinableMesh {
 public:
  /// Takes patches and cuts them along the contact lines, so that none lies partly in the dark.
  explicit RefinableMesh(const radiosity::PatchMesh& mesh);

  /// The patches as they are now: parts of one patch follow each other, and siblings have one
  /// `family`.
  [[nodiscard]] const radiosity::PatchMesh& mesh() const { return mesh_; }

  /// Divides the given patches of `mesh()`, their twins, and what else must be for the sake of
  /// balance. Returns for each patch of the new mesh its number in the old one, -1 if it is new.
  std::vector<std::int32_t> refine(std::span<const radiosity::Index> patches);

 private:
  using Edge = std::pair<std::int32_t, std::int32_t>;  // vertices, the lower one first
  struct EdgeHash {
    std::size_t operator()(const Edge& edge) const {
      return std::hash<std::int64_t>{}(static_cast<std::int64_t>(edge.first) << 32 | edge.second);
    }
  };
  /// A patch, or one that has been divided.
  struct Cell {
    std::vector<std::int32_t> corners;
    std::int32_t surface;
    std::int32_t polygon;
    std::int32_t twin;
    std::int32_t family;
    std::vector<std::int32_t> parts;  ///< cells; empty if it is a patch
  };

  static Edge edge(std::int32_t a, std::int32_t b) { return {std::min(a, b), std::max(a, b)}; }
  std::int32_t add_cell(Cell cell);
  std::int32_t cut_point(const Edge& cut, const radiosity::Vec3& point);
  std::vector<std::vector<std::int32_t>> cut(const std::vector<std::int32_t>& polygon,
                                             const Segment& segment, const radiosity::Vec3& normal);
  void cut_patch(const radiosity::PatchMesh& mesh, radiosity::Index i,
                 std::span<const Segment> segments);
  std::int32_t middle(std::int32_t a, std::int32_t b);
  void divide(std::int32_t cell);
  void divide_one(std::int32_t cell);
  void register_edges(std::int32_t cell, int change);
  void build();
  void append(std::int32_t cell);

  std::vector<std::int32_t> roots_;
  std::vector<Cell> cells_;
  std::vector<std::int32_t> cell_of_patch_;
  std::vector<std::int32_t> patch_of_cell_;
  std::unordered_map<Edge, std::vector<std::int32_t>, EdgeHash> patches_at_;  ///< cells
  std::unordered_map<Edge, std::vector<std::int32_t>, EdgeHash> points_on_;   ///< of cuts
  std::unordered_map<Edge, std::int32_t, EdgeHash> middles_;
  std::unordered_map<Edge, Edge, EdgeHash> whole_edge_;  ///< of which an edge is a part
  std::int32_t n_families_ = 0;
  radiosity::PatchMesh mesh_;
};

}  // namespace meshing
