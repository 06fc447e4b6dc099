#include "radiosity/solve/discretisation_error.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "radiosity/operator/aggregated_transport.h"
#include "radiosity/solve/solve.h"
#include "radiosity/solve/uneven_light.h"

namespace radiosity {
namespace {

/// Tolerance of the coarser solutions; changes are 1e-3 at 1e5 patches.
constexpr double kTolerance = 1e-5;
/// Range of the ratio 2^p of changes that is believed: from order 1 (light that stops at a line) to
/// 1.6, though smooth light has order 2, as patches of different sizes make the measured one
/// uneven.
constexpr double kLeastRatio = 2;
constexpr double kLargestRatio = 3;

/// Norm of a field of n x k, with areas as weights: of all columns, each relative to `scale`.
double norm(const Eigen::VectorXd& area, const Eigen::MatrixXd& field,
            const Eigen::VectorXd& scale) {
  double sum = 0;
  for (Index c = 0; c < field.cols(); ++c) {
    if (scale[c] > 0) sum += area.dot(field.col(c).cwiseAbs2()) / (scale[c] * scale[c]);
  }
  return std::sqrt(sum);
}

Solution solve_coarser(const AggregatedTransport& coarser, const Solution& solution,
                       const Progress& progress) {
  SolveOptions options;
  options.tolerance = kTolerance;
  options.start = coarser.means(solution.irradiance);
  if (solution.incident.size() > 0) options.incident = coarser.means(solution.incident);
  if (solution.transmission.size() > 0) options.transmission = coarser.means(solution.transmission);
  options.has_sinks = (solution.exitance.array() < 0).any();
  options.progress.stop = progress.stop;
  return solve(coarser, coarser.means(solution.exitance), coarser.means(solution.reflectance),
               options);
}

/// Patches alone in their group.
std::vector<Index> find_lone(const NeighborGroups& groups) {
  std::vector<std::int32_t> size(groups.n_groups, 0);
  for (const std::int32_t g : groups.group_of) ++size[g];
  std::vector<Index> lone;
  for (std::size_t i = 0; i < groups.group_of.size(); ++i) {
    if (size[groups.group_of[i]] == 1) lone.push_back(static_cast<Index>(i));
  }
  return lone;
}

/// Reflected light, but no less than kDarkShare of its mean.
Eigen::VectorXd light_scale(const Eigen::VectorXd& area, const Eigen::VectorXd& reflected) {
  return reflected.cwiseMax(kDarkShare * area.dot(reflected) / area.sum());
}

/// Gives patches alone in their group, which coarser patches tell nothing about, no smaller a
/// square of the error than the others have on average, relative to their light.
void assume_for_lone(const std::vector<Index>& lone, const Eigen::VectorXd& area,
                     const Eigen::MatrixXd& reflected, Eigen::MatrixXd& squared) {
  Eigen::VectorXd others = area;
  for (const Index i : lone) others[i] = 0;
  if (!(others.sum() > 0)) return;
  for (Index c = 0; c < squared.cols(); ++c) {
    const Eigen::VectorXd light = light_scale(area, reflected.col(c)).cwiseAbs2();
    if (!(light.minCoeff() > 0)) continue;
    const double relative = others.dot(squared.col(c).cwiseQuotient(light)) / others.sum();
    for (const Index i : lone) squared(i, c) = std::max(squared(i, c), relative * light[i]);
  }
}

/// What share of the reflected light some patches have, largest over the bands.
double share_of(const std::vector<Index>& patches, const Eigen::VectorXd& area,
                const Eigen::MatrixXd& reflected) {
  double largest = 0;
  for (Index c = 0; c < reflected.cols(); ++c) {
    double sum = 0;
    for (const Index i : patches) sum += area[i] * reflected(i, c);
    const double all = area.dot(reflected.col(c));
    if (all > 0) largest = std::max(largest, sum / all);
  }
  return largest;
}

/// Root mean square over the area of the errors relative to the reflected light, largest over the
/// bands.
double relative_error(const Eigen::VectorXd& area, const Eigen::MatrixXd& reflected,
                      const Eigen::MatrixXd& error) {
  double largest = 0;
  for (Index c = 0; c < error.cols(); ++c) {
    const double mean = area.dot(reflected.col(c)) / area.sum();
    if (!(mean > 0)) continue;
    const Eigen::VectorXd relative =
        error.col(c).cwiseQuotient(light_scale(area, reflected.col(c)));
    largest = std::max(largest, std::sqrt(area.dot(relative.cwiseAbs2()) / area.sum()));
  }
  return largest;
}

}  // namespace

DiscretisationError discretisation_error(const PatchMesh& mesh, const Transport& transport,
                                         const Solution& solution, const Progress& progress) {
  const auto report = [&](double done) {
    if (progress.report) progress.report("patch size", done, 3, "solves");
  };
  report(0);
  const NeighborGroups groups = make_neighbor_groups(mesh);
  const NeighborGroups coarser_groups = make_coarser_groups(mesh, groups);
  const AggregatedTransport coarser(transport, groups);
  const AggregatedTransport coarsest(transport, coarser_groups);

  DiscretisationError result;
  const Eigen::MatrixXd means = coarser.spread(coarser.means(solution.radiosity));
  const Eigen::MatrixXd once = coarser.spread(solve_coarser(coarser, solution, progress).radiosity);
  report(1);
  const Eigen::MatrixXd twice =
      coarsest.spread(solve_coarser(coarsest, solution, progress).radiosity);
  report(2);
  const Progress quiet{.report = {}, .stop = progress.stop};
  result.change = means - once;
  const Eigen::MatrixXd earlier_change = coarsest.spread(coarsest.means(once)) - twice;

  const Eigen::VectorXd& area = transport.area();
  const Eigen::MatrixXd reflected = solution.exchanged_radiosity();
  Eigen::VectorXd scale(reflected.cols());
  for (Index c = 0; c < scale.size(); ++c) {
    scale[c] = std::sqrt(area.dot(reflected.col(c).cwiseAbs2()));
  }
  const double last = norm(area, coarsest.spread(coarsest.means(result.change)), scale);
  const double before = norm(area, earlier_change, scale);
  const double ratio =
      last > 0 ? std::clamp(before / last, kLeastRatio, kLargestRatio) : kLargestRatio;
  result.order = std::log2(ratio);

  // A patch's own change may happen to be small.
  const Eigen::MatrixXd squared = result.change.cwiseAbs2();
  const Eigen::MatrixXd around = coarsest.spread(coarsest.means(squared));
  Eigen::MatrixXd left = (squared + around) / (2 * (ratio - 1) * (ratio - 1));
  const std::vector<Index> lone = find_lone(groups);
  assume_for_lone(lone, area, reflected, left);
  if (transport.has_quick_rows() || transport.shared_rows() != nullptr ||
      transport.pair_sums() != nullptr) {
    left += uneven_light_error(mesh, transport, solution, groups, quiet).cwiseAbs2();
  }
  result.error = left.cwiseSqrt();
  result.n_unknown = static_cast<Index>(lone.size());
  result.unknown_share = share_of(lone, area, reflected);
  // Where no light of patches arrives at all there is none to be wrong about.
  result.error = (solution.exchanged_irradiance().array() == 0).select(0, result.error);
  result.relative = relative_error(area, reflected, result.error);
  report(3);
  return result;
}

Solution with_discretisation_error(Solution solution, const DiscretisationError& discretisation) {
  solution.radiosity_error =
      (solution.radiosity_error.cwiseAbs2() + discretisation.error.cwiseAbs2()).cwiseSqrt();
  return solution;
}

}  // namespace radiosity
