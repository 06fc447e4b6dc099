#pragma once

#include <filesystem>

#include "radiosity/scene/light_plan.h"

namespace io {

/// Appends the points of a .csv file to a plan: rows x,y,z or x,y,z,nx,ny,nz, coordinates in `unit`
/// metres, the normals of any length; without them the points look along the plan's `up`, or z.
/// The first line may name the columns; # begins a comment. Throws SceneError with file and line
/// for another number of columns, for what is no finite number, for a normal of 0, more than
/// kMostGridPoints, and if there is no point.
void add_points(const std::filesystem::path& path, double unit, radiosity::GridPlan& plan);

}  // namespace io
