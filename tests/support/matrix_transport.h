#pragma once

#include <Eigen/Core>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "radiosity/transport.h"

namespace radiosity::testing {

/// A transport operator made from given exchange areas, for tests without meshes or rays.
class DenseTestTransport final : public Transport {
 public:
  /// `exchange` is G, symmetric, m², n x n; `area` A, m², n; `sigma` one standard error of each
  /// entry of G, n x n, or empty if exact.
  DenseTestTransport(Eigen::MatrixXd exchange, Eigen::VectorXd area, Eigen::MatrixXd sigma = {})
      : exchange_(std::move(exchange)), area_(std::move(area)), sigma_(std::move(sigma)) {
    if (sigma_.size() == 0) sigma_ = Eigen::MatrixXd::Zero(area_.size(), area_.size());
    report_.row_sums = exchange_.rowwise().sum().cwiseQuotient(area_);
  }

  [[nodiscard]] Index size() const override { return area_.size(); }
  [[nodiscard]] const Eigen::VectorXd& area() const override { return area_; }
  [[nodiscard]] Eigen::MatrixXd apply(const Eigen::MatrixXd& radiosity) const override {
    n_products_ += 1;
    n_columns_ += radiosity.cols();
    return area_.cwiseInverse().asDiagonal() * (exchange_ * radiosity);
  }
  [[nodiscard]] Eigen::VectorXd row(Index i) const override { return exchange_.col(i) / area_[i]; }
  [[nodiscard]] Eigen::VectorXd row_error(Index i) const override {
    return sigma_.col(i) / area_[i];
  }
  [[nodiscard]] Eigen::MatrixXd apply_error(const Eigen::MatrixXd& radiosity) const override {
    const Eigen::MatrixXd variance = sigma_.cwiseAbs2() * radiosity.cwiseAbs2();
    return area_.cwiseInverse().asDiagonal() * variance.cwiseSqrt();
  }
  [[nodiscard]] double error() const override {
    const Eigen::VectorXd scale = area_.cwiseSqrt().cwiseInverse();
    return (scale.asDiagonal() * sigma_ * scale.asDiagonal()).norm();
  }
  [[nodiscard]] std::size_t bytes() const override {
    return static_cast<std::size_t>(exchange_.size() + sigma_.size()) * sizeof(double);
  }
  [[nodiscard]] const AssemblyReport& report() const override { return report_; }

  /// Calls of `apply` so far, and the columns that they had in total.
  [[nodiscard]] long n_products() const { return n_products_; }
  [[nodiscard]] long n_columns() const { return n_columns_; }
  [[nodiscard]] const Eigen::MatrixXd& exchange() const { return exchange_; }
  /// F as a plain matrix.
  [[nodiscard]] Eigen::MatrixXd form_factors() const {
    return area_.cwiseInverse().asDiagonal() * exchange_;
  }

 private:
  Eigen::MatrixXd exchange_;
  Eigen::VectorXd area_;
  Eigen::MatrixXd sigma_;
  AssemblyReport report_;
  mutable long n_products_ = 0;
  mutable long n_columns_ = 0;
};

/// Uniform random numbers in [low, high].
inline Eigen::MatrixXd random_matrix(Index rows, Index cols, double low, double high,
                                     std::mt19937_64& random) {
  std::uniform_real_distribution<double> distribution(low, high);
  Eigen::MatrixXd result(rows, cols);
  for (Index j = 0; j < cols; ++j) {
    for (Index i = 0; i < rows; ++i) result(i, j) = distribution(random);
  }
  return result;
}

/// The closed operator of symmetric exchange areas: areas are the row sums, so Σ_j F_ij = 1.
inline DenseTestTransport close(const Eigen::MatrixXd& exchange) {
  return {exchange, exchange.rowwise().sum()};
}

/// A closed operator with random exchange areas, diagonal included, about a third of them zero.
inline DenseTestTransport random_closed(Index n, std::mt19937_64& random) {
  const Eigen::MatrixXd half = random_matrix(n, n, -0.5, 1, random).cwiseMax(0);
  return close(half + half.transpose());
}

/// A random operator from which light escapes: row sums between 0.3 and 1.
inline DenseTestTransport random_open(Index n, std::mt19937_64& random) {
  const DenseTestTransport closed = random_closed(n, random);
  const Eigen::VectorXd larger =
      closed.area().cwiseQuotient(random_matrix(n, 1, 0.3, 1, random).col(0));
  return {closed.exchange(), larger};
}

/// The inside of a sphere of area S: G_ij = A_i A_j / S.
inline DenseTestTransport sphere(const Eigen::VectorXd& area, double sphere_area) {
  return {area * area.transpose() / sphere_area, area};
}

/// Chambers in a ring, each joined to the next by a weak coupling: light mixes slowly, so that
/// eigenvalues of F crowd below 1.
inline DenseTestTransport chamber_ring(Index n_chambers, Index patches_per_chamber, double coupling,
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

/// A box of the given edge lengths (m) with square patches of edge `step`: the kernel
/// cosθ cosθ' A² / (π r²) between centres, closed by taking row sums as areas. Rough, but with the
/// spectrum of a room.
inline DenseTestTransport rough_box(const Vec3& lengths, double step) {
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

}  // namespace radiosity::testing
