#include "tests/support/matrix_transport.h"

#include <cmath>
#include <utility>
#include <vector>

namespace radiosity::test {

DenseTestTransport::DenseTestTransport(Eigen::MatrixXd exchange, Eigen::VectorXd area,
                                       Eigen::MatrixXd sigma)
    : exchange_(std::move(exchange)), area_(std::move(area)), sigma_(std::move(sigma)) {
  if (sigma_.size() == 0) sigma_ = Eigen::MatrixXd::Zero(area_.size(), area_.size());
  report_.row_sums = exchange_.rowwise().sum().cwiseQuotient(area_);
}

Eigen::MatrixXd DenseTestTransport::apply(const Eigen::MatrixXd& radiosity) const {
  n_products_ += 1;
  n_columns_ += radiosity.cols();
  return area_.cwiseInverse().asDiagonal() * (exchange_ * radiosity);
}

Eigen::VectorXd DenseTestTransport::row(Index i) const { return exchange_.col(i) / area_[i]; }

Eigen::VectorXd DenseTestTransport::row_error(Index i) const { return sigma_.col(i) / area_[i]; }

Eigen::MatrixXd DenseTestTransport::apply_error(const Eigen::MatrixXd& radiosity) const {
  const Eigen::MatrixXd variance = sigma_.cwiseAbs2() * radiosity.cwiseAbs2();
  return area_.cwiseInverse().asDiagonal() * variance.cwiseSqrt();
}

double DenseTestTransport::error() const {
  const Eigen::VectorXd scale = area_.cwiseSqrt().cwiseInverse();
  return (scale.asDiagonal() * sigma_ * scale.asDiagonal()).norm();
}

Eigen::MatrixXd DenseTestTransport::form_factors() const {
  return area_.cwiseInverse().asDiagonal() * exchange_;
}

Eigen::MatrixXd random_matrix(Index rows, Index cols, double low, double high,
                              std::mt19937_64& random) {
  std::uniform_real_distribution<double> distribution(low, high);
  Eigen::MatrixXd result(rows, cols);
  for (Index j = 0; j < cols; ++j) {
    for (Index i = 0; i < rows; ++i) result(i, j) = distribution(random);
  }
  return result;
}

DenseTestTransport close(const Eigen::MatrixXd& exchange) {
  return {exchange, exchange.rowwise().sum()};
}

DenseTestTransport random_closed(Index n, std::mt19937_64& random) {
  const Eigen::MatrixXd half = random_matrix(n, n, -0.5, 1, random).cwiseMax(0);
  return close(half + half.transpose());
}

DenseTestTransport random_open(Index n, std::mt19937_64& random) {
  const DenseTestTransport closed = random_closed(n, random);
  const Eigen::VectorXd larger =
      closed.area().cwiseQuotient(random_matrix(n, 1, 0.3, 1, random).col(0));
  return {closed.exchange(), larger};
}

DenseTestTransport sphere(const Eigen::VectorXd& area, double sphere_area) {
  return {area * area.transpose() / sphere_area, area};
}

DenseTestTransport chamber_ring(Index n_chambers, Index patches_per_chamber, double coupling,
                                std::mt19937_64& random) {
  const Index n = n_chambers * patches_per_chamber;
  const Index m = patches_per_chamber;
  Eigen::MatrixXd exchange = Eigen::MatrixXd::Zero(n, n);
  for (Index chamber = 0; chamber < n_chambers; ++chamber) {
    const Index next = (chamber + 1) % n_chambers;
    exchange.block(chamber * m, chamber * m, m, m) += random_matrix(m, m, 0, 1, random);
    exchange.block(chamber * m, next * m, m, m) += random_matrix(m, m, 0, coupling, random);
  }
  return close(exchange + exchange.transpose());
}

DenseTestTransport rough_box(const Vec3& lengths, double step) {
  std::vector<Vec3> centers;
  std::vector<Vec3> normals;
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    for (const double side : {0., 1.}) {
      for (double s = step / 2; s < lengths[u]; s += step) {
        for (double t = step / 2; t < lengths[v]; t += step) {
          Vec3 center = Vec3::Zero();
          center[axis] = side * lengths[axis];
          center[u] = s;
          center[v] = t;
          centers.push_back(center);
          normals.push_back((1 - 2 * side) * Vec3::Unit(axis));
        }
      }
    }
  }
  const auto n = static_cast<Index>(centers.size());
  Eigen::MatrixXd exchange = Eigen::MatrixXd::Zero(n, n);
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) {
      const Vec3 d = centers[j] - centers[i];
      if (normals[i] == normals[j]) continue;
      exchange(i, j) = std::pow(step, 4) * d.dot(normals[i]) * -d.dot(normals[j]) /
                       (kPi * d.squaredNorm() * d.squaredNorm());
    }
  }
  return close(exchange);
}

}  // namespace radiosity::test
