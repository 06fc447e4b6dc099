#pragma once

#include <string>

#include "apps/run/made_part.h"

namespace apps {

/// A line of the summary on a part.
std::string part_line(const MadePart& part);

}  // namespace apps
