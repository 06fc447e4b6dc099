#pragma once

#include <nlohmann/json_fwd.hpp>

#include "viewer/desk/desk.h"

namespace viewer {

/// What the window shows and knows, for scripts and tests (docs/viewer.md lists the keys). A value
/// that is no finite number is null.
nlohmann::json state_report(const Desk& desk);

}  // namespace viewer
