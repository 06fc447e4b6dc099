#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "viewer/script/action_kind.h"

namespace viewer {

/// Actions on the sun and the sky.
std::map<std::string, ActionKind> daylight_actions();

/// Where the sun stands and what the sky is, for `state_report`; null without either.
nlohmann::json daylight_json(const Desk& desk);

}  // namespace viewer
