#pragma once

#include <string>

#include "apps/validation/plot/plot.h"

namespace apps::validation {

/// The plot as an SVG element that needs nothing else: axes with ticks and labels, a legend above,
/// series told apart by colour and shape. It scales with the page.
std::string svg(const Plot& plot);

}  // namespace apps::validation
