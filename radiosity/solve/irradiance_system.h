#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/operator/transport.h"
#include "radiosity/solve/solve_monitor.h"

namespace radiosity {

/// A vector or the column of a matrix, which is not copied.
using Column = Eigen::Ref<const Eigen::VectorXd>;

/// An approximate solution B = M_e + ρ H and what it yields; both W/m², n x k.
struct Iterate {
  Eigen::MatrixXd irradiance;  ///< H
  Eigen::MatrixXd gathered;    ///< F B + H_0 of B = M_e + ρ H, equal to H once solved
};

/// The radiosity equation in the irradiance H, from which B = M_e + ρ H:
///
///     (I - F ρ) H = F M_e + H_0
///
/// with the incident H_0. Where light is passed on to other patches ρ stands for ρ + T all through,
/// and ρ_max for its largest row sum, which is no less than its norm; A (ρ + T) is symmetric.
///
/// In the inner product <u, v> = Σ A ρ u v the operator F ρ is self-adjoint with the eigenvalues of
/// R F̂ R, where R = ρ^½ and F̂ = A^-½ G A^-½; patches with ρ = 0 drop out by themselves and nothing
/// is ever divided by ρ. The residual of an iterate is r = F B - H, the one of the radiosity ρ r.
///
/// Error bound. With ‖u‖_w² = Σ A ρ u², ‖B‖² = Σ A B² (the energy norm) and q >= ‖R F̂ R‖₂,
///     ‖ΔB‖ = ‖ρ ΔH‖ <= ρ_max^½ ‖ΔH‖_w <= ρ_max^½ ‖r‖_w / (1 - q).
/// F is not negative, so q may be any max_i (F ρ x)_i / x_i or max_i (ρ F x)_i / x_i with x > 0
/// (Collatz 1942); x = 1 gives max_i Σ_j F_ij ρ_j and max_i ρ_i Σ_j F_ij, of which the smaller is
/// taken. Both are <= ρ_max if row sums are <= 1.
struct IrradianceSystem {
  const Transport* transport = nullptr;
  Eigen::MatrixXd exitance;                  ///< M_e, n x k
  Eigen::MatrixXd reflectance;               ///< ρ, n x b
  Eigen::MatrixXd incident;                  ///< H_0, n x k; empty if none
  Eigen::SparseMatrix<double> transmission;  ///< T, n x n; empty if none
  Eigen::MatrixXd direct;                    ///< F M_e + H_0, n x k
  Eigen::MatrixXd reflected_start;   ///< F ρ H of SolveOptions::start, n x k; empty if none
  Eigen::VectorXd row_sums;          ///< F 1, n
  Eigen::MatrixXd passed_share;      ///< ρ 1, the share of its light that a patch keeps up, n x b
  Eigen::MatrixXd seen_reflectance;  ///< F ρ 1, n x b
  Eigen::VectorXd least_radiosity;   ///< ‖M_e + ρ H_0‖ <= ‖B‖ where M_e >= 0, else 0; k
  Eigen::VectorXd largest_reflectance;  ///< ρ_max, b
  Eigen::VectorXd contraction;          ///< q, b; >= 1 where nothing better could be proved

  [[nodiscard]] Index size() const { return exitance.rows(); }
  [[nodiscard]] Index n_columns() const { return exitance.cols(); }
  /// Column of `reflectance` that belongs to column c of the unknowns.
  [[nodiscard]] Index band(Index c) const { return c % reflectance.cols(); }
  [[nodiscard]] Eigen::MatrixXd::ConstColXpr rho(Index c) const { return reflectance.col(band(c)); }

  /// ρ u with the reflectance of column c.
  [[nodiscard]] Eigen::VectorXd passed_on(Index c, const Column& u) const;
  /// M_e + ρ H_0 of column c: what leaves before light is exchanged.
  [[nodiscard]] Eigen::VectorXd source(Index c) const;
  /// F B + H_0.
  [[nodiscard]] Eigen::MatrixXd gather(const Eigen::MatrixXd& radiosity) const;
  /// B = M_e + ρ H.
  [[nodiscard]] Eigen::MatrixXd radiosity(const Eigen::MatrixXd& irradiance) const;
  /// ρ u, n x k.
  [[nodiscard]] Eigen::MatrixXd passed_on(const Eigen::MatrixXd& u) const;
  /// F (ρ u) for the given columns of u; n x columns.size(). Each may be off by its `tolerance`
  /// (energy norm), which saves work if there are many that are alike.
  [[nodiscard]] Eigen::MatrixXd reflect(const Eigen::MatrixXd& u, const std::vector<Index>& columns,
                                        const Eigen::VectorXd& tolerance = {}) const;
  /// <u, v> = Σ A ρ u v with the reflectance of column c.
  [[nodiscard]] double inner(Index c, const Column& u, const Column& v) const;
  /// Whether q < 1, so that residuals bound errors.
  [[nodiscard]] bool has_bound(Index c) const { return contraction[band(c)] < 1; }
  /// Bound on ‖ΔB‖/‖B‖ of column c for the iterate `irradiance` whose residual has at most the
  /// norm ‖r‖_w. Where q < 1 cannot be proved, the same with 1 for 1 / (1 - q), which is no bound.
  [[nodiscard]] double error_bound(Index c, double residual_norm, const Column& irradiance) const;
  /// `error_bound` of each column from the true residual of the iterate, k.
  [[nodiscard]] Eigen::VectorXd error_bounds(const Iterate& iterate) const;
};

/// Prepares the system of what the monitor's options say beside; one product with 1, ρ, M_e and the
/// start together, more only if some ρ = 1. Throws SolveError if light is emitted among patches
/// with ρ = 1 that let none escape, of heat (sinks) even if none is.
IrradianceSystem make_irradiance_system(const Transport& transport, const Eigen::MatrixXd& exitance,
                                        const Eigen::MatrixXd& reflectance, SolveMonitor& monitor);

/// The same system with other sources, whose direct light may be off by a relative `tolerance`; one
/// product.
IrradianceSystem with_exitance(const IrradianceSystem& system, Eigen::MatrixXd exitance,
                               double tolerance, SolveMonitor& monitor);

/// Where an iteration starts: at SolveOptions::start, or at darkness if there is none or the column
/// is unlit.
Iterate first_iterate(const IrradianceSystem& system, const SolveMonitor& monitor);

/// What a watcher sees of an iterate. Refers to both.
StepFields step_fields(const IrradianceSystem& system, const Iterate& iterate);

/// Indices of the columns whose bound exceeds the limit.
std::vector<Index> columns_above(const Eigen::VectorXd& bounds, double limit);

}  // namespace radiosity
