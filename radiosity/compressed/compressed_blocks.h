#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/base/parallel.h"
#include "radiosity/base/ranks.h"
#include "radiosity/compressed/block_product.h"
#include "radiosity/compressed/nested_basis.h"
#include "radiosity/operator/pair_sums.h"

namespace radiosity {

/// Degrees of functions of two clusters: up to one each, and up to the larger together.
struct DegreePair {
  std::int8_t a = 0;
  std::int8_t b = 0;
  /// The largest that goes with one of the first cluster.
  [[nodiscard]] int of_b(int degree_a) const { return std::min<int>(b, std::max(a, b) - degree_a); }
};

/// Calls visit(k, count) for each function k of a: it goes with [0, count) of b. `counts` tell the
/// functions up to each degree.
template <typename Counts, typename Visit>
void for_each_function(const Counts& counts_a, const Counts& counts_b, DegreePair degrees,
                       const Visit& visit) {
  int k = 0;
  for (int degree = 0; degree <= degrees.a; ++degree) {
    const int count = counts_b[degrees.of_b(degree)];
    for (; k < counts_a[degree]; ++k) visit(k, count);
  }
}

/// How many pairs of functions that makes.
template <typename Counts>
int n_coefficients(const Counts& counts_a, const Counts& counts_b, DegreePair degrees) {
  int n = 0;
  for_each_function(counts_a, counts_b, degrees, [&n](int, int count) { n += count; });
  return n;
}

/// A symmetric matrix of exchange areas G, in the order of a tree of clusters, as blocks: between
/// distant clusters the density G_ij / (A_i A_j) is a polynomial in both, between near ones all of
/// it is there. Each pair of clusters is kept once and used both ways.
struct CompressedBlocks {
  /// The density between clusters a and b: Σ_kl c_kl p_k(i) q_l(j), 1/m², over the pairs of
  /// functions of `degrees`.
  struct Far {
    std::int32_t a = 0;
    std::int32_t b = 0;
    DegreePair degrees;
    float error = 0;          ///< one standard error of the density, in common to the block, 1/m²
    std::uint64_t first = 0;  ///< into `coefficients`
    static constexpr bool may_change = true;
  };
  /// The densities themselves between two leaves, by rows.
  struct Near {
    std::int32_t a = 0;
    std::int32_t b = 0;
    float error = 0;
    bool may_change = true;   ///< not if solids or what shuts off regions may make some exactly 0
    std::uint64_t first = 0;  ///< into `densities`
  };
  NestedBasis basis;
  std::vector<Far> far;
  std::vector<float> coefficients;
  std::vector<Near> near;
  std::vector<float> densities;  ///< 1/m²
};

/// Products with such a matrix. Where there are ranks, all of which have it, products and errors
/// are asked for by all together: each works on the rows of some subtrees, and all get all.
class CompressedMatrix {
 public:
  explicit CompressedMatrix(CompressedBlocks blocks, Ranks* ranks = nullptr);

  [[nodiscard]] Index size() const;
  [[nodiscard]] const CompressedBlocks& blocks() const { return blocks_; }
  [[nodiscard]] std::size_t bytes() const;

  /// Values of rows in columns that are gone through together.
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  /// How many columns to give to a product if so many are left: 1, 4 or 8, the last of them zeros
  /// if there are fewer.
  [[nodiscard]] static Index width_of(Index n_left);
  /// Σ_j G_ij / (A_i A_j) x_j for all columns of x, n x 1, 4 or 8, in the tree's order. Parallel,
  /// with the same bits at any number of threads.
  [[nodiscard]] Rows product(const Rows& x) const;
  /// Adds Σ_b d_ab² Σ_{j ∈ b} (μ_i + μ_j) x_j over the blocks that hold row i and may change, with
  /// their errors d, to a result of n x k.
  void add_changes(const Eigen::VectorXd& multipliers, const Rows& x, Rows& result) const;
  /// Σ_b (d_ab Σ_{j ∈ b} x_j)² over the blocks that hold row i, with their errors d: n x k.
  [[nodiscard]] Eigen::MatrixXd squared_errors(const Eigen::MatrixXd& x) const;
  /// Σ_b d_ab |Σ_{j ∈ b} x_j| over the same: if errors of a row's blocks are alike.
  [[nodiscard]] Eigen::MatrixXd common_errors(const Eigen::MatrixXd& x) const;
  /// Σ_b d_ab² Σ_{j ∈ b} x_j over those of them that may change, n x k.
  [[nodiscard]] Eigen::MatrixXd variance_product(const Eigen::MatrixXd& x) const;
  /// Where a patch is.
  struct Place {
    Vec3 center = Vec3::Zero();  ///< m
    double size = 0;             ///< √A, m
  };
  /// Σ_j w_ij x_j for all columns of x, n x k, with weights of pairs in near blocks, and of the
  /// means of far ones; `places` are the rows'.
  [[nodiscard]] Eigen::MatrixXd weighted_sums(const std::vector<Place>& places,
                                              const Eigen::MatrixXd& x,
                                              const PairSums::Weight& weight) const;
  struct Entry {
    double density = 0;       ///< 1/m²
    double error = 0;         ///< of its block, 1/m²
    bool may_change = false;  ///< as its block
  };
  /// What is between two rows.
  [[nodiscard]] Entry entry(Index row, Index column) const;

