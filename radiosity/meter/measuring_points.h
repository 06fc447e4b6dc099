#pragma once

#include <optional>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/picture/point_grid.h"
#include "radiosity/scene/light_plan.h"
#include "radiosity/scene/patch_mesh.h"

namespace radiosity {

/// Where light is measured.
struct MeasuringPoints {
  std::optional<PointGrid> grid = {};  ///< if they are equal cells of a rectangle
  std::vector<Vec3> points;            ///< m
  std::vector<Vec3> normals;           ///< of the sides that are measured, unit, one per point
  /// Per point of a plane above a surface: there is none of that surface below it.
  std::vector<bool> is_off = {};
  double spacing = 0;  ///< that was asked for, m
  double border = 0;   ///< m

  [[nodiscard]] Index size() const { return static_cast<Index>(points.size()); }
};

/// The border that EN 12464-1:2021 leaves out along the walls: 0.15 of the shorter side, at most
/// 0.5 m.
double standard_border(double side, double other_side);

/// The points of a plan. A plane above a surface is the smallest rectangle around it that has a
/// side along an edge of its hull, less the border; each side is divided into the least number of
/// equal cells of at most the spacing. Turning and moving the scene turns and moves the points.
/// Throws SceneError naming the grid if the mesh has no such surface or it is not flat, if the
/// border leaves nothing, and if there would be more than kMostGridPoints.
MeasuringPoints make_measuring_points(const GridPlan& plan, const PatchMesh& mesh);

}  // namespace radiosity
