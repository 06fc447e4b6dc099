#include "io/scene/json_sun.h"

#include <fmt/format.h>

#include <string_view>

#include "io/scene/json_materials.h"
#include "io/scene/scene_keys.h"
#include "radiosity/scene/black_body.h"

namespace io {
namespace {

using radiosity::kPi;
using radiosity::Scene;
using radiosity::Vec3;

/// Sine of the angle between `up` and `north` below which the latter says nothing.
constexpr double kNorthIsUp = 1e-6;

Vec3 read_angles(const JsonItem& item, Scene& scene) {
  const double azimuth = item.at("azimuth_deg").number();
  const JsonItem elevation = item.at("elevation_deg");
  const double height = elevation.number();
  if (!(height >= -90 && height <= 90)) {
    elevation.fail(fmt::format("{} is outside [-90, 90]", height));
  }
  if (height <= 0) {
    scene.warnings.push_back(
        fmt::format("{}: the sun is not above the horizon (elevation_deg {}): it shines from {}",
                    scene.source, height, height < 0 ? "below" : "the side"));
  }
  const Compass compass = read_compass(item);
  return radiosity::sun_direction(azimuth * kPi / 180, height * kPi / 180, compass.up,
                                  compass.north);
}

Vec3 read_sun_direction(const JsonItem& item, Scene& scene) {
  const bool has_angles = item.has("azimuth_deg") || item.has("elevation_deg");
  if (item.has("direction") == has_angles) {
    item.fail("expected either \"direction\" or \"azimuth_deg\" and \"elevation_deg\"");
  }
  if (has_angles) return read_angles(item, scene);
  for (const std::string_view key : {"up", "north"}) {
    if (item.has(key)) {
      item.at(key).fail("goes with \"azimuth_deg\" and \"elevation_deg\" only");
    }
  }
  return item.at("direction").direction();
}

}  // namespace

Eigen::VectorXd shares_of_sun(const radiosity::Bands& bands) {
  switch (bands.kind) {
    case radiosity::Bands::Kind::solar_infrared:
      return Eigen::Vector2d(1, 0);
    case radiosity::Bands::Kind::thermal:
      return radiosity::thermal_fractions(bands, radiosity::kSunTemperature);
    default:
      return Eigen::VectorXd::Ones(bands.count());
  }
}

Compass read_compass(const JsonItem& item) {
  const auto up_item = item.find("up");
  const Vec3 up = up_item ? up_item->direction() : Vec3(0, 0, 1);
  const auto north_item = item.find("north");
  const Vec3 north = north_item ? north_item->direction() : radiosity::usual_north(up);
  if (north_item && !(up.cross(north).norm() > kNorthIsUp)) {
    north_item->fail("is parallel to \"up\"");
  }
  return {up, north};
}

Eigen::VectorXd read_sunlight(const JsonItem& item, const std::string& name,
                              const radiosity::Bands& bands, const std::filesystem::path& folder) {
  Eigen::VectorXd values = read_band_values(item, name, bands, folder);
  if (item.value().is_number()) values.array() *= shares_of_sun(bands).array();
  return values;
}

void read_sun(const JsonItem& item, const std::filesystem::path& folder, Scene& scene) {
  item.check_keys(keys::kSun);
  radiosity::Sun sun;
  sun.direction = read_sun_direction(item, scene);
  sun.irradiance = read_sunlight(item.at("irradiance"), "irradiance", scene.bands, folder);
  scene.sun = sun;
}

}  // namespace io
