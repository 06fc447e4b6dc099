#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>

#include "radiosity/base/geometry.h"

namespace viewer {

/// A value of a report; null if it is no finite number.
nlohmann::json number(double value);
nlohmann::json list(const Eigen::VectorXd& values);
nlohmann::json list(const radiosity::Vec3& values);

}  // namespace viewer
