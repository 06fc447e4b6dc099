#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>

#include "io/base/json_item.h"
#include "radiosity/scene/scene.h"

namespace io {

/// The sun of a scene: the irradiance normal to its beam, one value or one per band, and where it
/// stands, by the direction of its light or by azimuth and elevation. Warns of a sun below the
/// horizon. Throws SceneError naming the item.
void read_sun(const JsonItem& item, const std::filesystem::path& folder, radiosity::Scene& scene);

/// `up` and `north` of an item, unit length, or what is usual.
struct Compass {
  radiosity::Vec3 up;
  radiosity::Vec3 north;
};
Compass read_compass(const JsonItem& item);

/// Sunlight in each band, one value or one per band, at least 0: one value goes to bands of heat as
/// the sun's.
Eigen::VectorXd read_sunlight(const JsonItem& item, const std::string& name,
                              const radiosity::Bands& bands, const std::filesystem::path& folder);
/// What each band has of that which is given by one number.
Eigen::VectorXd shares_of_sun(const radiosity::Bands& bands);

}  // namespace io
