#pragma once

#include "radiosity/assembly/exchange_tile.h"
#include "radiosity/base/geometry.h"
#include "radiosity/operator/transport.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/visibility.h"

namespace radiosity {

/// The report of finished tiles: census, row sums and how far they are from 1. `row_sums` are
/// Σ_j G_ij, m², by row; `areas` those of the patches, m²; `covered` the shares of these that are.
AssemblyReport make_report(const Census& census, const Eigen::VectorXd& row_sums,
                           const std::vector<std::int32_t>& order, const std::vector<double>& areas,
                           const Eigen::VectorXd& covered);

/// Adds what of the power that reaches no front meets backs, and which of `open_rows`, of the
/// rows, miss more than that. `row_sums` are Σ_j G_ij after any correction, m², by row.
void find_backs(const PatchMesh& mesh, const Visibility& visibility,
                const std::vector<std::int32_t>& order, const Eigen::VectorXd& row_sums,
                const std::vector<Index>& open_rows, std::uint64_t seed, AssemblyReport& report);

}  // namespace radiosity
