#pragma once

#include <cstdint>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/patch_mesh.h"

namespace radiosity {

/// Tells whether planes have all vertices of a mesh behind them, by boxes of many at a time.
class VertexBlocks {
 public:
  /// The mesh must outlive this.
  explicit VertexBlocks(const PatchMesh& mesh);

  /// Whether normal · x <= limit for all vertices x, m.
  [[nodiscard]] bool are_all_behind(const Vec3& normal, double limit) const;

 private:
  const PatchMesh& mesh_;
  Box3 box_;
  std::vector<Box3> blocks_;
};

/// The patches that block something, one of each pair of twins: those in a plane that has the whole
/// scene on one side (a wall of a convex room) don't.
/// `thickness` is how far off a plane points may be and still count as on it, m.
std::vector<std::int32_t> find_blocking_patches(const PatchMesh& mesh, double thickness);

}  // namespace radiosity
