#include "io/scene/json_sky.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>

#include "io/scene/epw_file.h"
#include "io/scene/json_materials.h"
#include "io/scene/json_sun.h"
#include "io/scene/scene_keys.h"
#include "radiosity/base/error.h"
#include "radiosity/scene/solar_position.h"
#include "radiosity/solve/quantity.h"
#include "radiosity/visibility/sky_light.h"

namespace io {
namespace {

using radiosity::Bands;
using radiosity::kPi;
using radiosity::PlaceAndTime;
using radiosity::Scene;
using radiosity::Sky;
using radiosity::SkyDistribution;
using radiosity::Vec3;

constexpr double kDegree = kPi / 180;
/// Reflectance of the ground if nobody says otherwise: that of grass and soil, as is usual.
constexpr double kUsualGround = 0.2;
/// The keys that tell how bright a sky is.
constexpr std::array<std::string_view, 4> kAmounts = {"zenith_radiance", "horizontal_irradiance",
                                                      "zenith_luminance", "horizontal_illuminance"};

double between(const JsonItem& item, double least, double most) {
  const double value = item.number();
  if (!(value >= least && value <= most)) {
    item.fail(fmt::format("{} is outside [{}, {}]", value, least, most));
  }
  return value;
}

int whole_between(const JsonItem& item, int least, int most) {
  const double value = between(item, least, most);
  if (value != std::floor(value)) item.fail(fmt::format("{} is no whole number", value));
  return static_cast<int>(value);
}

/// W per lm of light that is given in photometric units: white light's.
Eigen::VectorXd of_white_light(const JsonItem& item, double photometric, const Bands& bands) {
  if (bands.kind != Bands::Kind::rgb && bands.kind != Bands::Kind::grey) {
    item.fail("light in lx or cd/m² needs \"bands\" that are \"rgb\" or \"grey\"");
  }
  return Eigen::VectorXd::Constant(bands.count(), photometric / radiosity::kWhiteEfficacy);
}

double not_negative(const JsonItem& item) {
  const double value = item.number();
  if (!(value >= 0)) item.fail(fmt::format("is {}, expected no negative number", value));
  return value;
}

/// "2026-06-21T12:00+01:00", seconds allowed, Z for UTC.
void read_time(const JsonItem& item, PlaceAndTime& when) {
  const std::string text = item.text();
  int hour = 0;
  int minute = 0;
  int second = 0;
  int end = 0;
  const auto fail = [&]() {
    item.fail(fmt::format("found \"{}\", expected a time like 2026-06-21T12:00+01:00", text));
  };
  if (std::sscanf(text.c_str(), "%4d-%2d-%2dT%2d:%2d%n", &when.year, &when.month, &when.day, &hour,
                  &minute, &end) != 5) {
    fail();
  }
  std::string zone = text.substr(static_cast<std::size_t>(end));
  if (std::sscanf(zone.c_str(), ":%2d%n", &second, &end) == 1) {
    zone = zone.substr(static_cast<std::size_t>(end));
  }
  char sign = '+';
  int zone_hours = 0;
  int zone_minutes = 0;
  end = 0;
  if (zone != "Z" &&
      (std::sscanf(zone.c_str(), "%c%2d:%2d%n", &sign, &zone_hours, &zone_minutes, &end) != 3 ||
       static_cast<std::size_t>(end) != zone.size() || (sign != '+' && sign != '-'))) {
    fail();
  }
  const std::chrono::year_month_day date(std::chrono::year(when.year),
                                         std::chrono::month(static_cast<unsigned>(when.month)),
                                         std::chrono::day(static_cast<unsigned>(when.day)));
  if (when.year < 1901 || when.year > 2099 || !date.ok() || hour < 0 || hour > 24 || minute < 0 ||
      minute > 59 || second < 0 || second > 60) {
    fail();
  }
  const double ahead = (sign == '-' ? -1 : 1) * (zone_hours + zone_minutes / 60.);
  when.hour = hour + minute / 60. + second / 3600. - ahead;
}

/// Where the sun stands by what the sky says itself, towards it; none if it says nothing.
std::optional<Vec3> own_sun(const JsonItem& item, const Compass& compass) {
  const bool has_angles = item.has("azimuth_deg") || item.has("elevation_deg");
  const bool has_place = item.has("latitude") || item.has("longitude") || item.has("time");
  if (int(has_angles) + int(has_place) + int(item.has("direction")) > 1) {
    item.fail(
        "expected one of \"direction\", \"azimuth_deg\" with \"elevation_deg\", and \"latitude\", "
        "\"longitude\" and \"time\"");
  }
  if (const auto direction = item.find("direction")) return Vec3(-direction->direction());
  if (has_angles) {
    const double azimuth = item.at("azimuth_deg").number() * kDegree;
    const double elevation = between(item.at("elevation_deg"), -90, 90) * kDegree;
    return Vec3(-radiosity::sun_direction(azimuth, elevation, compass.up, compass.north));
  }
  if (!has_place) return std::nullopt;
  PlaceAndTime when;
  when.latitude = between(item.at("latitude"), -90, 90) * kDegree;
  when.longitude = between(item.at("longitude"), -180, 180) * kDegree;
  read_time(item.at("time"), when);
  const radiosity::SolarPosition sun = radiosity::solar_position(when);
  return Vec3(-radiosity::sun_direction(sun.azimuth, sun.elevation, compass.up, compass.north));
}

double elevation_of(const Sky& sky) {
  return std::asin(std::clamp(sky.up.dot(sky.towards_sun), -1., 1.));
}

void require_day(const JsonItem& item, const Sky& sky) {
  const double elevation = elevation_of(sky);
  if (elevation > 0) return;
  item.fail(
      fmt::format("the sun is not above the horizon (elevation {:.2f} degrees), and this sky "
                  "depends on it",
                  elevation / kDegree));
}

/// The sky's own sun, or the scene's, or the zenith where it does not matter.
void place_sun(const JsonItem& item, const std::optional<Vec3>& own, const Scene& scene, Sky& sky) {
  if (own && scene.sun) item.fail("says where the sun is, and the scene has a \"sun\" that does");
  if (own) {
    sky.towards_sun = *own;
  } else if (scene.sun) {
    sky.towards_sun = -scene.sun->direction;
  } else if (sky.distribution.needs_sun()) {
    item.fail(
        "depends on the sun: expected \"azimuth_deg\" and \"elevation_deg\", or \"latitude\", "
        "\"longitude\" and \"time\", or a \"sun\" of the scene");
  } else {
    sky.towards_sun = sky.up;
  }
  if (sky.distribution.needs_sun() || own) require_day(item, sky);
}

SkyDistribution read_distribution(const JsonItem& item) {
  item.check_keys(keys::kDistribution);
  const std::string form = item.at("form").text();
  SkyDistribution result;
  if (form == "overcast") return {.kind = SkyDistribution::Kind::overcast};
  if (form != "cie" && form != "perez") {
    item.at("form").fail(
        fmt::format("found \"{}\", expected \"cie\", \"perez\" or \"overcast\"", form));
  }
  if (form == "perez") result.kind = SkyDistribution::Kind::perez;
  result.a = item.at("a").number();
  result.b = item.at("b").number();
  result.c = item.at("c").number();
  result.d = item.at("d").number();
  result.e = item.at("e").number();
  if (!(result.b <= 0)) item.at("b").fail("is above 0: the horizon would be infinitely bright");
  return result;
}

SkyDistribution read_type(const JsonItem& item) {
  const double type = item.number();
  if (!(type >= 1 && type <= 16 && type == std::floor(type))) {
    item.fail(fmt::format("is {}, expected a type of CIE sky, 1 to 16 (ISO 15469)", type));
  }
  return radiosity::cie_sky(static_cast<int>(type));
}

/// L_z from one of the keys that tell how bright the sky is.
void read_amount(const JsonItem& item, const std::filesystem::path& folder, const Bands& bands,
                 Sky& sky) {
  std::string_view found;
  for (const std::string_view key : kAmounts) {
    if (!item.has(key)) continue;
    if (!found.empty()) item.fail(fmt::format("has both \"{}\" and \"{}\"", found, key));
    found = key;
  }
  if (found.empty()) item.fail(fmt::format("expected one of {}", fmt::join(kAmounts, ", ")));
  const JsonItem amount = item.at(found);
  const bool is_photometric = found == kAmounts[2] || found == kAmounts[3];
  sky.zenith_radiance = is_photometric ? of_white_light(amount, not_negative(amount), bands)
                                       : read_sunlight(amount, std::string(found), bands, folder);
  if (found == kAmounts[1] || found == kAmounts[3]) {
    sky.zenith_radiance /= radiosity::horizontal_ratio(sky);
  }
  constexpr double kBrightest = 1e100;  // beyond which products are no numbers any more
  if (sky.zenith_radiance.maxCoeff() > kBrightest) {
    amount.fail(fmt::format("makes a zenith of {:g} W/(m² sr), expected at most {:g}",
                            sky.zenith_radiance.maxCoeff(), kBrightest));
  }
}

/// What is measured below an all-weather sky.
struct Measured {
  double direct = 0;   // normal, W/m²
  double diffuse = 0;  // horizontal, W/m²
  Eigen::VectorXd direct_bands;
  Eigen::VectorXd diffuse_bands;
};

/// Perez' sky, and the sun that goes with it.
void set_all_weather(const JsonItem& item, const Measured& weather, double extraterrestrial,
                     Scene& scene, Sky& sky) {
  if (scene.sun) item.fail("brings its own sun, and the scene has a \"sun\"");
  require_day(item, sky);
  if (!(weather.diffuse > 0)) item.fail("needs diffuse light: expected more than 0 W/m²");
  const double zenith = kPi / 2 - elevation_of(sky);
  sky.distribution = radiosity::perez_sky(
      radiosity::sky_clearness(weather.diffuse, weather.direct, zenith),
      radiosity::sky_brightness(weather.diffuse, zenith, extraterrestrial), zenith);
  if (!(sky.value_at_zenith() > 0)) {
    item.fail("the all-weather sky of these values is dark at its zenith; they are no weather's");
  }
  sky.zenith_radiance = weather.diffuse_bands / radiosity::horizontal_ratio(sky);
  scene.sun = radiosity::Sun{.direction = -sky.towards_sun, .irradiance = weather.direct_bands};
}

void read_perez(const JsonItem& item, const std::optional<Vec3>& own, Scene& scene, Sky& sky) {
  item.check_keys(keys::kPerez);
  if (!own) item.fail("needs the sun: expected its angles, or a place and a time, in the sky");
  sky.towards_sun = *own;
  Measured weather;
  weather.direct = not_negative(item.at("direct_normal"));
  weather.diffuse = not_negative(item.at("diffuse_horizontal"));
  const Eigen::VectorXd shares = shares_of_sun(scene.bands);
  const auto in_bands = [&](const char* key, double radiometric) -> Eigen::VectorXd {
    if (const auto lux = item.find(key)) {
      return of_white_light(*lux, not_negative(*lux), scene.bands);
    }
    return radiometric * shares;
  };
  weather.direct_bands = in_bands("direct_normal_illuminance", weather.direct);
  weather.diffuse_bands = in_bands("diffuse_horizontal_illuminance", weather.diffuse);
  constexpr double kSolarConstant = 1367;  // W/m²; the day of the year moves it by 3 %
  set_all_weather(item, weather, kSolarConstant, scene, sky);
}

double required(const JsonItem& item, const std::optional<double>& value, const char* name) {
  if (!value) item.fail(fmt::format("that hour has no {} (\"missing\")", name));
  return *value;
}

void read_weather(const JsonItem& item, const std::filesystem::path& folder, const Compass& compass,
                  Scene& scene, Sky& sky) {
  item.check_keys(keys::kWeather);
  const std::filesystem::path path = folder / item.at("file").text();
  const int month = whole_between(item.at("month"), 1, 12);
  const int day = whole_between(item.at("day"), 1, 31);
  const int hour = whole_between(item.at("hour"), 1, 24);
  const WeatherYear year = read_epw(path);
  scene.files.push_back(path);
  scene.warnings.insert(scene.warnings.end(), year.warnings.begin(), year.warnings.end());
  const WeatherHour* there = year.find(month, day, hour);
  if (there == nullptr) {
    item.fail(
        fmt::format("{} has no hour {} of {}/{} (month/day)", path.string(), hour, month, day));
  }
  PlaceAndTime when{.latitude = year.latitude * kDegree,
                    .longitude = year.longitude * kDegree,
                    .month = month,
                    .day = day,
                    .hour = hour - 0.5 - year.time_zone};
  const radiosity::SolarPosition sun = radiosity::solar_position(when);
  sky.towards_sun =
      -radiosity::sun_direction(sun.azimuth, sun.elevation, compass.up, compass.north);
  Measured weather;
  weather.direct = required(item, there->direct_normal, "direct normal radiation");
  weather.diffuse = required(item, there->diffuse_horizontal, "diffuse horizontal radiation");
  if (scene.bands.kind == Bands::Kind::rgb) {  // of the light that is seen
    weather.direct_bands = of_white_light(
        item, required(item, there->direct_normal_illuminance, "direct normal illuminance"),
        scene.bands);
    weather.diffuse_bands = of_white_light(
        item,
        required(item, there->diffuse_horizontal_illuminance, "diffuse horizontal illuminance"),
        scene.bands);
  } else {
    weather.direct_bands = weather.direct * shares_of_sun(scene.bands);
    weather.diffuse_bands = weather.diffuse * shares_of_sun(scene.bands);
  }
  set_all_weather(
      item, weather,
      radiosity::extraterrestrial_irradiance(radiosity::day_of_year(when.year, month, day)), scene,
      sky);
}

}  // namespace

void read_sky(const JsonItem& item, const std::filesystem::path& folder, Scene& scene) {
  item.check_keys(keys::kSky);
  if (scene.environment.kind != radiosity::Emission::Kind::none) {
    item.fail("the scene has an \"environment\", which is where the sky would be");
  }
  const bool is_weather = item.has("perez") || item.has("weather");
  if (int(item.has("type")) + int(item.has("distribution")) + int(item.has("perez")) +
          int(item.has("weather")) !=
      1) {
    item.fail("expected one of type, distribution, perez, weather");
  }
  const Compass compass = read_compass(item);
  Sky sky;
  sky.up = compass.up;
  if (item.has("north")) sky.north = compass.north;
  sky.ground_reflectance = Eigen::VectorXd::Constant(scene.bands.count(), kUsualGround);
  if (const auto ground = item.find("ground_reflectance")) {
    sky.ground_reflectance = read_reflectances(*ground, scene.bands, folder);
  }
  const std::optional<Vec3> own = own_sun(item, compass);
  if (is_weather) {
    for (const std::string_view key : kAmounts) {
      if (item.has(key)) item.at(key).fail("does not go with a sky of measured weather");
    }
  }
  if (const auto perez = item.find("perez")) {
    read_perez(*perez, own, scene, sky);
  } else if (const auto weather = item.find("weather")) {
    if (own) item.fail("\"weather\" tells itself where the sun is");
    read_weather(*weather, folder, compass, scene, sky);
  } else {
    const auto type = item.find("type");
    sky.distribution = type ? read_type(*type) : read_distribution(item.at("distribution"));
    place_sun(item, own, scene, sky);
    if (!(sky.value_at_zenith() > 0)) item.fail("is dark at its zenith");
    read_amount(item, folder, scene.bands, sky);
  }
  scene.sky = sky;
}

}  // namespace io
