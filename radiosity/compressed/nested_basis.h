#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "radiosity/base/geometry.h"

namespace radiosity {

/// Functions on the clusters of a tree of patches. A cluster's parent has, on the cluster, only
/// combinations of the cluster's own, so that sums over patches take linear time for all clusters
/// together. The first function of each cluster is 1, and Σ_i A_i p_k(i) p_l(i) = A δ_kl.
struct NestedBasis {
  static constexpr int kMostDegree = 4;

  struct Node {
    std::int32_t begin = 0;  ///< rows: patches in the tree's order
    std::int32_t end = 0;
    std::int32_t left = -1;  ///< nodes below, which follow this one; -1 of a leaf
    std::int32_t right = -1;
    std::array<std::uint8_t, kMostDegree + 1> counts{};  ///< functions up to each degree
    std::uint8_t used = 0;                               ///< functions that are there
    double area = 0;                                     ///< m²
    std::uint64_t first = 0;     ///< number of its first function, of all nodes'
    std::uint64_t transfer = 0;  ///< into `numbers`: used of its parent x used; none of the root
    std::uint64_t values = 0;    ///< into `numbers`, of a leaf: rows x used
    [[nodiscard]] bool is_leaf() const { return left < 0; }
  };
  std::vector<Node> nodes;        ///< [0] is the root; the nodes below each follow it
  std::vector<float> numbers;     ///< transfers and values, by rows
  std::uint64_t n_functions = 0;  ///< of all nodes

  [[nodiscard]] std::size_t bytes() const {
    return nodes.size() * sizeof(Node) + numbers.size() * sizeof(float);
  }
};

}  // namespace radiosity
