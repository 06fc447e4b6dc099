#pragma once

#include <map>
#include <string>

#include "viewer/script/action_kind.h"

namespace viewer {

/// All actions by name; docs/viewer.md has them. What they throw names no file or action.
const std::map<std::string, ActionKind>& action_kinds();

}  // namespace viewer
