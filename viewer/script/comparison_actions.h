#pragma once

#include <map>
#include <string>

#include "viewer/script/action_kind.h"

namespace viewer {

/// The actions that pin light and compare later light with it.
std::map<std::string, ActionKind> comparison_actions();

}  // namespace viewer
