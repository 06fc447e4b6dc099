#include "radiosity/scene/solar_position.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "radiosity/base/geometry.h"

namespace radiosity {
namespace {

constexpr double kDegree = kPi / 180;
constexpr double kSolarConstant = 1367;  // W/m²

double wrapped(double x, double period) { return x - period * std::floor(x / period); }

/// Days since 1 January 2000, 12 h.
double days_since_2000(const PlaceAndTime& when) {
  const int before = when.year - 2001;  // since 1 January 2001
  const double days =
      365.0 * before + std::floor(before / 4.0) + day_of_year(when.year, when.month, when.day) - 1;
  return 366 + days - 0.5 + when.hour / 24;
}

}  // namespace

int day_of_year(int year, int month, int day) {
  constexpr std::array<int, 12> before = {0, 31, 59, 90, 120, 151, 181, 212, 243, 273, 304, 334};
  const bool is_leap = year % 4 == 0;  // between 1901 and 2099
  return before[static_cast<std::size_t>(month - 1)] + day + (is_leap && month > 2 ? 1 : 0);
}

double extraterrestrial_irradiance(int day_of_year) {
  return kSolarConstant * (1 + 0.033 * std::cos(2 * kPi * day_of_year / 365));
}

SolarPosition solar_position(const PlaceAndTime& when) {
  const double days = days_since_2000(when);
  const double t = days / 36525;  // Julian centuries
  const double mean_longitude = wrapped(280.46646 + t * (36000.76983 + 0.0003032 * t), 360);
  const double anomaly = (357.52911 + t * (35999.05029 - 0.0001537 * t)) * kDegree;
  const double center = std::sin(anomaly) * (1.914602 - t * (0.004817 + 0.000014 * t)) +
                        std::sin(2 * anomaly) * (0.019993 - 0.000101 * t) +
                        std::sin(3 * anomaly) * 0.000289;
  const double node = (125.04 - 1934.136 * t) * kDegree;
  const double longitude = (mean_longitude + center - 0.00569 - 0.00478 * std::sin(node)) * kDegree;
  const double obliquity =
      (23.439291 - t * (0.0130042 + t * 1.64e-7) + 0.00256 * std::cos(node)) * kDegree;
  const double declination = std::asin(std::sin(obliquity) * std::sin(longitude));
  const double ascension =
      std::atan2(std::cos(obliquity) * std::sin(longitude), std::cos(longitude));
  const double sidereal = wrapped(280.46061837 + 360.98564736629 * days, 360) * kDegree;
  const double hour_angle = sidereal + when.longitude - ascension;
  const double sine = std::sin(when.latitude) * std::sin(declination) +
                      std::cos(when.latitude) * std::cos(declination) * std::cos(hour_angle);
  const double to_east = -std::cos(declination) * std::sin(hour_angle);
  const double to_north = std::cos(when.latitude) * std::sin(declination) -
                          std::sin(when.latitude) * std::cos(declination) * std::cos(hour_angle);
  return {wrapped(std::atan2(to_east, to_north), 2 * kPi), std::asin(std::clamp(sine, -1., 1.))};
}

}  // namespace radiosity
