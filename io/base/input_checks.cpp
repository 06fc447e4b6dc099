#include "io/base/input_checks.h"

#include <fmt/format.h>

#include <cmath>

namespace io {

std::optional<std::string> reflectance_problem(const Eigen::VectorXd& reflectance) {
  for (const double value : reflectance) {
    if (!(value >= 0 && value <= 1)) {
      return fmt::format("reflectance {} is outside [0, 1]", value);
    }
  }
  return std::nullopt;
}

std::optional<std::string> emission_problem(const std::string& name, const Eigen::VectorXd& value) {
  for (const double v : value) {
    if (!(std::isfinite(v) && v >= 0)) {
      return fmt::format("{} is {}, expected a finite number that is not negative", name, v);
    }
  }
  return std::nullopt;
}

std::optional<std::string> face_problem(std::span<const std::int64_t> indices,
                                        std::int64_t n_vertices) {
  if (indices.size() < 3) {
    return fmt::format("face has {} vertices, expected at least 3", indices.size());
  }
  return index_problem(indices, n_vertices);
}

std::optional<std::string> index_problem(std::span<const std::int64_t> indices,
                                         std::int64_t n_vertices) {
  for (const std::int64_t index : indices) {
    if (index < 0 || index >= n_vertices) {
      return fmt::format("face uses vertex {}, but there are {}, counted from 0", index,
                         n_vertices);
    }
  }
  return std::nullopt;
}

}  // namespace io
