#include "apps/options/daylight_place.h"

#include <CLI/App.hpp>

namespace apps {

void add_daylight_place(CLI::App& command, DaylightPlace& place) {
  auto* points = command
                     .add_option("--points", place.file,
                                 "Points (.csv of lines x,y,z or x,y,z,nx,ny,nz, metres) instead "
                                 "of a work plane")
                     ->type_name("FILE");
  command.add_option("--height", place.plane.height, "Of the work plane above the floor, metres")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str()
      ->excludes(points)
      ->type_name("H");
  command
      .add_option("--spacing", place.plane.spacing, "Of its points at most, metres; 0: by its size")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str()
      ->excludes(points)
      ->type_name("S");
  command.add_option("--border", place.plane.border, "Left out along the floor's edges, metres")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str()
      ->excludes(points)
      ->type_name("B");
}

}  // namespace apps
