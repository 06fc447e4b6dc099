#pragma once

#include <string>
#include <vector>

#include "viewer/work/session.h"

namespace viewer {

/// What the status line says, what matters most first: "ready", "494 patches", "known to ± 0.6 % (2
/// σ)", "solved in 5 s".
std::vector<std::string> status_parts(const Session& session);

}  // namespace viewer
