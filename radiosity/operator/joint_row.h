#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "radiosity/operator/factor_rows.h"
#include "radiosity/operator/transport.h"

namespace radiosity {

/// The form factors from some patches, taken together, to each patch: F_Sj = Σ_{i in S} A_i F_ij /
/// Σ_{i in S} A_i.
struct JointRow {
  Eigen::VectorXd factor;  ///< n
  Eigen::VectorXd error;   ///< one standard error of each, n; 0 where it is certified
};

/// Of rows that are at hand; `area` of all patches, m², n. Errors of the patches are taken as
/// independent.
JointRow joint_row(const FactorRows& rows, const Eigen::VectorXd& area,
                   const std::vector<std::int32_t>& patches);

/// Of an operator: by its rows if they are at hand, else by one product, since A_S F_Sj = A_j F_jS.
JointRow joint_row(const Transport& transport, const std::vector<std::int32_t>& patches);

}  // namespace radiosity
