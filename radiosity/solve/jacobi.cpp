#include "radiosity/solve/jacobi.h"

#include <algorithm>

namespace radiosity {
namespace {

/// Chebyshev iteration on [-q, q] with half width q per band; q = 0 is Jacobi's iteration:
/// H_{k+1} = H_{k-1} + ω_{k+1} (F (M_e + ρ H_k) - H_{k-1}), ω_1 = 1, ω_{k+1} = 1/(1 - q² ω_k/4).
Iterate gather(const IrradianceSystem& system, const Eigen::VectorXd& half_width,
               SolveMonitor& monitor) {
  Iterate iterate = first_iterate(system, monitor);
  Eigen::MatrixXd previous = iterate.irradiance;
  Eigen::VectorXd omega = Eigen::VectorXd::Ones(half_width.size());
  Eigen::VectorXd bounds = system.error_bounds(iterate);
  std::vector<Index> columns = columns_above(bounds, monitor.tolerance());
  const StepFields fields = step_fields(system, iterate);
  monitor.show(0, 0, bounds.maxCoeff(), fields);

  for (int k = 1; !columns.empty() && monitor.may_spend(1); ++k) {
    for (const Index c : columns) {
      const Eigen::VectorXd next =
          previous.col(c) + omega[system.band(c)] * (iterate.gathered.col(c) - previous.col(c));
      previous.col(c) = iterate.irradiance.col(c);
      iterate.irradiance.col(c) = next;
    }
    const Eigen::MatrixXd reflected = system.reflect(iterate.irradiance, columns);
    for (std::size_t a = 0; a < columns.size(); ++a) {
      iterate.gathered.col(columns[a]) =
          system.direct.col(columns[a]) + reflected.col(static_cast<Index>(a));
    }
    const double omega_factor = k == 1 ? 2 : 1;  // ω_1 = 1 stands for 2 in the recurrence
    omega = 1 / (1 - half_width.array().square() * omega.array() * omega_factor / 4);
    bounds = system.error_bounds(iterate);
    monitor.step(1, 1, bounds.maxCoeff(), fields);
    columns = columns_above(bounds, monitor.tolerance());
  }
  return iterate;
}

}  // namespace

Iterate jacobi(const IrradianceSystem& system, SolveMonitor& monitor) {
  return gather(system, Eigen::VectorXd::Zero(system.contraction.size()), monitor);
}

Iterate chebyshev(const IrradianceSystem& system, SolveMonitor& monitor) {
  // With q >= 1 the polynomials would not decay at all; a smaller interval still converges, as long
  // as the true eigenvalues are below 1.
  constexpr double kLargestHalfWidth = 1 - 1e-6;
  return gather(system, system.contraction.cwiseMin(kLargestHalfWidth), monitor);
}

}  // namespace radiosity
