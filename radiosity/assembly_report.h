#pragma once

#include "radiosity/exchange_tile.h"
#include "radiosity/transport.h"

namespace radiosity {

/// The report of finished tiles: census, row sums and how far they are from 1. `row_sums` are
/// Σ_j G_ij, m², by row; `areas` those of the patches, m²; `covered` the shares of these that are.
AssemblyReport make_report(const Census& census, const Eigen::VectorXd& row_sums,
                           const std::vector<std::int32_t>& order,
                           const std::vector<double>& areas, const Eigen::VectorXd& covered);

}  // namespace radiosity
