#include "radiosity/solve/refinement.h"

#include <algorithm>
#include <numeric>

#include "radiosity/base/parallel.h"
#include "radiosity/operator/aggregated_transport.h"
#include "radiosity/scene/corner_values.h"
#include "radiosity/solve/discretisation_error.h"

namespace radiosity {
namespace {

/// Weight of the picture's squared error beside that of the mean radiosities.
constexpr double kPictureWeight = 0.01;

/// The bands in one: each relative to its mean reflected light.
struct GreyFields {
  Eigen::VectorXd radiosity;
  Eigen::VectorXd reflectance;
  Eigen::VectorXd weight;  ///< 1 / reflected light, bounded
};

GreyFields grey_fields(const Eigen::VectorXd& area, const Solution& solution) {
  const Index n = area.size();
  GreyFields grey{Eigen::VectorXd::Zero(n), solution.reflectance.rowwise().mean(),
                  Eigen::VectorXd::Zero(n)};
  Eigen::VectorXd reflected = Eigen::VectorXd::Zero(n);
  Index n_lit = 0;
  const Eigen::MatrixXd exchanged = solution.exchanged_radiosity();
  for (Index c = 0; c < solution.radiosity.cols(); ++c) {
    const Eigen::VectorXd band = exchanged.col(c);
    const double mean = area.dot(band) / area.sum();
    if (!(mean > 0)) continue;
    ++n_lit;
    grey.radiosity += solution.radiosity.col(c) / mean;
    reflected += band / mean;
  }
  if (n_lit == 0) return grey;
  grey.radiosity /= static_cast<double>(n_lit);
  reflected /= static_cast<double>(n_lit);
  grey.weight = reflected.cwiseMax(kDarkShare).cwiseInverse();
  return grey;
}

/// Σ_i A_i w_i² (ρ_i Σ_{j in J} F_ij d_j)² of each group J, d the radiosity less its group's mean.
Eigen::VectorXd received_wrongly(const Transport& transport, const NeighborGroups& groups,
                                 const GreyFields& grey, const Eigen::VectorXd& deviation,
                                 const Progress& progress) {
  if (const PairSums* pairs = transport.pair_sums()) {
    const Eigen::VectorXd factor = grey.weight.cwiseProduct(grey.reflectance);
    return pairs->squares_of_groups(groups, transport.area().cwiseProduct(deviation),
                                    transport.area().cwiseProduct(factor.cwiseAbs2()), progress);
  }
  constexpr Index kBlock = 64;  // rows summed together, so that the order of sums is fixed
  const Index n = transport.size();
  const Index n_blocks = (n + kBlock - 1) / kBlock;
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(groups.n_groups, n_blocks);
  parallel_for(n_blocks, [&](Index block) {
    progress.check();
    Eigen::VectorXd received(groups.n_groups);
    for (Index i = block * kBlock; i < std::min(n, (block + 1) * kBlock); ++i) {
      if (grey.reflectance[i] == 0) continue;
      const Eigen::VectorXd row = rows_of(transport).row(i);
      received.setZero();
      for (Index j = 0; j < n; ++j) received[groups.group_of[j]] += row[j] * deviation[j];
      const double factor = grey.weight[i] * grey.reflectance[i];
      sums.col(block) += transport.area()[i] * factor * factor * received.cwiseAbs2();
    }
  });
  return sums.rowwise().sum();
}

}  // namespace

RefinementIndicator refinement_indicator(const PatchMesh& mesh, const Transport& transport,
                                         const Solution& solution, const Progress& progress) {
  RefinementIndicator result;
  result.groups = make_neighbor_groups(mesh);
  const Eigen::VectorXd& area = transport.area();
  const GreyFields grey = grey_fields(area, solution);
  const AggregatedTransport aggregated(transport, result.groups);
  const Eigen::VectorXd deviation =
      grey.radiosity - aggregated.spread(aggregated.means(grey.radiosity)).col(0);
  result.squared_error = received_wrongly(transport, result.groups, grey, deviation, progress);

  const Eigen::MatrixXd shown = corner_values(mesh, grey.radiosity);
  for (Index i = 0; i < mesh.size(); ++i) {
    const Index n_corners = mesh.n_corners(i);
    const double off = shown.col(0).segment(4 * i, n_corners).mean() - grey.radiosity[i];
    result.squared_error[result.groups.group_of[i]] +=
        kPictureWeight * area[i] * grey.weight[i] * grey.weight[i] * off * off;
  }
  result.squared_error /= area.sum();
  return result;
}

std::vector<Index> patches_to_refine(const RefinementIndicator& indicator, double share,
                                     Index most) {
  std::vector<Index> order(indicator.groups.n_groups);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
    return indicator.squared_error[a] > indicator.squared_error[b];
  });
  std::vector<Index> n_patches(order.size(), 0);
  for (const std::int32_t group : indicator.groups.group_of) ++n_patches[group];
  std::vector<bool> is_marked(order.size(), false);
  double left = share * indicator.squared_error.sum();
  for (const Index group : order) {
    most -= n_patches[group];
    if (left <= 0 || most < 0) break;
    left -= indicator.squared_error[group];
    is_marked[group] = true;
  }
  std::vector<Index> patches;
  for (std::size_t i = 0; i < indicator.groups.group_of.size(); ++i) {
    if (is_marked[indicator.groups.group_of[i]]) patches.push_back(static_cast<Index>(i));
  }
  return patches;
}

}  // namespace radiosity
