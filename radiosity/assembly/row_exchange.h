#pragma once

#include <Eigen/Core>

#include "radiosity/assembly/exchange_matrix.h"
#include "radiosity/base/geometry.h"
#include "radiosity/base/progress.h"
#include "radiosity/operator/patch_order.h"
#include "radiosity/operator/shared_rows.h"

namespace radiosity {

/// SharedRows::visit_share of a matrix whose tiles several ranks keep: each sends of the others'
/// rows what it has, so that each entry goes to one rank. `order` is that of the matrix' rows,
/// `area` is by patches, m². Holds so many rows at a time that all threads have work.
void visit_row_share(const ExchangeMatrix& tiles, const PatchOrder& order,
                     const Eigen::VectorXd& area, Index block, const Progress& progress,
                     const SharedRows::Visitor& visit);

/// SharedRows::complete.
void complete_rows(Ranks& ranks, Index block, Eigen::MatrixXd& values);

}  // namespace radiosity
