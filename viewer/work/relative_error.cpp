#include "viewer/work/relative_error.h"

#include <algorithm>
#include <cmath>

namespace viewer {

std::optional<double> relative_error(const radiosity::PatchMesh& mesh,
                                     const radiosity::Solution& solution) {
  if (solution.radiosity_error.size() == 0) return std::nullopt;
  const Eigen::Map<const Eigen::VectorXd> area(mesh.area.data(), mesh.size());
  double largest = 0;
  bool is_lit = false;
  for (radiosity::Index b = 0; b < solution.radiosity.cols(); ++b) {
    const double light = area.dot(solution.radiosity.col(b).cwiseAbs2());
    if (!(light > 0)) continue;
    is_lit = true;
    largest = std::max(largest, area.dot(solution.radiosity_error.col(b).cwiseAbs2()) / light);
  }
  if (!is_lit) return std::nullopt;
  return 2 * std::sqrt(largest);
}

}  // namespace viewer
