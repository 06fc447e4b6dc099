#include "radiosity/operator/column_basis.h"

namespace radiosity {

Eigen::VectorXd energy_norms(const Transport& transport, const Eigen::MatrixXd& x) {
  return (x.cwiseAbs2().transpose() * transport.area()).cwiseSqrt();
}

Eigen::MatrixXd apply_by_basis(const Transport& transport, Eigen::MatrixXd x,
                               const Eigen::VectorXd& tolerance) {
  constexpr Index kFewColumns = 8;
  if (x.cols() < kFewColumns) return transport.apply(x);

  // Scaled so that the energy norm is the Euclidean one and each column may be off by 1. `rest` is
  // what is no combination of the basis yet; copies of many columns cost more than sums of them.
  const Eigen::VectorXd root_area = transport.area().cwiseSqrt();
  const Eigen::VectorXd scale =
      (tolerance.array() > 0).select(tolerance.cwiseInverse(), 0).matrix();
  Eigen::MatrixXd& rest = x;
  rest.array().colwise() *= root_area.array();
  Eigen::MatrixXd basis(x.rows(), x.cols());
  Eigen::MatrixXd coordinates(x.cols(), x.cols());
  Index rank = 0;
  for (; rank < x.cols(); ++rank) {
    Index pivot = 0;
    const Eigen::VectorXd norms = rest.colwise().norm().transpose();
    if (norms.cwiseProduct(scale).maxCoeff(&pivot) <= 1) break;
    Eigen::VectorXd direction = rest.col(pivot) / norms[pivot];
    // Rounding tilts what is left of a column towards the basis.
    direction -= basis.leftCols(rank) * (basis.leftCols(rank).transpose() * direction);
    direction.normalize();
    basis.col(rank) = direction;
    coordinates.row(rank) = direction.transpose() * rest;
    rest.noalias() -= direction * coordinates.row(rank);
  }
  const Eigen::MatrixXd gathered =
      transport.apply(root_area.cwiseInverse().asDiagonal() * basis.leftCols(rank));
  x.noalias() = gathered * coordinates.topRows(rank);
  return x;
}

}  // namespace radiosity
