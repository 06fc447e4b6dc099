#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "radiosity/compressed/block_fit.h"
#include "radiosity/compressed/cluster_shapes.h"
#include "radiosity/visibility/cluster_tree.h"

namespace radiosity {

/// Chooses pairs of patches of two clusters from which their block is made: the same ones whatever
/// the number of threads.
class PairSampler {
 public:
  /// What is sampled, of two patches.
  using Density = std::function<double(std::int32_t i, std::int32_t j)>;

  /// All must outlive this.
  PairSampler(const ClusterTree& tree, const ClusterShapes& shapes,
              const std::vector<double>& areas);

  [[nodiscard]] std::size_t n_pairs(std::int32_t a, std::int32_t b) const;

  /// Adds samples, evenly spread, until there are n; or takes all pairs if these are few: true.
  bool add(std::int32_t a, std::int32_t b, std::size_t n, const Density& density,
           std::vector<DensitySample>& samples) const;

  /// Adds the pairs of the clusters' furthest patches, where kernels peak.
  void add_corners(std::int32_t a, std::int32_t b, const Density& density,
                   std::vector<DensitySample>& samples) const;

 private:
  const ClusterTree& tree_;
  const ClusterShapes& shapes_;
  const std::vector<double>& areas_;
};

}  // namespace radiosity
