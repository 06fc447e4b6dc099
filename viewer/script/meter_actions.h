#pragma once

#include <map>
#include <string>

#include "viewer/script/action_kind.h"

namespace viewer {

/// The actions that measure light on a work plane and at points.
std::map<std::string, ActionKind> meter_actions();

}  // namespace viewer
