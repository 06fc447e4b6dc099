#include "radiosity/solve/exchange_network.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "radiosity/base/error.h"
#include "radiosity/solve/solve.h"

namespace radiosity {
namespace {

/// Nodes that are solved at once: as many columns as go through an operator together, times some.
constexpr Index kColumns = 32;
/// Balancing ends where sums are this near, or after so many rounds.
constexpr double kBalanced = 1e-14;
constexpr int kMostRounds = 1000;

void check(const Transport& transport, const Eigen::VectorXd& emissivity,
           const std::vector<std::int32_t>& node, Index n_nodes) {
  const Index n = transport.size();
  if (emissivity.size() != n || static_cast<Index>(node.size()) != n) {
    throw SolveError("there are " + std::to_string(n) + " patches, but " +
                     std::to_string(emissivity.size()) + " emissivities and nodes of " +
                     std::to_string(node.size()));
  }
  for (Index i = 0; i < n; ++i) {
    if (!(emissivity[i] >= 0 && emissivity[i] <= 1)) {
      throw SolveError("emissivity " + std::to_string(emissivity[i]) + " of patch " +
                       std::to_string(i) + ", expected 0 to 1");
    }
    if (node[i] < 0 || node[i] >= n_nodes) {
      throw SolveError("patch " + std::to_string(i) + " belongs to node " +
                       std::to_string(node[i]) + ", expected 0 to " + std::to_string(n_nodes - 1));
    }
  }
}

/// What the radiosities B_s of all nodes' emission make of the entries' errors: to first order a
/// change dG of the exchange areas changes GR_st by B_sᵀ dG B_t. As each pair stands for two
/// entries, (a + b)² <= 2 (a² + b²) doubles the variance at most.
Eigen::MatrixXd coupling_errors(const Transport& transport, const Eigen::MatrixXd& radiosity,
                                const Progress& progress) {
  const Index n_nodes = radiosity.cols();
  const Eigen::ArrayXd area = transport.area().array();
  const Eigen::MatrixXd weights = (radiosity.array().colwise() * area).square();
  Eigen::MatrixXd variance(n_nodes, n_nodes);
  for (Index first = 0; first < n_nodes; first += kColumns) {
    progress.check();
    const Index n = std::min(kColumns, n_nodes - first);
    const Eigen::MatrixXd irradiance_errors = transport.apply_error(radiosity.middleCols(first, n));
    variance.middleCols(first, n).noalias() =
        2 * (weights.transpose() * irradiance_errors.cwiseAbs2());
  }
  // Both orders bound the same variance.
  return variance.cwiseMin(variance.transpose()).cwiseSqrt();
}

}  // namespace

ExchangeNetwork exchange_network(const Transport& transport, const Eigen::VectorXd& emissivity,
                                 const std::vector<std::int32_t>& node, Index n_nodes,
                                 const NetworkOptions& options) {
  check(transport, emissivity, node, n_nodes);
  const Index n = transport.size();
  const Eigen::VectorXd& area = transport.area();
  const Eigen::VectorXd reflectance = 1 - emissivity.array();
  ExchangeNetwork result{.area = Eigen::VectorXd::Zero(n_nodes),
                         .emitting = Eigen::VectorXd::Zero(n_nodes),
                         .couplings = Eigen::MatrixXd::Zero(n_nodes, n_nodes),
                         .error = {},
                         .to_space = Eigen::VectorXd::Zero(n_nodes),
                         .to_backs = Eigen::VectorXd::Zero(n_nodes)};
  for (Index i = 0; i < n; ++i) {
    result.area[node[i]] += area[i];
    result.emitting[node[i]] += emissivity[i] * area[i];
  }
  Eigen::MatrixXd radiosity(n, n_nodes);
  for (Index first = 0; first < n_nodes; first += kColumns) {
    options.progress.check();
    const Index n_columns = std::min(kColumns, n_nodes - first);
    Eigen::MatrixXd exitance = Eigen::MatrixXd::Zero(n, n_columns);
    for (Index i = 0; i < n; ++i) {
      const Index column = node[i] - first;
      if (column >= 0 && column < n_columns) exitance(i, column) = emissivity[i];
    }
    const Solution solution = solve(transport, exitance, reflectance,
                                    {.tolerance = options.tolerance,
                                     .estimates_errors = false,
                                     .progress = {.report = {}, .stop = options.progress.stop}});
    radiosity.middleCols(first, n_columns) = solution.radiosity;
    for (Index i = 0; i < n; ++i) {
      result.couplings.row(node[i]).segment(first, n_columns) +=
          emissivity[i] * area[i] * solution.irradiance.row(i);
    }
    result.to_space.segment(first, n_columns) = solution.energy.escaped;
    result.to_backs.segment(first, n_columns) = solution.energy.absorbed;
    result.error_bound = std::max(result.error_bound, solution.error_bound);
    if (options.progress.report) {
      options.progress.report("nodes", static_cast<double>(first + n_columns),
                              static_cast<double>(n_nodes), "");
    }
  }
  // What is absorbed, but not by the nodes.
  result.to_backs -= result.couplings.colwise().sum().transpose();
  for (Index s = 0; s < n_nodes; ++s) {
    for (Index t = 0; t < s; ++t) {
      const double smaller = std::min(result.emitting[s], result.emitting[t]);
      double& one = result.couplings(s, t);
      double& other = result.couplings(t, s);
      if (smaller > 0)
        result.asymmetry = std::max(result.asymmetry, std::abs(one - other) / smaller);
      one = other = 0.5 * (one + other);
    }
  }
  // What is less than the rounding of the sums that it is left over from is none.
  const double rounding = 1e3 * std::numeric_limits<double>::epsilon();
  for (Eigen::VectorXd* losses : {&result.to_space, &result.to_backs}) {
    for (Index s = 0; s < n_nodes; ++s) {
      if ((*losses)[s] < (rounding + options.tolerance) * result.emitting[s]) (*losses)[s] = 0;
    }
  }
  result.error = coupling_errors(transport, radiosity, options.progress);
  return result;
}

Eigen::MatrixXd ExchangeNetwork::gebhart() const {
  Eigen::MatrixXd result = couplings;
  for (Index s = 0; s < result.rows(); ++s) {
    if (emitting[s] > 0) result.row(s) /= emitting[s];
  }
  return result;
}

Eigen::MatrixXd ExchangeNetwork::script_f() const {
  return area.cwiseInverse().asDiagonal() * couplings;
}

std::int64_t drop_small_couplings(ExchangeNetwork& network, double share) {
  Eigen::MatrixXd& couplings = network.couplings;
  const Index n = couplings.rows();
  const auto others = [&](Index s) {
    return couplings.row(s).sum() - couplings(s, s) + network.to_space[s] + network.to_backs[s];
  };
  Eigen::VectorXd wanted(n);
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(n);
  for (Index s = 0; s < n; ++s) {
    wanted[s] = others(s);
    for (Index t = 0; t < n; ++t) {
      if (t != s) largest[s] = std::max(largest[s], couplings(s, t));
    }
  }
  std::int64_t n_dropped = 0;
  for (Index s = 0; s < n; ++s) {
    for (Index t = 0; t < s; ++t) {
      const double coupling = couplings(s, t);
      if (coupling == 0 || coupling == largest[s] || coupling == largest[t]) continue;
      if (coupling >= share * std::min(network.emitting[s], network.emitting[t])) continue;
      couplings(s, t) = couplings(t, s) = 0;
      network.error(s, t) = network.error(t, s) = 0;
      ++n_dropped;
    }
  }
  if (n_dropped == 0) return 0;
  // A symmetric matrix is scaled by rows and columns alike.
  for (int round = 0; round < kMostRounds; ++round) {
    Eigen::VectorXd scale(n);
    double off = 0;
    for (Index s = 0; s < n; ++s) {
      const double sum = others(s);
      scale[s] = sum > 0 ? std::sqrt(wanted[s] / sum) : 1;
      off = std::max(off, std::abs(scale[s] - 1));
    }
    if (off < kBalanced) break;
    for (Index s = 0; s < n; ++s) {
      for (Index t = 0; t < s; ++t) {
        couplings(s, t) *= scale[s] * scale[t];
        couplings(t, s) = couplings(s, t);
      }
      network.to_space[s] *= scale[s] * scale[s];
      network.to_backs[s] *= scale[s] * scale[s];
    }
  }
  return n_dropped;
}

}  // namespace radiosity
