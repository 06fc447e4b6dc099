#pragma once

#include <optional>
#include <string>

#include "radiosity/picture/point_grid.h"

namespace CLI {
class App;
}

namespace apps {

/// Where daylight is asked for: at the points of a file or, without one, on a work plane.
struct DaylightPlace {
  std::optional<std::string> file;
  radiosity::WorkPlaneOptions plane = {.height = 0.85, .border = 0.5, .spacing = 0};
};

/// Adds --points, --height, --spacing and --border.
void add_daylight_place(CLI::App& command, DaylightPlace& place);

}  // namespace apps
