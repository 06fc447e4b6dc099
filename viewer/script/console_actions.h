#pragma once

#include <map>
#include <string>

#include "viewer/script/action_kind.h"

namespace viewer {

/// The actions on the messages below the picture.
std::map<std::string, ActionKind> console_actions();

}  // namespace viewer
