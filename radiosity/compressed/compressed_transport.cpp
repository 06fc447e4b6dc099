#include "radiosity/compressed/compressed_transport.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace radiosity {

CompressedTransport::CompressedTransport(Parts parts)
    : parts_(std::move(parts)), matrix_(std::move(parts_.blocks)) {
  place_.resize(parts_.order.size());
  for (std::size_t row = 0; row < parts_.order.size(); ++row) {
    place_[parts_.order[row]] = static_cast<std::int32_t>(row);
  }
}

Eigen::MatrixXd CompressedTransport::to_tree(const Eigen::MatrixXd& x) const {
  return x(parts_.order, Eigen::all);
}

Eigen::MatrixXd CompressedTransport::from_tree(const Eigen::MatrixXd& x) const {
  Eigen::MatrixXd result(x.rows(), x.cols());
  result(parts_.order, Eigen::all) = x;
  return result;
}

Eigen::MatrixXd CompressedTransport::apply(const Eigen::MatrixXd& radiosity) const {
  Eigen::MatrixXd power = radiosity;
  power.array().colwise() *= parts_.area.array();
  power = to_tree(power);
  Eigen::MatrixXd gathered = matrix_.product(power);
  if (parts_.multipliers.size() > 0) {
    const auto& mu = parts_.multipliers.array();
    gathered.array() += matrix_.variance_product(power).array().colwise() * mu;
    power.array().colwise() *= mu;
    gathered += matrix_.variance_product(power);
  }
  Eigen::MatrixXd result = from_tree(gathered);
  for (const Parts::Source& source : parts_.sources) add_lacking(source, radiosity, result);
  return result;
}

/// (r vᵀ + v rᵀ - (Σ_s r) v vᵀ) x / A
void CompressedTransport::add_lacking(const Parts::Source& source, const Eigen::MatrixXd& x,
                                      Eigen::MatrixXd& result) const {
  double area = 0;
  double own = 0;
  Eigen::RowVectorXd mean = Eigen::RowVectorXd::Zero(x.cols());
  for (const std::int32_t j : source.patches) {
    area += parts_.area[j];
    own += source.lacking[j];
    mean += parts_.area[j] * x.row(j);
  }
  mean /= area;
  const Eigen::RowVectorXd back = (source.lacking.transpose() * x - own * mean) / area;
  result += source.lacking.cwiseQuotient(parts_.area) * mean;
  for (const std::int32_t j : source.patches) result.row(j) += back;
}

Eigen::MatrixXd CompressedTransport::apply_error(const Eigen::MatrixXd& radiosity) const {
  Eigen::MatrixXd power = radiosity.cwiseAbs();
  power.array().colwise() *= parts_.area.array();
  return parts_.error_scale * from_tree(matrix_.squared_errors(to_tree(power))).cwiseSqrt();
}

double CompressedTransport::error() const {
  if (size() == 0) return 0;
  return 2 * apply_error(Eigen::VectorXd::Ones(size())).maxCoeff();
}

std::size_t CompressedTransport::bytes() const {
  return matrix_.bytes() + sizeof(double) * (parts_.area.size() + parts_.multipliers.size()) +
         sizeof(double) * parts_.area.size() * parts_.sources.size() +
         sizeof(std::int32_t) * (parts_.order.size() + place_.size());
}

Eigen::VectorXd CompressedTransport::row(Index i) const {
  // F_ij = G_ij / A_i, and G is symmetric.
  Eigen::VectorXd one = Eigen::VectorXd::Zero(size());
  one[i] = 1;
  Eigen::VectorXd result = apply(one);
  result.array() *= parts_.area.array() / parts_.area[i];
  return result;
}

Eigen::VectorXd CompressedTransport::row_error(Index i) const {
  Eigen::VectorXd one = Eigen::VectorXd::Zero(size());
  one[i] = 1;
  Eigen::VectorXd result = apply_error(one);
  result.array() *= parts_.area.array() / parts_.area[i];
  return result;
}

double CompressedTransport::lacking_density(const Parts::Source& source, Index i, Index j) const {
  const auto holds = [&](Index patch) {
    return std::binary_search(source.patches.begin(), source.patches.end(), patch);
  };
  double area = 0;
  double own = 0;
  for (const std::int32_t k : source.patches) {
    area += parts_.area[k];
    own += source.lacking[k];
  }
  const bool has_i = holds(i);
  const bool has_j = holds(j);
  double sum = 0;
  if (has_j) sum += source.lacking[i] / parts_.area[i] / area;
  if (has_i) sum += source.lacking[j] / parts_.area[j] / area;
  if (has_i && has_j) sum -= own / (area * area);
  return sum;
}

ExchangeArea CompressedTransport::pair(Index i, Index j) const {
  auto [density, error, may_change] = matrix_.entry(place_[i], place_[j]);
  if (may_change && parts_.multipliers.size() > 0) {
    density += square(error) * (parts_.multipliers[place_[i]] + parts_.multipliers[place_[j]]);
  }
  const double areas = parts_.area[i] * parts_.area[j];
  for (const Parts::Source& source : parts_.sources) density += lacking_density(source, i, j);
  return {density * areas, parts_.error_scale * error * areas, error == 0};
}

}  // namespace radiosity
