#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "radiosity/base/progress.h"

namespace io {

/// What one hour of a weather file measured: mean values; absent where the file says "missing".
struct WeatherHour {
  int month = 1;
  int day = 1;
  int hour = 1;  ///< 1 to 24: the hour before that o'clock, local standard time
  std::optional<double> direct_normal;                   ///< W/m²
  std::optional<double> diffuse_horizontal;              ///< W/m²
  std::optional<double> direct_normal_illuminance;       ///< lx
  std::optional<double> diffuse_horizontal_illuminance;  ///< lx
};

/// A year of weather at a place.
struct WeatherYear {
  double latitude = 0;   ///< degrees, north positive
  double longitude = 0;  ///< degrees, east positive
  double time_zone = 0;  ///< hours ahead of UTC
  std::vector<WeatherHour> hours;
  /// What is not there of the year, in words; or empty.
  std::vector<std::string> warnings = {};

  /// That hour; null if there is none.
  [[nodiscard]] const WeatherHour* find(int month, int day, int hour) const;
};

/// Reads an EnergyPlus weather file (.epw). Values that stand for "missing" are absent; hours that
/// are not there, twice or out of order bring a warning. Throws SceneError with file and line.
WeatherYear read_epw(const std::filesystem::path& path, const radiosity::Progress& progress = {});

}  // namespace io
