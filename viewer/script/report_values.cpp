#include "viewer/script/report_values.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace viewer {

using nlohmann::json;

json number(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

json list(const Eigen::VectorXd& values) {
  json result = json::array();
  for (const double value : values) result.push_back(number(value));
  return result;
}

json list(const radiosity::Vec3& values) { return list(Eigen::VectorXd(values)); }

}  // namespace viewer
