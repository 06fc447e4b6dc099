#pragma once

#include <Eigen/Core>
#include <functional>

#include "radiosity/base/geometry.h"

namespace io {

/// Rows of form factors between the elements of a boundary, one after the other.
struct ElementRows {
  using Visitor = std::function<void(radiosity::Index element, const Eigen::VectorXd& row)>;
  radiosity::Index n_elements = 0;
  std::function<void(const Visitor&)> visit;
};

}  // namespace io
