#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "radiosity/compressed/compressed_blocks.h"

namespace radiosity {

/// What all rows of a compressed matrix get of a few, in the mean square: Σ_i w_i (Σ_{j in J} κ_ij
/// x_j)² of groups J of rows, κ the densities. Blocks that hold several rows of a group are gone
/// through once; what a cluster gets is squared as a whole, by the inner products of its functions.
class GroupSquares {
 public:
  /// `weight` w >= 0 of each row, n. The matrix must outlive this.
  GroupSquares(const CompressedMatrix& matrix, const Eigen::VectorXd& weight);

  /// What one thread needs.
  class Worker {
   public:
    explicit Worker(const GroupSquares& owner) : slot_of_node(owner.parent_.size(), -1) {}

   private:
    friend class GroupSquares;
    /// What a node gets through one block.
    struct Share {
      std::int32_t node;
      bool is_near;
      std::int32_t from;    // node that holds rows of the group
      std::uint64_t first;  // of the block's numbers
      DegreePair degrees;
      bool from_a;  // whether that node is the block's a
    };
    std::vector<std::int32_t> slot_of_node;  // into `path`; -1 of those that hold no row
    std::vector<std::int32_t>
        path;  // nodes that hold rows of the group, each before those above it
    std::vector<std::size_t> first;  // into `moments`, per node of the path
    std::vector<double> moments;     // of their functions
    std::vector<Share> shares;
    std::vector<double> near;  // per row of a leaf
  };

  /// Of the rows of one group and its x: n values, of which only those of the group are used.
  [[nodiscard]] double operator()(std::span<const std::int32_t> rows, const Eigen::VectorXd& x,
                                  Worker& worker) const;

 private:
  using Shares = std::span<const Worker::Share>;
  void make_grams(const Eigen::VectorXd& weight);
  void find_moments(std::span<const std::int32_t> rows, const Eigen::VectorXd& x,
                    Worker& worker) const;
  void find_shares(Worker& worker) const;
  void add_far(const Worker::Share& share, const Worker& worker, double* values) const;
  void add_near(const Worker::Share& share, std::span<const std::int32_t> rows,
                const Eigen::VectorXd& x, Worker& worker) const;
  [[nodiscard]] double square(std::int32_t node, const double* values) const;
  double descend(std::int32_t node, const double* from_above, Shares shares,
                 std::span<const std::int32_t> rows, const Eigen::VectorXd& x,
                 Worker& worker) const;

  const CompressedMatrix& matrix_;
  const Eigen::VectorXd weight_;
  std::vector<std::int32_t> parent_;       // per node; -1 of the root
  std::vector<std::int32_t> leaf_;         // per row
  std::vector<std::uint64_t> first_gram_;  // per node, into `grams_`
  std::vector<float> grams_;               // Σ w_i p_k(i) p_l(i), used x used of each node
};

}  // namespace radiosity