 private:
  friend class GroupSquares;
  /// A block from one of its ends.
  struct Use {
    std::uint64_t first;  // of its numbers
    std::int32_t other;   // node
    float error;
    float mean;  // of a far block: its first number
    DegreePair degrees;
    bool is_a;  // whether this node is the block's a
    bool may_change;
  };
  /// The blocks of each node, as lists of what belongs together, so that nobody goes through what
  /// they don't need. First those that have no number but their mean, of far ones the most.
  struct Uses {
    struct Kind {
      DegreePair degrees;
      bool is_a;
      bool may_change;
    };
    std::vector<std::int64_t> first;   // per node
    std::vector<std::int32_t> n_even;  // per node: those with their mean alone
    std::vector<std::int32_t> other;
    std::vector<float> mean;
    std::vector<float> error;
    std::vector<Kind> kind;
    std::vector<std::uint64_t> numbers;
    [[nodiscard]] Use at(std::int64_t k) const {
      return {numbers[k],      other[k],     error[k],          mean[k],
              kind[k].degrees, kind[k].is_a, kind[k].may_change};
    }
    /// Calls visit(use) for those of a node.
    template <typename Visit>
    void visit(std::ptrdiff_t node, const Visit& visit) const {
      for (std::int64_t k = first[node]; k < first[node + 1]; ++k) visit(at(k));
    }
    [[nodiscard]] std::size_t bytes() const;
  };
  /// A node's functions: what products need of it.
  struct Functions {
    std::uint64_t first;
    std::array<std::uint8_t, NestedBasis::kMostDegree + 1> counts;
  };
  template <typename Block>
  [[nodiscard]] Uses find_uses(const std::vector<Block>& blocks) const;
  void sort_far();
  [[nodiscard]] StairMatrix numbers(std::int64_t far, std::ptrdiff_t node) const;
  template <int kColumns>
  void add_far(std::ptrdiff_t node, const double* moments, const double* totals, double* sum) const;
  template <int kColumns>
  void add_near(std::ptrdiff_t node, const double* x, double* sum) const;
  void find_subtrees();
  void find_shares();
  /// How many numbers a product goes through for a node.
  [[nodiscard]] double cost(std::int32_t node) const;
  /// This rank's subtrees, from the first to before the second; all, if it is alone.
  [[nodiscard]] std::pair<Index, Index> own_subtrees() const;
  template <typename Visit>
  void visit_own(const Visit& visit) const;
  void share(double* values, const std::vector<std::size_t>& shares, std::size_t width) const;
  template <typename Visit>
  void visit_upward(const Visit& visit) const;
  template <typename Visit>
  void visit_downward(const Visit& visit) const;
  template <typename Visit>
  void visit_near(std::int32_t k, const Visit& visit) const;
  template <typename Add>
  [[nodiscard]] Rows sum_over_blocks(const Rows& x, const Add& add) const;
  [[nodiscard]] Rows variances(const Rows& x) const;
  template <int kColumns>
  void multiply(const double* x, double* result) const;

  CompressedBlocks blocks_;
  std::vector<Functions> functions_;  // per node
  Uses far_;
  Uses near_;
  std::vector<std::int32_t> end_;       // per node: after the last one below
  std::vector<std::int32_t> subtrees_;  // nodes that are worked on in parallel with all below them
  std::vector<std::int32_t> top_;       // nodes above them
  Ranks* ranks_;
  std::vector<Index> shares_;                 // per rank: its first subtree
  std::vector<std::size_t> function_shares_;  // the first of its functions
  std::vector<std::size_t> row_shares_;       // the first of its rows
};

/// visit(node) for all nodes, each after those below it.
template <typename Visit>
void CompressedMatrix::visit_upward(const Visit& visit) const {
  parallel_for(static_cast<std::ptrdiff_t>(subtrees_.size()), [&](std::ptrdiff_t s) {
    for (std::int32_t k = end_[subtrees_[s]] - 1; k >= subtrees_[s]; --k) visit(k);
  });
  for (auto k = top_.rbegin(); k != top_.rend(); ++k) visit(*k);
}

}  // namespace radiosity
