#include "radiosity/solve/relaxation.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace radiosity {
namespace {

/// How often per product's work Southwell's bound is evaluated.
constexpr Index kChecksPerProduct = 8;

Iterate with_last_product(const IrradianceSystem& system, const Eigen::MatrixXd& irradiance,
                          SolveMonitor& monitor) {
  monitor.spend(1);
  return {irradiance, system.gather(system.radiosity(irradiance))};
}

/// ρ (F B - H), W/m²; a product.
Eigen::MatrixXd residual(const IrradianceSystem& system, const Eigen::MatrixXd& irradiance) {
  const Eigen::MatrixXd gathered = system.gather(system.radiosity(irradiance));
  return system.passed_on(gathered - irradiance);
}

struct Sweep {
  Eigen::MatrixXd irradiance;
  Eigen::VectorXd change;  ///< ‖H_new - H_old‖_w of each column
};

/// One Gauss-Seidel sweep over all patches.
Sweep sweep(const IrradianceSystem& system, Eigen::MatrixXd irradiance,
            const SolveMonitor& monitor) {
  Eigen::MatrixXd b = system.radiosity(irradiance);
  Eigen::VectorXd squared = Eigen::VectorXd::Zero(system.n_columns());
  for (Index i = 0; i < system.size(); ++i) {
    monitor.check();
    const Eigen::VectorXd row = quick_rows_of(*system.transport).row(i);
    Eigen::RowVectorXd gathered = row.transpose() * b;
    if (system.incident.size() > 0) gathered += system.incident.row(i);
    for (Index c = 0; c < system.n_columns(); ++c) {
      const double rho = system.rho(c)[i];
      const double change = (gathered[c] - irradiance(i, c)) / (1 - row[i] * rho);
      irradiance(i, c) += change;
      b(i, c) = system.exitance(i, c) + rho * irradiance(i, c);
      squared[c] += system.transport->area()[i] * rho * change * change;
    }
  }
  return {std::move(irradiance), squared.cwiseSqrt()};
}

/// Light on its way: what has arrived, H = F (B - U) + H_0, and the part U of B = M_e + ρ H that
/// has not been sent yet.
struct Shooting {
  Eigen::MatrixXd irradiance;
  Eigen::MatrixXd unshot;

  /// Sends the unshot radiosity of the patch with the most unshot power (over all columns) to the
  /// others: by reciprocity the column of F needed is F_ji = A_i F_ij / A_j.
  void shoot(const IrradianceSystem& system) {
    const Eigen::VectorXd& area = system.transport->area();
    Index source = 0;
    unshot.cwiseAbs().rowwise().sum().cwiseProduct(area).maxCoeff(&source);
    const Eigen::VectorXd received =
        area[source] * quick_rows_of(*system.transport).row(source).cwiseQuotient(area);
    for (Index c = 0; c < system.n_columns(); ++c) {
      const double sent = unshot(source, c);
      unshot(source, c) = 0;
      irradiance.col(c) += sent * received;
      unshot.col(c) += sent * system.rho(c).cwiseProduct(received);
    }
  }
};

/// The light before the first shot. In darkness nothing is sent; a warm start has sent its B, and
/// what that changes waits to be sent.
Shooting before_shooting(const IrradianceSystem& system, const Iterate& start) {
  if (start.irradiance.isZero(0)) {
    if (system.incident.size() == 0) return {start.irradiance, system.exitance};
    return {system.incident, system.radiosity(system.incident)};
  }
  return {start.gathered, system.passed_on(start.gathered - start.irradiance)};
}

/// B counts the unshot radiosity U too, so the residual is F U:
/// ‖F U‖_w <= ρ_max^½ ‖F̂‖₂ ‖U‖, and ‖F̂‖₂ is at most the largest row sum of F.
double error_bound(const IrradianceSystem& system, const Shooting& light) {
  const double largest_row_sum = system.row_sums.maxCoeff();
  double largest = 0;
  for (Index c = 0; c < system.n_columns(); ++c) {
    const double norm =
        std::sqrt(system.transport->area().dot(light.unshot.col(c).cwiseAbs2().matrix()));
    const double residual_norm =
        std::sqrt(system.largest_reflectance[system.band(c)]) * largest_row_sum * norm;
    largest = std::max(largest, system.error_bound(c, residual_norm, light.irradiance.col(c)));
  }
  return largest;
}

}  // namespace

Iterate gauss_seidel(const IrradianceSystem& system, SolveMonitor& monitor) {
  const Iterate start = first_iterate(system, monitor);
  double bound = system.error_bounds(start).maxCoeff();
  monitor.show(0, 0, bound, step_fields(system, start));
  if (!(bound > monitor.tolerance()) || !monitor.may_spend(2)) return start;

  Eigen::MatrixXd irradiance = start.irradiance;
  const StepFields fields{
      .radiosity = [&system, &irradiance] { return system.radiosity(irradiance); },
      .unshot = [&system, &irradiance] { return residual(system, irradiance); }};
  while (bound > monitor.tolerance() && monitor.may_spend(2)) {
    Sweep next = sweep(system, std::move(irradiance), monitor);
    irradiance = std::move(next.irradiance);
    // Row i was exact when it was set, and only later rows have changed since: the residual is the
    // upper triangle of F ρ times the change. F is not negative, so the norm of the triangle is at
    // most that of the whole, q.
    Eigen::VectorXd bounds(system.n_columns());
    for (Index c = 0; c < system.n_columns(); ++c) {
      const double residual_norm = system.contraction[system.band(c)] * next.change[c];
      bounds[c] = system.error_bound(c, residual_norm, irradiance.col(c));
    }
    bound = bounds.maxCoeff();
    monitor.step(1, 1, bound, fields);
  }
  return with_last_product(system, irradiance, monitor);
}

Iterate southwell(const IrradianceSystem& system, SolveMonitor& monitor) {
  const Index n = system.size();
  const Index n_shots = std::max<Index>(1, n / kChecksPerProduct);
  const auto work = [n](Index shots) {
    return static_cast<double>(shots) / static_cast<double>(n);
  };
  const Iterate start = first_iterate(system, monitor);
  double bound = system.error_bounds(start).maxCoeff();
  const bool is_solved = !(bound > monitor.tolerance()) || !monitor.may_spend(2);
  Shooting light = before_shooting(system, start);
  const StepFields fields{
      .radiosity = [&system, &light] { return system.radiosity(light.irradiance); },
      .unshot = [&light] { return light.unshot; }};
  monitor.show(0, 0, bound, is_solved ? step_fields(system, start) : fields);
  if (is_solved) return start;

  while (bound > monitor.tolerance() && monitor.may_spend(1 + work(n_shots))) {
    for (Index shot = 1; shot <= n_shots; ++shot) {
      monitor.check();
      light.shoot(system);
      if (shot == n_shots || !monitor.is_watched()) continue;
      monitor.show(static_cast<int>(shot), work(shot), error_bound(system, light), fields);
    }
    bound = error_bound(system, light);
    monitor.step(static_cast<int>(n_shots), work(n_shots), bound, fields);
  }
  return with_last_product(system, light.irradiance, monitor);
}

}  // namespace radiosity
