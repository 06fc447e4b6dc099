#include "radiosity/operator/column_basis.h"

#include <cmath>

#include "radiosity/base/parallel.h"

namespace radiosity {
namespace {

using Values = Eigen::Ref<const Eigen::MatrixXd>;

/// uᵀ v.
Eigen::MatrixXd inner_products(const Values& u, const Values& v) {
  return parallel_sum(u.rows(), Eigen::MatrixXd::Zero(u.cols(), v.cols()).eval(),
                      [&](Index begin, Index n) -> Eigen::MatrixXd {
                        return u.middleRows(begin, n).transpose() * v.middleRows(begin, n);
                      });
}

/// Euclidean norms of the columns.
Eigen::VectorXd column_norms(const Values& x) {
  const Eigen::VectorXd squares =
      parallel_sum(x.rows(), Eigen::VectorXd::Zero(x.cols()).eval(),
                   [&](Index begin, Index n) -> Eigen::VectorXd {
                     return x.middleRows(begin, n).colwise().squaredNorm().transpose();
                   });
  return squares.cwiseSqrt();
}

/// What of each column is no combination of those that stand out more can be told from products of
/// columns, down to this share of it: in double precision these lose half the digits.
constexpr double kToldShare = 1e-6;

/// At least how many columns a basis needs, of columns with these products, if each may be off by
/// `tolerance` (Cholesky's decomposition with pivoting).
Index least_rank(Eigen::MatrixXd products, const Eigen::VectorXd& tolerance) {
  const Eigen::VectorXd least =
      tolerance.cwiseMax(kToldShare * products.diagonal().cwiseMax(0).cwiseSqrt()).cwiseAbs2();
  for (Index rank = 0; rank < products.cols(); ++rank) {
    Index pivot = -1;
    double most = 1;
    for (Index c = 0; c < products.cols(); ++c) {
      if (least[c] > 0 && products(c, c) > most * least[c]) {
        most = products(c, c) / least[c];
        pivot = c;
      }
    }
    if (pivot < 0) return rank;
    const Eigen::VectorXd column = products.col(pivot) / std::sqrt(products(pivot, pivot));
    products -= column * column.transpose();
  }
  return products.cols();
}

}  // namespace

Eigen::VectorXd energy_norms(const Transport& transport, const Eigen::MatrixXd& x) {
  const Eigen::VectorXd squares = parallel_sum(
      x.rows(), Eigen::VectorXd::Zero(x.cols()).eval(),
      [&](Index begin, Index n) -> Eigen::VectorXd {
        return x.middleRows(begin, n).cwiseAbs2().transpose() * transport.area().segment(begin, n);
      });
  return squares.cwiseSqrt();
}

Eigen::MatrixXd apply_by_basis(const Transport& transport, Eigen::MatrixXd x,
                               const Eigen::VectorXd& tolerance) {
  constexpr Index kFewColumns = 8;
  constexpr double kWorthwhile = 0.6;
  if (x.cols() < kFewColumns) return transport.apply(x);

  // Scaled so that the energy norm is the Euclidean one and each column may be off by 1. `rest` is
  // what is no combination of the basis yet; copies of many columns cost more than sums of them.
  const Eigen::VectorXd root_area = transport.area().cwiseSqrt();
  const Eigen::VectorXd scale =
      (tolerance.array() > 0).select(tolerance.cwiseInverse(), 0).matrix();
  const auto multiply = [&](Eigen::MatrixXd& values, const Eigen::VectorXd& factors) {
    parallel_segments(values.rows(), [&](Index begin, Index n) {
      values.middleRows(begin, n).array().colwise() *= factors.segment(begin, n).array();
    });
  };
  Eigen::MatrixXd& rest = x;
  multiply(rest, root_area);
  // A basis goes through all columns for each of its own.
  if (static_cast<double>(least_rank(inner_products(rest, rest), tolerance)) >
      kWorthwhile * static_cast<double>(x.cols())) {
    multiply(rest, root_area.cwiseInverse());
    return transport.apply(rest);
  }
  Eigen::MatrixXd basis(x.rows(), x.cols());
  Eigen::MatrixXd coordinates(x.cols(), x.cols());
  Eigen::VectorXd norms = column_norms(rest);
  Index rank = 0;
  for (; rank < x.cols(); ++rank) {
    Index pivot = 0;
    if (norms.cwiseProduct(scale).maxCoeff(&pivot) <= 1) break;
    Eigen::Ref<Eigen::VectorXd> direction = basis.col(rank);
    parallel_segments(x.rows(), [&](Index begin, Index n) {
      direction.segment(begin, n) = rest.col(pivot).segment(begin, n) / norms[pivot];
    });
    // Rounding tilts what is left of a column towards the basis.
    const Eigen::VectorXd tilt = inner_products(basis.leftCols(rank), direction);
    parallel_segments(x.rows(), [&](Index begin, Index n) {
      direction.segment(begin, n) -= basis.leftCols(rank).middleRows(begin, n) * tilt;
    });
    const double length = column_norms(direction)[0];
    parallel_segments(x.rows(),
                      [&](Index begin, Index n) { direction.segment(begin, n) /= length; });
    coordinates.row(rank) = inner_products(direction, rest);
    parallel_segments(x.rows(), [&](Index begin, Index n) {
      rest.middleRows(begin, n).noalias() -= direction.segment(begin, n) * coordinates.row(rank);
    });
    norms = column_norms(rest);
  }
  basis.conservativeResize(Eigen::NoChange, rank);
  multiply(basis, root_area.cwiseInverse());
  const Eigen::MatrixXd gathered = transport.apply(basis);
  parallel_segments(x.rows(), [&](Index begin, Index n) {
    x.middleRows(begin, n).noalias() = gathered.middleRows(begin, n) * coordinates.topRows(rank);
  });
  return x;
}

}  // namespace radiosity
