#include "apps/run/weather_hours.h"

#include <fmt/format.h>

#include <optional>

#include "radiosity/base/error.h"
#include "radiosity/scene/solar_position.h"

namespace apps {
namespace {

using radiosity::kPi;

constexpr double kRadian = kPi / 180;

/// What the sky and the sun of an hour give; none if the file lacks a value.
std::optional<study::SkyHour> sky_of_hour(const io::WeatherYear& year, const io::WeatherHour& hour,
                                          const Compass& compass, bool is_photometric) {
  const auto& direct = is_photometric ? hour.direct_normal_illuminance : hour.direct_normal;
  const auto& diffuse =
      is_photometric ? hour.diffuse_horizontal_illuminance : hour.diffuse_horizontal;
  if (!direct || !diffuse || !hour.direct_normal || !hour.diffuse_horizontal) return std::nullopt;
  const radiosity::PlaceAndTime when{.latitude = year.latitude * kRadian,
                                     .longitude = year.longitude * kRadian,
                                     .month = hour.month,
                                     .day = hour.day,
                                     .hour = hour.hour - 0.5 - year.time_zone};
  const radiosity::SolarPosition sun = radiosity::solar_position(when);
  study::SkyHour result;
  result.towards_sun =
      -radiosity::sun_direction(sun.azimuth, sun.elevation, compass.up, compass.north);
  if (sun.elevation <= 0 || *hour.diffuse_horizontal <= 0) return result;
  const double zenith = kPi / 2 - sun.elevation;
  const int day = radiosity::day_of_year(when.year, hour.month, hour.day);
  result.distribution = radiosity::perez_sky(
      radiosity::sky_clearness(*hour.diffuse_horizontal, *hour.direct_normal, zenith),
      radiosity::sky_brightness(*hour.diffuse_horizontal, zenith,
                                radiosity::extraterrestrial_irradiance(day)),
      zenith);
  result.diffuse = *diffuse;
  result.direct = *direct;
  return result;
}

}  // namespace

WeatherHours weather_hours(const io::WeatherYear& year, const std::string& file,
                           const Compass& compass, bool is_photometric, int from, int to) {
  WeatherHours result;
  result.warnings = year.warnings;
  std::size_t n_missing = 0;
  for (const io::WeatherHour& hour : year.hours) {
    if (hour.hour <= from || hour.hour > to) continue;
    const auto there = sky_of_hour(year, hour, compass, is_photometric);
    if (!there) {
      ++n_missing;
      continue;
    }
    result.hours.push_back(hour);
    result.light.push_back(there->diffuse > 0 ? static_cast<std::ptrdiff_t>(result.skies.size())
                                              : -1);
    if (there->diffuse > 0) result.skies.push_back(*there);
  }
  if (n_missing > 0) {
    result.warnings.push_back(
        fmt::format("{}: {} hours lack a value and are left out", file, n_missing));
  }
  if (result.skies.empty()) {
    throw radiosity::SceneError(
        fmt::format("{}: no hour from {} to {} o'clock has light", file, from, to));
  }
  return result;
}

}  // namespace apps
