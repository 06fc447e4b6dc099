#pragma once

#include <map>
#include <string>

#include "viewer/script/action_kind.h"

namespace viewer {

/// The actions that move the camera, keep views and measure.
std::map<std::string, ActionKind> camera_actions();

}  // namespace viewer
