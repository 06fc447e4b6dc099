#include "radiosity/solve/solution_error.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "radiosity/base/parallel.h"
#include "radiosity/operator/transport.h"
#include "radiosity/solve/conjugate_gradients.h"

namespace radiosity {
namespace {

/// Solutions with random signs. The standard error that they estimate is good to 1 / sqrt(2 x 4) =
/// 35 %, and only of the part that is neither local nor common to all patches, rarely a large one.
constexpr int kErrorProbes = 4;
/// Tolerance of the solutions that errors are propagated with, well below the 35 %.
constexpr double kProbeTolerance = 0.01;
constexpr std::uint64_t kProbeSeed = 1;

SolveOptions probe_options(const Progress& progress) {
  SolveOptions options;
  options.tolerance = kProbeTolerance;
  options.progress.stop = progress.stop;
  return options;
}

/// What sources of radiosity cause by reflection, (I - ρ F)^-1 of them less themselves, W/m²,
/// n x k.
Eigen::MatrixXd propagate(const IrradianceSystem& system, Eigen::MatrixXd sources,
                          const Progress& progress) {
  const SolveOptions options = probe_options(progress);
  SolveMonitor monitor(options);
  const IrradianceSystem probes =
      with_exitance(system, std::move(sources), kProbeTolerance, monitor);
  Eigen::MatrixXd reflected = unproved_irradiance(probes, monitor);
  return probes.passed_on(reflected);
}

/// The error that patches share. An error ε of H is the local error ρ ε of B, which reflection
/// carries on to P ε, P = (I - ρ F)^-1 ρ - ρ. Most of its variance lies in the mean,
///     a = Σ A P ε / Σ A φ = Σ A φ ε / Σ A φ with φ = P 1, as A P is symmetric,
/// whose moments follow in closed form from cov(ε_i, ε_j) = δ_ij σ_i² + σ²(F_ij) (A_i / A_j) B_i
/// B_j: the second term because F_ij and F_ji are the same uncertain G. The best guess of P ε from
/// a is β a, β = cov(P ε, a) / var(a) = P cov(ε, a) / var(a); what is left does not correlate with
/// a.
struct CommonError {
  Eigen::MatrixXd weight;      ///< A φ / Σ A φ, n x k
  Eigen::VectorXd variance;    ///< of a, k
  Eigen::MatrixXd covariance;  ///< of ε with a, n x k
  Eigen::MatrixXd response;    ///< β, n x k
};

/// `sigma` is the standard error σ of the irradiance, n x k.
CommonError common_error(const IrradianceSystem& system, const Eigen::MatrixXd& b,
                         const Eigen::MatrixXd& sigma, const Progress& progress) {
  const Eigen::ArrayXd area = system.transport->area().array();
  // Rounding may have left values slightly below 0.
  const Eigen::ArrayXXd light = b.array().max(0);
  const Eigen::ArrayXXd phi = propagate(system, system.passed_share, progress)
                                  .replicate(1, b.cols() / system.reflectance.cols())
                                  .array()
                                  .max(0);
  // Σ_j σ²(F_ij) φ_j B_j
  const Eigen::ArrayXXd mixed =
      system.transport->apply_error((phi * light).sqrt().matrix()).array().square();
  CommonError common;
  common.weight.resize(b.rows(), b.cols());
  common.covariance.resize(b.rows(), b.cols());
  common.variance.resize(b.cols());
  for (Index c = 0; c < b.cols(); ++c) {
    const double total = (area * phi.col(c)).sum();
    const double scale = total > 0 ? 1 / total : 0;
    common.weight.col(c) = scale * area * phi.col(c);
    common.covariance.col(c) =
        scale * area * (phi.col(c) * sigma.col(c).array().square() + light.col(c) * mixed.col(c));
    common.variance[c] = common.weight.col(c).dot(common.covariance.col(c));
  }
  common.response = propagate(system, system.passed_on(common.covariance), progress);
  for (Index c = 0; c < b.cols(); ++c) {
    if (common.variance[c] > 0) common.response.col(c) /= common.variance[c];
  }
  return common;
}

/// Mean square of what independent errors on other patches cause beyond the common error.
Eigen::MatrixXd remaining_variance(const IrradianceSystem& system, const Eigen::MatrixXd& sigma,
                                   const CommonError& common, const Progress& progress) {
  const Index k = sigma.cols();
  std::mt19937_64 random(kProbeSeed);
  Eigen::MatrixXd errors = sigma.replicate(1, kErrorProbes);
  std::vector<std::uint64_t> bits(errors.rows());
  for (std::uint64_t& word : bits) word = random();
  parallel_segments(errors.rows(), [&](Index begin, Index n) {
    for (Index column = 0; column < errors.cols(); ++column) {
      for (Index i = begin; i < begin + n; ++i) {
        if ((bits[i] >> (column / k) & 1) != 0) errors(i, column) *= -1;
      }
    }
  });
  const Eigen::MatrixXd propagated = propagate(system, system.passed_on(errors), progress);
  Eigen::MatrixXd variance = Eigen::MatrixXd::Zero(sigma.rows(), k);
  for (Index p = 0; p < errors.cols(); ++p) {
    const Index c = p % k;
    const double a = parallel_sum(errors.rows(), 0.0, [&](Index begin, Index n) {
      return common.weight.col(c).segment(begin, n).dot(errors.col(p).segment(begin, n));
    });
    parallel_segments(errors.rows(), [&](Index begin, Index n) {
      variance.col(c).segment(begin, n) +=
          (propagated.col(p).segment(begin, n) - a * common.response.col(c).segment(begin, n))
              .cwiseAbs2() /
          kErrorProbes;
    });
  }
  return variance;
}

/// Variance of B caused by the form factors' errors, n x k.
Eigen::MatrixXd transport_variance(const IrradianceSystem& system, const Eigen::MatrixXd& b,
                                   const Progress& progress) {
  const Eigen::MatrixXd sigma = system.transport->apply_error(b);
  const Eigen::MatrixXd rho = system.reflectance.replicate(1, b.cols() / system.reflectance.cols());
  const auto report = [&](double done) {
    if (progress.report) progress.report("errors", done, 3, "solves");
  };
  report(0);
  const CommonError common = common_error(system, b, sigma, progress);
  report(2);
  Eigen::MatrixXd variance = remaining_variance(system, sigma, common, progress);
  report(3);
  variance += rho.cwiseProduct(sigma).cwiseAbs2();
  if (system.transmission.nonZeros() > 0) {
    variance += system.transmission.cwiseAbs2() * sigma.cwiseAbs2();
  }
  variance += common.response.cwiseAbs2() * common.variance.asDiagonal();
  variance += 2 * common.response.cwiseProduct(system.passed_on(common.covariance));
  return variance.cwiseMax(0);
}

}  // namespace

double transport_error_bound(const IrradianceSystem& system) {
  const double delta = system.transport->error();
  if (delta == 0) return 0;
  double largest = 0;
  for (Index band = 0; band < system.contraction.size(); ++band) {
    const double rho = system.largest_reflectance[band];
    const double margin = std::max(1 - rho, 1 - system.contraction[band] - rho * delta);
    if (rho > 0 && margin <= 0) return std::numeric_limits<double>::infinity();
    largest = std::max(largest, rho * delta / margin);
  }
  return largest;
}

Eigen::MatrixXd radiosity_error(const IrradianceSystem& system, const Iterate& iterate,
                                const Progress& progress) {
  const Eigen::MatrixXd b = system.radiosity(iterate.irradiance);
  Eigen::MatrixXd variance = Eigen::MatrixXd::Zero(b.rows(), b.cols());
  if (system.transport->error() > 0) variance = transport_variance(system, b, progress);
  for (Index c = 0; c < b.cols(); ++c) {
    // Without a proof that q < 1, by how much light was amplified tells about 1 / (1 - q).
    const double emitted = system.source(c).cwiseAbs().dot(system.transport->area());
    const double total = b.col(c).cwiseAbs().dot(system.transport->area());
    const double amplification = system.has_bound(c) ? 1 / (1 - system.contraction[system.band(c)])
                                 : emitted > 0       ? std::max(1., total / emitted)
                                                     : 1.;
    const Eigen::VectorXd undone =
        system.passed_on(c, iterate.gathered.col(c) - iterate.irradiance.col(c));
    variance.col(c) += (amplification * undone).cwiseAbs2();
  }
  return variance.cwiseSqrt();
}

Eigen::MatrixXd reflected_light(const Transport& transport, const Solution& solution,
                                Eigen::MatrixXd sources, const Progress& progress) {
  SolveOptions options = probe_options(progress);
  options.transmission = solution.transmission;
  SolveMonitor monitor(options);
  // Whose own light is not asked for.
  const Eigen::MatrixXd no_exitance(transport.size(), 0);
  const IrradianceSystem system =
      make_irradiance_system(transport, no_exitance, solution.reflectance, monitor);
  return propagate(system, std::move(sources), progress);
}

}  // namespace radiosity
