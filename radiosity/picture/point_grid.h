#pragma once

#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/patch_mesh.h"

namespace radiosity {

/// A rectangle divided into equal cells, with a point in the middle of each. Point k is in column
/// k % n_columns of row k / n_columns.
struct PointGrid {
  Vec3 corner = Vec3::Zero();  ///< of the rectangle, m
  Vec3 column = Vec3::Zero();  ///< from one column to the next, m
  Vec3 row = Vec3::Zero();     ///< from one row to the next, m; at a right angle to `column`
  Index n_columns = 0;
  Index n_rows = 0;

  [[nodiscard]] Index size() const { return n_columns * n_rows; }
  /// Of unit length, to the side from which rows follow columns counter-clockwise.
  [[nodiscard]] Vec3 normal() const { return column.cross(row).normalized(); }
  [[nodiscard]] Vec3 point(Index k) const {
    const Index r = k / n_columns;
    return corner + (static_cast<double>(k % n_columns) + 0.5) * column +
           (static_cast<double>(r) + 0.5) * row;
  }
};

/// Where a work plane lies, and how many points it has.
struct WorkPlaneOptions {
  double height = 0.75;  ///< above the floor, m
  double border = 0;     ///< that is left out along the floor's edges, m
  double spacing = 0;    ///< of the points at most, m; 0: half of `largest_spacing`
};

/// Points further apart than this may miss what lighting standards ask for, m: 0.2 · 5^(lg d), at
/// most 10, d being the longer side of the rectangle in metres or, if that is twice the shorter one
/// or more, the shorter one (EN 12464-1, illuminance grid).
double largest_spacing(double side, double other_side);

/// The floor of a scene: the lowest level with at least half as much area facing upwards as the
/// level that has most.
struct Floor {
  double level = 0;       ///< height of its middle in the direction of `up`, m
  Box3 box;               ///< of its patches, m
  bool is_found = false;  ///< else there is nothing that faces upwards; box and level are the
                          ///< scene's
};
Floor find_floor(const PatchMesh& mesh, const Vec3& up);

/// A level grid above the floor's box that looks upwards; `up` is the direction of an axis. Throws
/// SceneError if the border leaves nothing, or if there would be more than `kMostGridPoints`.
PointGrid make_work_plane(const PatchMesh& mesh, const Vec3& up,
                          const WorkPlaneOptions& options = {});
inline constexpr Index kMostGridPoints = 100'000;

}  // namespace radiosity
