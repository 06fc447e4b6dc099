#pragma once

#include <map>
#include <string>

#include "viewer/script/action_kind.h"

namespace viewer {

/// The actions of the tour and of the examples.
std::map<std::string, ActionKind> help_actions();

}  // namespace viewer
