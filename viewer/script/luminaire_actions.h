#pragma once

#include <map>
#include <string>

#include "viewer/script/action_kind.h"

namespace viewer {

/// Actions on the luminaires of the scene, by name.
std::map<std::string, ActionKind> luminaire_actions();

}  // namespace viewer
