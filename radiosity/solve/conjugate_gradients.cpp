#include "radiosity/solve/conjugate_gradients.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "radiosity/base/parallel.h"

namespace radiosity {
namespace {

/// The recursive residual is asked for slightly more than the true one has to reach, so that
/// rounding does not cost a restart.
constexpr double kMargin = 0.99;

/// How far off products may be, for each of the columns: a small share of the residual's norm at
/// which its bound is `limit`, so that what adds up over the iterations stays below that.
Eigen::VectorXd allowed_errors(const IrradianceSystem& system, const Eigen::MatrixXd& residual,
                               const Eigen::VectorXd& bounds, const std::vector<Index>& columns,
                               double limit) {
  constexpr double kShare = 0.01;
  Eigen::VectorXd errors(static_cast<Index>(columns.size()));
  for (std::size_t a = 0; a < columns.size(); ++a) {
    const Index c = columns[a];
    const double norm = std::sqrt(system.inner(c, residual.col(c), residual.col(c)));
    errors[static_cast<Index>(a)] = kShare * std::min(limit / bounds[c], 1.0) * norm;
  }
  return errors;
}

/// One run of conjugate gradients from the true residual of `start`: the irradiance.
Eigen::MatrixXd descend(const IrradianceSystem& system, Iterate start, SolveMonitor& monitor) {
  Eigen::VectorXd bounds = system.error_bounds(start);
  Eigen::MatrixXd irradiance = std::move(start.irradiance);
  Eigen::MatrixXd residual = std::move(start.gathered);
  parallel_segments(system.size(), [&](Index begin, Index n) {
    residual.middleRows(begin, n) -= irradiance.middleRows(begin, n);
  });
  Eigen::MatrixXd direction = residual;
  const double limit = kMargin * monitor.tolerance();
  std::vector<Index> columns = columns_above(bounds, limit);
  const StepFields fields{
      .radiosity = [&system, &irradiance] { return system.radiosity(irradiance); },
      .unshot = [&system, &residual] { return system.passed_on(residual); }};

  while (!columns.empty() && monitor.may_spend(2)) {
    // Then what is left of the direction, image by image.
    Eigen::MatrixXd image = system.reflect(
        direction, columns, allowed_errors(system, residual, bounds, columns, limit));
    std::vector<Index> remaining;
    for (std::size_t a = 0; a < columns.size(); ++a) {
      const Index c = columns[a];
      Eigen::Ref<Eigen::VectorXd> image_of = image.col(static_cast<Index>(a));
      parallel_segments(system.size(), [&](Index begin, Index n) {
        image_of.segment(begin, n) =
            direction.col(c).segment(begin, n) - image_of.segment(begin, n);
      });
      const double curvature = system.inner(c, direction.col(c), image_of);
      const double squared = system.inner(c, residual.col(c), residual.col(c));
      // Rounding, or row sums above 1: this column cannot go on.
      if (!(curvature > 0)) continue;
      const double step = squared / curvature;
      parallel_segments(system.size(), [&](Index begin, Index n) {
        irradiance.col(c).segment(begin, n) += step * direction.col(c).segment(begin, n);
        residual.col(c).segment(begin, n) -= step * image_of.segment(begin, n);
      });
      const double next_squared = system.inner(c, residual.col(c), residual.col(c));
      const double share = next_squared / squared;
      parallel_segments(system.size(), [&](Index begin, Index n) {
        direction.col(c).segment(begin, n) =
            residual.col(c).segment(begin, n) + share * direction.col(c).segment(begin, n);
      });
      bounds[c] = system.error_bound(c, std::sqrt(next_squared), irradiance.col(c));
      if (!(bounds[c] <= limit) && next_squared > 0) remaining.push_back(c);
    }
    columns = remaining;
    monitor.step(1, 1, bounds.maxCoeff(), fields);
  }
  return irradiance;
}

/// From darkness, B = M_e: patches that no light can reach then stay exactly 0.
Iterate darkness(const IrradianceSystem& system) {
  return {Eigen::MatrixXd::Zero(system.size(), system.n_columns()), system.direct};
}

}  // namespace

Iterate conjugate_gradients(const IrradianceSystem& system, SolveMonitor& monitor) {
  Iterate iterate = first_iterate(system, monitor);
  double bound = system.error_bounds(iterate).maxCoeff();
  monitor.show(0, 0, bound, step_fields(system, iterate));
  while (bound > monitor.tolerance() && monitor.may_spend(2)) {
    Iterate next{descend(system, iterate, monitor), {}};
    next.gathered = system.gather(system.radiosity(next.irradiance));
    monitor.spend(1);
    const double next_bound = system.error_bounds(next).maxCoeff();
    const bool is_stuck = !(next_bound <= 0.5 * bound);
    if (next_bound <= bound) {
      iterate = next;
      bound = next_bound;
    }
    if (is_stuck) break;
  }
  return iterate;
}

Eigen::MatrixXd unproved_irradiance(const IrradianceSystem& system, SolveMonitor& monitor) {
  return descend(system, darkness(system), monitor);
}

}  // namespace radiosity
