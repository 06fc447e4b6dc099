#include "radiosity/solve/external_solver.h"

#include <algorithm>
#include <cmath>

namespace radiosity {
namespace {

/// What the solver's own residual, which may drift from the true one, is asked for more.
constexpr double kDriftMargin = 0.5;

/// ΔH = scale x where the scale is not 0; else nothing of it is passed on.
struct Scales {
  Eigen::VectorXd to_unknowns;  ///< (A ρ)^½, or A^½
  Eigen::VectorXd from_unknowns;
};

Scales make_scales(const IrradianceSystem& system, Index c, bool is_symmetric) {
  Scales scales;
  scales.to_unknowns = system.transport->area().cwiseSqrt();
  if (is_symmetric) scales.to_unknowns.array() *= system.rho(c).array().sqrt();
  scales.from_unknowns =
      (scales.to_unknowns.array() > 0).select(scales.to_unknowns.cwiseInverse(), 0);
  return scales;
}

/// The system of a column, whose functions refer to what is given.
LinearSystem make_linear_system(const IrradianceSystem& system, Index c, const Scales& scales,
                                SolveMonitor& monitor) {
  const bool is_symmetric = system.transmission.nonZeros() == 0;
  const auto product = [&system, &monitor](const Eigen::VectorXd& u) -> Eigen::VectorXd {
    monitor.check();
    monitor.spend(1);
    return system.transport->apply(u);
  };
  LinearSystem result;
  result.is_symmetric = is_symmetric;
  result.apply = [&system, &scales, c, product](const Eigen::VectorXd& u) -> Eigen::VectorXd {
    const Eigen::VectorXd passed = system.passed_on(c, u.cwiseProduct(scales.from_unknowns));
    return u - scales.to_unknowns.cwiseProduct(product(passed));
  };
  result.apply_transposed = result.apply;
  if (is_symmetric) return result;
  result.apply_transposed = [&system, &scales, c,
                             product](const Eigen::VectorXd& u) -> Eigen::VectorXd {
    const Eigen::VectorXd seen = product(u.cwiseProduct(scales.from_unknowns));
    return u - scales.to_unknowns.cwiseProduct(system.passed_on(c, seen));
  };
  return result;
}

/// ‖r‖ / ‖r of the iterate‖ at which the column's bound is the monitor's tolerance.
double asked_of_residual(const IrradianceSystem& system, Index c, double norm,
                         const Column& irradiance, const SolveMonitor& monitor) {
  const double bound = system.error_bound(c, norm, irradiance);
  const double asked = kDriftMargin * monitor.tolerance();
  return std::isfinite(bound) && bound > 0 ? std::min(asked / bound, kDriftMargin) : asked;
}

}  // namespace

Iterate solve_externally(const IrradianceSystem& system, const LinearSolver& solver,
                         SolveMonitor& monitor) {
  Iterate iterate = first_iterate(system, monitor);
  monitor.show(0, 0, system.error_bounds(iterate).maxCoeff(), step_fields(system, iterate));
  int iterations = 0;
  for (Index c = 0; c < system.n_columns(); ++c) {
    const Scales scales = make_scales(system, c, system.transmission.nonZeros() == 0);
    LinearSystem linear = make_linear_system(system, c, scales, monitor);
    const Eigen::VectorXd residual = iterate.gathered.col(c) - iterate.irradiance.col(c);
    linear.right_side = scales.to_unknowns.cwiseProduct(residual);
    if (linear.right_side.isZero(0)) continue;
    linear.tolerance = asked_of_residual(system, c, std::sqrt(system.inner(c, residual, residual)),
                                         iterate.irradiance.col(c), monitor);
    linear.max_products = monitor.products_left();
    const LinearSolution found = solver(linear);
    iterations += found.iterations;
    // A run that broke down leaves the iterate as it was.
    if (!found.unknowns.allFinite()) continue;
    iterate.irradiance.col(c) += scales.from_unknowns.cwiseProduct(found.unknowns);
  }
  iterate.gathered = system.gather(system.radiosity(iterate.irradiance));
  monitor.spend(1);
  if (system.transmission.nonZeros() == 0) {
    // What falls on patches that pass nothing on is no unknown.
    for (Index c = 0; c < system.n_columns(); ++c) {
      iterate.irradiance.col(c) =
          (system.rho(c).array() > 0).select(iterate.irradiance.col(c), iterate.gathered.col(c));
    }
  }
  monitor.step(iterations, 0, system.error_bounds(iterate).maxCoeff(),
               step_fields(system, iterate));
  return iterate;
}

}  // namespace radiosity
