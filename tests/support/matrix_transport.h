#pragma once

#include <Eigen/Core>
#include <random>

#include "radiosity/base/geometry.h"
#include "radiosity/operator/transport.h"

namespace radiosity::test {

/// A transport operator made from given exchange areas, for tests without meshes or rays.
class DenseTestTransport final : public Transport, public FactorRows {
 public:
  /// `exchange` is G, symmetric, m², n x n; `area` A, m², n; `sigma` one standard error of each
  /// entry of G, n x n, or empty if exact.
  DenseTestTransport(Eigen::MatrixXd exchange, Eigen::VectorXd area, Eigen::MatrixXd sigma = {});

  [[nodiscard]] Index size() const override { return area_.size(); }
  [[nodiscard]] const Eigen::VectorXd& area() const override { return area_; }
  [[nodiscard]] Eigen::MatrixXd apply(const Eigen::MatrixXd& radiosity) const override;
  [[nodiscard]] Eigen::VectorXd row(Index i) const override;
  [[nodiscard]] Eigen::VectorXd row_error(Index i) const override;
  [[nodiscard]] Eigen::MatrixXd apply_error(const Eigen::MatrixXd& radiosity) const override;
  [[nodiscard]] double error() const override;
  [[nodiscard]] std::size_t bytes() const override {
    return static_cast<std::size_t>(exchange_.size() + sigma_.size()) * sizeof(double);
  }
  [[nodiscard]] const AssemblyReport& report() const override { return report_; }
  [[nodiscard]] const FactorRows* rows() const override { return this; }
  [[nodiscard]] ExchangeArea pair(Index i, Index j) const override {
    return {exchange_(i, j), sigma_(i, j), sigma_(i, j) == 0};
  }

  /// Calls of `apply` so far, and the columns that they had in total.
  [[nodiscard]] long n_products() const { return n_products_; }
  [[nodiscard]] long n_columns() const { return n_columns_; }
  [[nodiscard]] const Eigen::MatrixXd& exchange() const { return exchange_; }
  /// F as a plain matrix.
  [[nodiscard]] Eigen::MatrixXd form_factors() const;

 private:
  Eigen::MatrixXd exchange_;
  Eigen::VectorXd area_;
  Eigen::MatrixXd sigma_;
  AssemblyReport report_;
  mutable long n_products_ = 0;
  mutable long n_columns_ = 0;
};

/// Uniform random numbers in [low, high].
Eigen::MatrixXd random_matrix(Index rows, Index cols, double low, double high,
                              std::mt19937_64& random);

/// The closed operator of symmetric exchange areas: areas are the row sums, so Σ_j F_ij = 1.
DenseTestTransport close(const Eigen::MatrixXd& exchange);

/// A closed operator with random exchange areas, diagonal included, about a third of them zero.
DenseTestTransport random_closed(Index n, std::mt19937_64& random);

/// A random operator from which light escapes: row sums between 0.3 and 1.
DenseTestTransport random_open(Index n, std::mt19937_64& random);

/// The inside of a sphere of area S: G_ij = A_i A_j / S.
DenseTestTransport sphere(const Eigen::VectorXd& area, double sphere_area);

/// Chambers in a ring, each joined to the next by a weak coupling: light mixes slowly, so that
/// eigenvalues of F crowd below 1.
DenseTestTransport chamber_ring(Index n_chambers, Index patches_per_chamber, double coupling,
                                std::mt19937_64& random);

/// A box of the given edge lengths (m) with square patches of edge `step`: the kernel
/// cosθ cosθ' A² / (π r²) between centres, closed by taking row sums as areas. Rough, but with the
/// spectrum of a room.
DenseTestTransport rough_box(const Vec3& lengths, double step);

}  // namespace radiosity::test
