#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/patch_mesh.h"

namespace radiosity {

/// A corner group that lies inside another patch's edge: what it shows is the value at fraction
/// `t` in (0, 1) of the way from slot `from` to slot `to`.
struct TVertex {
  std::int32_t group = -1;
  std::int64_t from = -1;
  std::int64_t to = -1;
  double t = 0;
};

/// Which corners of patches form one smooth point. Slot 4 i + k is corner k of patch i; the fourth
/// slot of a triangle belongs to no group.
struct SmoothCorners {
  std::vector<std::int32_t> group_of;     ///< per slot: its group, or -1
  std::vector<std::int64_t> slots;        ///< the slots of all groups, concatenated
  std::vector<std::int64_t> first_slot;   ///< n_groups + 1 offsets into `slots`
  std::vector<std::uint8_t> is_interior;  ///< per group: 1 if its patches surround the point
  std::vector<TVertex> t_vertices;        ///< at most one per group, those on long edges first

  [[nodiscard]] Index size() const { return static_cast<Index>(first_slot.size()) - 1; }

  /// The slots of group g.
  [[nodiscard]] std::span<const std::int64_t> group(Index g) const {
    return std::span(slots).subspan(first_slot[g], first_slot[g + 1] - first_slot[g]);
  }
};

/// Joins the corners that have the same position and surface and whose patches' normals differ by
/// at most `crease_angle` (radian), directly or through others of the same point.
SmoothCorners make_smooth_corners(const PatchMesh& mesh, double crease_angle);

}  // namespace radiosity
