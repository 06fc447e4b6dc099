#pragma once

#include <map>
#include <string>

#include "viewer/script/action_kind.h"

namespace viewer {

/// The actions of the list of surfaces.
std::map<std::string, ActionKind> surface_actions();

}  // namespace viewer
