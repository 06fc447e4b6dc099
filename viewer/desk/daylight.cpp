#include "viewer/desk/daylight.h"

#include <array>
#include <cmath>
#include <stdexcept>

#include "radiosity/base/error.h"
#include "radiosity/solve/quantity.h"
#include "radiosity/visibility/sky_light.h"

namespace viewer {
namespace {

using radiosity::kPi;
using radiosity::Sky;
using radiosity::Vec3;

constexpr int kSkyTypes = 16;
/// ISO 15469:2004, table 1.
constexpr std::array<const char*, kSkyTypes> kTypeNames = {
    "1 overcast, steep, brighter towards the sun",
    "2 overcast, steep, even around",
    "3 overcast, moderate, brighter towards the sun",
    "4 overcast, moderate, even around",
    "5 uniform",
    "6 partly cloudy, even, brighter towards the sun",
    "7 partly cloudy, brighter about the sun",
    "8 partly cloudy, distinct corona",
    "9 partly cloudy, obscured sun",
    "10 partly cloudy, brighter about the sun",
    "11 white-blue, distinct corona",
    "12 clear, low turbidity",
    "13 clear, polluted",
    "14 cloudless, turbid, broad corona",
    "15 white-blue turbid, broad corona",
    "16 traditional overcast"};

Vec3 up_of(const Desk& desk) {
  const std::optional<Sky>& sky = desk.session.mix().sky;
  return sky ? sky->up : up_direction(desk.up);
}

bool is_same(const radiosity::SkyDistribution& a, const radiosity::SkyDistribution& b) {
  return a.kind == b.kind && a.a == b.a && a.b == b.b && a.c == b.c && a.d == b.d && a.e == b.e;
}

/// The same E_h by another distribution, or with the sun elsewhere.
Sky with_same_illuminance(Sky changed, const Sky& before) {
  const double factor = radiosity::horizontal_ratio(before) / radiosity::horizontal_ratio(changed);
  changed.zenith_radiance = factor * before.zenith_radiance;
  return changed;
}

}  // namespace

std::optional<SunPlace> sun_place(const Desk& desk) {
  const LightMix& mix = desk.session.mix();
  if (!mix.sun && !mix.sky) return std::nullopt;
  const Vec3 towards = mix.sun ? Vec3(-mix.sun->direction) : mix.sky->towards_sun;
  const Vec3 up = up_of(desk);
  const Vec3 north = radiosity::usual_north(up);
  const Vec3 east = north.cross(up);
  double azimuth = std::atan2(towards.dot(east), towards.dot(north));
  if (azimuth < 0) azimuth += 2 * kPi;
  return SunPlace{azimuth, std::asin(std::clamp(towards.dot(up), -1.0, 1.0))};
}

void set_sun_place(Desk& desk, const SunPlace& place) {
  if (!(place.elevation > 0 && place.elevation <= kPi / 2) || !std::isfinite(place.azimuth)) {
    throw std::out_of_range("the sun must be above the horizon");
  }
  std::optional<radiosity::Sun> sun = desk.session.mix().sun;
  std::optional<Sky> sky = desk.session.mix().sky;
  if (!sun && !sky) throw radiosity::SceneError("the scene has neither a sun nor a sky");
  const Vec3 up = up_of(desk);
  const Vec3 direction =
      radiosity::sun_direction(place.azimuth, place.elevation, up, radiosity::usual_north(up));
  if (sun) sun->direction = direction;
  if (sky && sky->distribution.needs_sun()) {
    Sky changed = *sky;
    changed.towards_sun = -direction;
    sky = with_same_illuminance(changed, *sky);
  } else if (sky) {
    sky->towards_sun = -direction;
  }
  desk.session.set_daylight(sun, sky);
}

void set_sun_time(Desk& desk, const radiosity::PlaceAndTime& when) {
  const radiosity::SolarPosition found = radiosity::solar_position(when);
  set_sun_place(desk, {found.azimuth, found.elevation});
}

std::optional<int> sky_type(const Desk& desk) {
  const std::optional<Sky>& sky = desk.session.mix().sky;
  for (int type = 1; sky && type <= kSkyTypes; ++type) {
    if (is_same(sky->distribution, radiosity::cie_sky(type))) return type;
  }
  return std::nullopt;
}

void set_sky_type(Desk& desk, int type) {
  const std::optional<Sky>& sky = desk.session.mix().sky;
  if (!sky) throw radiosity::SceneError("the scene has no sky");
  Sky changed = *sky;
  changed.distribution = radiosity::cie_sky(type);
  desk.session.set_daylight(desk.session.mix().sun, with_same_illuminance(changed, *sky));
}

const char* sky_type_name(int type) { return kTypeNames.at(static_cast<std::size_t>(type - 1)); }

std::optional<double> sky_illuminance(const Desk& desk) {
  const LightMix& mix = desk.session.mix();
  if (!mix.sky || desk.session.is_thermal()) return std::nullopt;
  double factor = 1;
  for (const Emitter& emitter : mix.emitters) {
    if (emitter.kind == Emitter::Kind::sky) factor = emitter.factor();
  }
  const Eigen::VectorXd weights = radiosity::luminous_weights(desk.session.model().bands);
  return factor * weights.dot(radiosity::horizontal_irradiance(*mix.sky));
}

}  // namespace viewer
