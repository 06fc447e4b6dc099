#include "radiosity/solve/irradiance_system.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "radiosity/base/parallel.h"
#include "radiosity/operator/column_basis.h"
#include "radiosity/solve/trapped_light.h"

namespace radiosity {
namespace {

/// Row sums this close to 1 count as closed: what single-precision exchange areas can tell.
constexpr double kClosedRowSum = 1 - 1e-6;
/// Patches that pass on all but this share of their light count as white.
constexpr double kAbsorbedByRounding = 1e-12;
/// Relative error of what a system is made of.
constexpr double kRounding = 1e-14;
/// A loss of light this small may be rounding.
constexpr double kProvedLoss = 1e-9;
/// What may be missing of the 1 that is added where light grows for a proof.
constexpr double kGrownRest = 0.1;
/// Products spent at most on proving that light dies out among patches with ρ = 1.
constexpr int kMaxProofProducts = 60;

/// Marks (1, else 0) the patches that absorb nothing and exchange light only among themselves.
Eigen::VectorXd trapping_patches(const IrradianceSystem& system, Index band,
                                 SolveMonitor& monitor) {
  constexpr double kWhite = 1 - kAbsorbedByRounding;
  Eigen::VectorXd trapping = (system.passed_share.col(band).array() >= kWhite).cast<double>();
  for (int k = 0; k < kMaxProofProducts && (trapping.array() > 0).any(); ++k) {
    const Eigen::VectorXd kept = system.transport->apply(trapping);
    monitor.spend(1);
    monitor.check();
    const Eigen::VectorXd passed = system.passed_on(band, trapping);
    const Eigen::VectorXd remaining =
        (kept.array() >= kClosedRowSum && passed.array() >= kWhite).select(trapping, 0);
    if (remaining == trapping) return trapping;
    trapping = remaining;
  }
  return Eigen::VectorXd::Zero(system.size());
}

void require_no_trapped_light(const IrradianceSystem& system, Index band, SolveMonitor& monitor) {
  const Eigen::VectorXd trapping = trapping_patches(system, band, monitor);
  Index patch = 0;
  if (trapping.maxCoeff(&patch) == 0) return;
  for (Index c = band; c < system.n_columns(); c += system.reflectance.cols()) {
    const Eigen::VectorXd light =
        system.exitance.col(c).cwiseAbs() + system.direct.col(c).cwiseAbs();
    // Of heat nothing fixes the temperatures of such patches.
    if (trapping.dot(light) == 0 && !monitor.has_sinks()) continue;
    std::vector<std::int32_t> patches;
    for (Index i = 0; i < trapping.size(); ++i) {
      if (trapping[i] > 0) patches.push_back(static_cast<std::int32_t>(i));
    }
    throw TrappedLight(
        "no solution: " + std::to_string(static_cast<long>(trapping.sum())) + " of " +
            std::to_string(system.size()) + " patches (such as patch " + std::to_string(patch) +
            ") have reflectance 1 in column " + std::to_string(band) +
            ", let no light escape, and are lit; expected a reflectance below 1 or an "
            "opening somewhere among them",
        std::move(patches));
  }
}

/// A field x that light grows to where 1 is added everywhere, (I - F ρ) x = 1 as far as conjugate
/// gradients get: there (F ρ x)_i / x_i = 1 - 1 / x_i.
Eigen::VectorXd grown_light(const IrradianceSystem& system, Index band, SolveMonitor& monitor) {
  const auto image = [&](const Eigen::VectorXd& u) -> Eigen::VectorXd {
    monitor.spend(1);
    monitor.check();
    return u - system.transport->apply(system.passed_on(band, u));
  };
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(system.size());
  Eigen::VectorXd x = ones;
  Eigen::VectorXd residual = system.seen_reflectance.col(band);
  Eigen::VectorXd direction = residual;
  double squared = system.inner(band, residual, residual);
  for (int k = 2; k < kMaxProofProducts && residual.cwiseAbs().maxCoeff() > kGrownRest; ++k) {
    const Eigen::VectorXd step = image(direction);
    const double curvature = system.inner(band, direction, step);
    if (!(curvature > 0)) break;
    x += squared / curvature * direction;
    residual -= squared / curvature * step;
    const double next = system.inner(band, residual, residual);
    direction = residual + next / squared * direction;
    squared = next;
  }
  return x;
}

/// Lowers q by (F ρ x)_i / x_i of such a field, with a product more.
double refine_contraction(const IrradianceSystem& system, Index band, SolveMonitor& monitor) {
  const Eigen::VectorXd x = grown_light(system, band, monitor);
  if (!(x.minCoeff() > 0)) return system.contraction[band];
  const Eigen::VectorXd next = system.transport->apply(system.passed_on(band, x));
  monitor.spend(1);
  monitor.check();
  const double ratio = next.cwiseQuotient(x).maxCoeff();
  return 1 - ratio > kProvedLoss ? std::min(system.contraction[band], ratio)
                                 : system.contraction[band];
}

Eigen::VectorXd least_radiosity(const IrradianceSystem& system) {
  Eigen::VectorXd least = Eigen::VectorXd::Zero(system.n_columns());
  for (Index c = 0; c < least.size(); ++c) {
    if (!(system.exitance.col(c).minCoeff() >= 0)) continue;
    least[c] = std::sqrt(system.transport->area().dot(system.source(c).cwiseAbs2()));
  }
  return least;
}

}  // namespace

Eigen::VectorXd IrradianceSystem::passed_on(Index c, const Column& u) const {
  Eigen::VectorXd result(u.size());
  parallel_segments(u.size(), [&](Index begin, Index n) {
    result.segment(begin, n) = rho(c).segment(begin, n).cwiseProduct(u.segment(begin, n));
  });
  if (transmission.nonZeros() > 0) result += transmission * u;
  return result;
}

Eigen::VectorXd IrradianceSystem::source(Index c) const {
  Eigen::VectorXd result = exitance.col(c);
  if (incident.size() > 0) result += passed_on(c, incident.col(c));
  return result;
}

Eigen::MatrixXd IrradianceSystem::gather(const Eigen::MatrixXd& radiosity) const {
  Eigen::MatrixXd result = transport->apply(radiosity);
  if (incident.size() > 0) result += incident;
  return result;
}

Eigen::MatrixXd IrradianceSystem::radiosity(const Eigen::MatrixXd& irradiance) const {
  Eigen::MatrixXd result = passed_on(irradiance);
  parallel_segments(size(), [&](Index begin, Index n) {
    result.middleRows(begin, n) += exitance.middleRows(begin, n);
  });
  return result;
}

Eigen::MatrixXd IrradianceSystem::passed_on(const Eigen::MatrixXd& u) const {
  Eigen::MatrixXd result(u.rows(), u.cols());
  for (Index c = 0; c < u.cols(); ++c) result.col(c) = passed_on(c, u.col(c));
  return result;
}

Eigen::MatrixXd IrradianceSystem::reflect(const Eigen::MatrixXd& u,
                                          const std::vector<Index>& columns,
                                          const Eigen::VectorXd& tolerance) const {
  Eigen::MatrixXd reflected(size(), static_cast<Index>(columns.size()));
  for (Index a = 0; a < reflected.cols(); ++a) {
    reflected.col(a) = passed_on(columns[a], u.col(columns[a]));
  }
  return tolerance.size() > 0 ? apply_by_basis(*transport, std::move(reflected), tolerance)
                              : transport->apply(reflected);
}

double IrradianceSystem::inner(Index c, const Column& u, const Column& v) const {
  const auto& area = transport->area();
  double sum = parallel_sum(u.size(), 0.0, [&](Index begin, Index n) {
    return (area.segment(begin, n).array() * rho(c).segment(begin, n).array() *
            u.segment(begin, n).array() * v.segment(begin, n).array())
        .sum();
  });
  if (transmission.nonZeros() > 0) {
    sum += (area.array() * u.array() * (transmission * v).array()).sum();
  }
  return sum;
}

double IrradianceSystem::error_bound(Index c, double residual_norm,
                                     const Column& irradiance) const {
  // The residual itself is known to a few roundings of H only.
  const double rounding =
      4 * std::numeric_limits<double>::epsilon() * std::sqrt(inner(c, irradiance, irradiance));
  const double amplification = has_bound(c) ? 1 / (1 - contraction[band(c)]) : 1;
  const double absolute =
      std::sqrt(largest_reflectance[band(c)]) * amplification * (residual_norm + rounding);
  if (absolute == 0) return 0;

  const auto& area = transport->area();
  const Eigen::VectorXd b = passed_on(c, irradiance);
  const double squared = parallel_sum(b.size(), 0.0, [&](Index begin, Index n) {
    return area.segment(begin, n).dot(
        (exitance.col(c).segment(begin, n) + b.segment(begin, n)).cwiseAbs2());
  });
  // B >= M_e + ρ H_0 where M_e >= 0 bounds ‖B‖ from below even while the iterate is poor.
  const double norm = std::max(least_radiosity[c], std::sqrt(squared) - absolute);
  return norm > 0 ? absolute / norm : std::numeric_limits<double>::infinity();
}

Eigen::VectorXd IrradianceSystem::error_bounds(const Iterate& iterate) const {
  Eigen::VectorXd bounds(n_columns());
  for (Index c = 0; c < n_columns(); ++c) {
    Eigen::VectorXd residual(size());
    parallel_segments(size(), [&](Index begin, Index n) {
      residual.segment(begin, n) =
          iterate.gathered.col(c).segment(begin, n) - iterate.irradiance.col(c).segment(begin, n);
    });
    bounds[c] = error_bound(c, std::sqrt(inner(c, residual, residual)), iterate.irradiance.col(c));
  }
  return bounds;
}

IrradianceSystem make_irradiance_system(const Transport& transport, const Eigen::MatrixXd& exitance,
                                        const Eigen::MatrixXd& reflectance, SolveMonitor& monitor) {
  const Index n = exitance.rows();
  const Index n_bands = reflectance.cols();
  IrradianceSystem system;
  system.transport = &transport;
  system.exitance = exitance;
  system.reflectance = reflectance;
  system.incident = monitor.incident();
  system.transmission = monitor.transmission();
  system.passed_share.resize(n, n_bands);
  for (Index band = 0; band < n_bands; ++band) {
    system.passed_share.col(band) = system.passed_on(band, Eigen::VectorXd::Ones(n));
  }
  const Index n_start = monitor.start().size() > 0 ? monitor.start().cols() : 0;
  Eigen::MatrixXd fields(n, 1 + n_bands + exitance.cols() + n_start);
  fields.leftCols(1 + n_bands + exitance.cols()) << Eigen::VectorXd::Ones(n), system.passed_share,
      exitance;
  if (n_start > 0) fields.rightCols(n_start) = system.passed_on(monitor.start());
  // Reflectances and sources of few materials, however many bands: known to rounding all the same.
  const Eigen::MatrixXd gathered =
      apply_by_basis(transport, fields, kRounding * energy_norms(transport, fields));
  monitor.spend(1);
  monitor.check();

  system.row_sums = gathered.col(0);
  system.seen_reflectance = gathered.middleCols(1, n_bands);
  system.direct = gathered.middleCols(1 + n_bands, exitance.cols());
  if (system.incident.size() > 0) system.direct += system.incident;
  system.reflected_start = gathered.rightCols(n_start);
  system.least_radiosity = least_radiosity(system);
  system.largest_reflectance = system.passed_share.colwise().maxCoeff().transpose();
  system.contraction.resize(n_bands);
  for (Index band = 0; band < n_bands; ++band) {
    system.contraction[band] = std::min(system.passed_on(band, system.row_sums).maxCoeff(),
                                        system.seen_reflectance.col(band).maxCoeff());
    if (system.contraction[band] < kClosedRowSum) continue;
    require_no_trapped_light(system, band, monitor);
    system.contraction[band] = refine_contraction(system, band, monitor);
  }
  return system;
}

IrradianceSystem with_exitance(const IrradianceSystem& system, Eigen::MatrixXd exitance,
                               double tolerance, SolveMonitor& monitor) {
  IrradianceSystem result;
  result.transport = system.transport;
  result.exitance = std::move(exitance);
  result.reflectance = system.reflectance;
  result.transmission = system.transmission;
  result.passed_share = system.passed_share;
  result.direct = apply_by_basis(*system.transport, result.exitance,
                                 tolerance * energy_norms(*system.transport, result.exitance));
  result.row_sums = system.row_sums;
  result.seen_reflectance = system.seen_reflectance;
  result.largest_reflectance = system.largest_reflectance;
  result.contraction = system.contraction;
  result.least_radiosity = least_radiosity(result);
  monitor.spend(1);
  return result;
}

Iterate first_iterate(const IrradianceSystem& system, const SolveMonitor& monitor) {
  Iterate iterate{Eigen::MatrixXd::Zero(system.size(), system.n_columns()), system.direct};
  if (monitor.start().size() == 0) return iterate;
  for (Index c = 0; c < system.n_columns(); ++c) {
    // Without light the solution is darkness, which no relative error allows to approach.
    if (system.exitance.col(c).isZero(0) && system.direct.col(c).isZero(0)) continue;
    iterate.irradiance.col(c) = monitor.start().col(c);
    iterate.gathered.col(c) += system.reflected_start.col(c);
  }
  return iterate;
}

StepFields step_fields(const IrradianceSystem& system, const Iterate& iterate) {
  return {.radiosity = [&system, &iterate] { return system.radiosity(iterate.irradiance); },
          .unshot = [&system,
                     &iterate] { return system.passed_on(iterate.gathered - iterate.irradiance); }};
}

std::vector<Index> columns_above(const Eigen::VectorXd& bounds, double limit) {
  std::vector<Index> columns;
  for (Index c = 0; c < bounds.size(); ++c) {
    if (!(bounds[c] <= limit)) columns.push_back(c);
  }
  return columns;
}

}  // namespace radiosity
