#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "radiosity/base/progress.h"
#include "radiosity/operator/transport.h"

namespace radiosity {

/// How heat is exchanged by radiation between s nodes, reflections and all: node s gains from node
/// t the heat σ GR_st (T_t⁴ - T_s⁴). A node is a surface, a patch or any group of patches.
struct ExchangeNetwork {
  Eigen::VectorXd area;      ///< of the nodes' patches, m², s
  Eigen::VectorXd emitting;  ///< Σ ε A, m², s
  /// GR_st = Σ_{i in s} Σ_{j in t} ε_i A_i B_ij with Gebhart's factors B (Gebhart 1961), m²,
  /// symmetric to the last bit, s x s. The diagonal is what comes back to the node itself.
  Eigen::MatrixXd couplings;
  Eigen::MatrixXd error;     ///< one standard error of these, from the form factors', m², at most
  Eigen::VectorXd to_space;  ///< the same with what leaves the scene, m²; 0 in closed scenes
  /// And with what has no temperature, m²: backs of one-sided surfaces, and what covers a part of
  /// the node where it lies on a solid's face. With both, rows of `couplings` sum to `emitting`.
  Eigen::VectorXd to_backs;
  double error_bound = 0;  ///< guaranteed bound on the iteration's relative error, ‖ΔB‖/‖B‖
  /// The largest |GR_st - GR_ts| as both were found, of the smaller emitting area, before their
  /// mean was taken.
  double asymmetry = 0;

  /// Gebhart's factors: the share of what node s emits that node t absorbs, GR_st / Σ ε A; 0 of
  /// nodes that emit nothing.
  [[nodiscard]] Eigen::MatrixXd gebhart() const;
  /// Script-F (Hottel): GR_st / A_s.
  [[nodiscard]] Eigen::MatrixXd script_f() const;
};

struct NetworkOptions {
  double tolerance = 1e-12;  ///< guaranteed bound on the iteration's relative error
  Progress progress = {};    ///< reports "nodes"
};

/// The network of nodes 0 to n_nodes - 1: `node` tells each patch's, `emissivity` is n, from 0 (it
/// reflects all, a node of such patches couples to nothing) to 1. Takes one solve for each node,
/// many of them at once, and n x s numbers. Throws SolveError if sizes do not fit or a value is out
/// of range; Interrupted.
ExchangeNetwork exchange_network(const Transport& transport, const Eigen::VectorXd& emissivity,
                                 const std::vector<std::int32_t>& node, Index n_nodes,
                                 const NetworkOptions& options = {});

/// The network without couplings between two nodes that are less than `share` of what either emits,
/// but for each node's largest. The others, and those to space and backs, grow so that each node
/// keeps what it couples to all others; returns how many pairs were left out.
std::int64_t drop_small_couplings(ExchangeNetwork& network, double share);

}  // namespace radiosity
