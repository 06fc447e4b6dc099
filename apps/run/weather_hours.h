#pragma once

#include <string>
#include <vector>

#include "io/scene/epw_file.h"
#include "radiosity/scene/scene.h"
#include "study/daylight_year.h"

namespace apps {

/// The hours of a year in which there is light, and all that count.
struct WeatherHours {
  std::vector<io::WeatherHour> hours;      ///< all that count, dark ones, too
  std::vector<std::ptrdiff_t> light;       ///< per hour: index into `skies`, or -1 if it is dark
  std::vector<study::SkyHour> skies;       ///< lx, or W/m² of bands of heat
  std::vector<std::string> warnings = {};  ///< what is not reckoned with
};

/// Where up and north are in a scene, unit length.
struct Compass {
  radiosity::Vec3 up;
  radiosity::Vec3 north;
};

/// Those of a weather file between two o'clocks, 0 <= from < to <= 24 of its standard time: Perez'
/// skies and the sun in the middle of the hour. Photometric values are
/// the file's illuminances. Hours that lack a value are left out and counted in a warning. Throws
/// SceneError if none is left.
WeatherHours weather_hours(const io::WeatherYear& year, const std::string& file,
                           const Compass& compass, bool is_photometric, int from, int to);

}  // namespace apps
