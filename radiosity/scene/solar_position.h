#pragma once

namespace radiosity {

/// A place and a moment.
struct PlaceAndTime {
  double latitude = 0;   ///< radian, north positive
  double longitude = 0;  ///< radian, east positive
  int year = 2001;       ///< Gregorian, 1901 to 2099
  int month = 1;
  int day = 1;
  double hour = 12;  ///< UTC, of that day; beyond [0, 24) it is another day's
};

/// Where the sun stands, radian.
struct SolarPosition {
  double azimuth = 0;    ///< from north by east, in [0, 2π)
  double elevation = 0;  ///< of its centre above the horizon, without refraction
};

/// By the low-accuracy theory of Meeus (Astronomical Algorithms, ch. 25; as NOAA's calculator has
/// it): to about 0.01° between 1901 and 2099.
SolarPosition solar_position(const PlaceAndTime& when);

/// Day of the year, 1 = 1 January, and the sun's irradiance outside the air on it, W/m²:
/// 1367 (1 + 0.033 cos(2π n / 365))   (Duffie & Beckman, eq. 1.4.1a).
int day_of_year(int year, int month, int day);
double extraterrestrial_irradiance(int day_of_year);

}  // namespace radiosity
