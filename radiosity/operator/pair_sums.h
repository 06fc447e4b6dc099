#pragma once

#include <Eigen/Core>
#include <functional>

#include "radiosity/base/progress.h"
#include "radiosity/scene/neighbor_groups.h"
#include "radiosity/scene/patch_mesh.h"

namespace radiosity {

/// How two patches, or two clusters of them, exchange light.
struct ExchangingPair {
  double density;     ///< G_ij / (A_i A_j), 1/m²
  double distance;    ///< of the centroids, m
  double size;        ///< of the one that receives, √A, m
  double other_size;  ///< of the other, m
};

/// Sums over the pairs of an operator that has no quick rows, but clusters of patches that exchange
/// light alike. The same bits at any number of threads.
class PairSums {
 public:
  virtual ~PairSums() = default;
  using Weight = std::function<double(const ExchangingPair& pair)>;
  /// Σ_j w_ij x_j for all columns of x, n x k: each pair of patches that are close is visited,
  /// others are by their clusters' means. Corrections are left out. `mesh` is the operator's.
  [[nodiscard]] virtual Eigen::MatrixXd sums(const PatchMesh& mesh, const Eigen::MatrixXd& x,
                                             const Weight& weight) const = 0;
  /// Σ_i w_i (Σ_{j in J} κ_ij x_j)² of each group J, n_groups, with the densities κ, 1/m², as the
  /// operator has them but for corrections, of x and weights w >= 0, n. The time it takes hardly
  /// grows faster than n. Throws Interrupted.
  [[nodiscard]] virtual Eigen::VectorXd squares_of_groups(const NeighborGroups& groups,
                                                          const Eigen::VectorXd& x,
                                                          const Eigen::VectorXd& weight,
                                                          const Progress& progress) const = 0;
};

}  // namespace radiosity
