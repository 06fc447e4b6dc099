#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "study/study.h"

namespace python {

/// Sky, external and internal component of daylight factors and the bound on their quadrature, by
/// the form factors of a study, n x 4. `points` and `normals` are n x 3.
Eigen::MatrixXd daylight_factors(const study::Study& study, const study::StudyOptions& options,
                                 const Eigen::MatrixXd& points, const Eigen::MatrixXd& normals,
                                 const std::vector<std::string>& outdoors, double efficacy,
                                 const study::StudyEvents& events);

}  // namespace python
