#pragma once

#include <Eigen/Core>

#include "radiosity/exchange_tiles.h"

namespace radiosity {

/// What the closure correction did.
struct ClosureCorrection {
  Index n_open_rows = 0;  ///< rows too far from closed to be sampling error; left as they are
};

/// Whether every row sum equals its area (m²) within what the entries' errors explain.
bool is_closed_within_errors(const ExchangeTiles& tiles, const Eigen::VectorXd& row_sums,
                             const Eigen::VectorXd& areas);

/// Changes the uncertain entries so that each row sums to its area, m²: the symmetric change of
/// least weighted squares Σ (ΔG_ij/σ_ij)², which is ΔG_ij = σ_ij² (μ_i + μ_j). Certain entries and
/// rows whose deficit no sampling error explains stay as they are. (van Leersum 1989, weighted)
ClosureCorrection correct_closure(ExchangeTiles& tiles, const Eigen::VectorXd& row_sums,
                                  const Eigen::VectorXd& areas);

}  // namespace radiosity
