#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "viewer/script/action_kind.h"

namespace viewer {

/// Actions on the grids of the scene.
std::map<std::string, ActionKind> grid_actions();

/// What was measured of grids and observers, for `state_report`; null for a scene without any.
nlohmann::json grids_json(const Desk& desk);

}  // namespace viewer
