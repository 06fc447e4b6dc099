#include "study/settled_emissivity.h"

#include <fmt/format.h>

#include <cmath>

#include "radiosity/scene/emissivity_table.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/solve/conditions.h"
#include "radiosity/solve/solve_conditions.h"

namespace study {
namespace {

using namespace radiosity;

constexpr int kMostSolves = 50;
/// Of the tolerance: what temperatures may still change by.
constexpr double kSettledShare = 1e-3;

/// Where nothing is known, what the mean of the known ones is, if there are any.
Eigen::VectorXd first_guess(Eigen::VectorXd given) {
  double sum = 0;
  Index n = 0;
  for (const double kelvin : given) {
    if (std::isnan(kelvin)) continue;
    sum += kelvin;
    ++n;
  }
  const double guess = n > 0 ? sum / static_cast<double>(n) : kUsualTemperature;
  for (double& kelvin : given) {
    if (std::isnan(kelvin)) kelvin = guess;
  }
  return given;
}

/// As radiosity::temperatures, but of emissivities that are not right yet: 0 where no temperature
/// gives off so little.
Eigen::VectorXd found_temperatures(const Solution& solution, const Eigen::VectorXd& emissivity) {
  const Eigen::ArrayXd b = solution.radiosity.col(0);
  const Eigen::ArrayXd h = solution.irradiance.col(0);
  const Eigen::ArrayXd emitted = (b - (1 - emissivity.array()) * h) / emissivity.array();
  const Eigen::ArrayXd black = (emissivity.array() > 0).select(emitted, b);
  return (black.max(0) / kStefanBoltzmann).pow(0.25);
}

}  // namespace

SettledEmissivity settle_emissivity(const Scene& scene, const PatchMesh& mesh,
                                    const Transport& transport, const Eigen::MatrixXd& sun,
                                    const StudyOptions& options, const StudyEvents& events) {
  const double limit = kSettledShare * options.tolerance;
  SettledEmissivity result;
  EmissivityIteration& iteration = result.iteration;
  Eigen::VectorXd kelvin = first_guess(given_temperatures(scene, mesh));
  Eigen::MatrixXd start;
  do {
    result.emissivity = emissivity_at(scene, mesh, kelvin);
    const Conditions conditions =
        make_conditions(scene, mesh, transport, sun, {}, result.emissivity);
    SolveOptions solving = with_conditions({.method = options.method,
                                            .solver = options.solver,
                                            .tolerance = iteration_tolerance(options.tolerance),
                                            .estimates_errors = false,
                                            .progress = events.progress},
                                           conditions, 1);
    solving.start = start;
    const Solution solution = solve(mesh, transport, conditions, solving);
    start = solution.irradiance;
    const Eigen::VectorXd found = found_temperatures(solution, result.emissivity);
    iteration.change =
        ((found - kelvin).array().abs() / found.cwiseMax(kelvin).array().max(1e-300)).maxCoeff();
    kelvin = found;
  } while (++iteration.n_solves < kMostSolves && iteration.change > limit);
  result.emissivity = emissivity_at(scene, mesh, kelvin);
  iteration.settled = iteration.change <= limit;
  if (!iteration.settled) {
    events.warn(fmt::format(
        "emissivities that depend on temperatures did not settle in {} solves: temperatures still "
        "change by {:.2g} of themselves",
        iteration.n_solves, iteration.change));
  }
  return result;
}

}  // namespace study
