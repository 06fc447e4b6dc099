#pragma once

#include <filesystem>

#include "io/base/json_item.h"
#include "radiosity/scene/scene.h"

namespace io {

/// What a scene file says is to be measured, "grids", "observers" and "maintenance_factor", in
/// metres. Surfaces must have been read. Throws SceneError naming the item.
void read_light_plan(const JsonItem& root, const std::filesystem::path& folder, double unit,
                     radiosity::Scene& scene);

/// A number in (0, 1].
double read_maintenance_factor(const JsonItem& item);

/// The same plan as JSON, in metres: keys of a scene that are not there by default.
Json light_plan_json(const radiosity::LightPlan& plan);

}  // namespace io
