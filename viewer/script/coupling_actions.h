#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "viewer/script/action_kind.h"

namespace viewer {

/// Actions on the exchange network of a thermal scene.
std::map<std::string, ActionKind> coupling_actions();

/// The couplings of the surface that is asked about, for `state_report`; null until they are known.
nlohmann::json couplings_json(const Desk& desk);

}  // namespace viewer
