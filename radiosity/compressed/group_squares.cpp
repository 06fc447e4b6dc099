#include "radiosity/compressed/group_squares.h"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <tuple>

namespace radiosity {
namespace {

/// Values of the functions of one node.
using Values = std::array<double, std::numeric_limits<std::uint8_t>::max()>;

}  // namespace

GroupSquares::GroupSquares(const CompressedMatrix& matrix, const Eigen::VectorXd& weight)
    : matrix_(matrix), weight_(weight) {
  const auto& nodes = matrix.blocks().basis.nodes;
  parent_.assign(nodes.size(), -1);
  leaf_.resize(matrix.size());
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const auto number = static_cast<std::int32_t>(k);
    if (nodes[k].is_leaf()) {
      std::fill(leaf_.begin() + nodes[k].begin, leaf_.begin() + nodes[k].end, number);
    } else {
      parent_[nodes[k].left] = parent_[nodes[k].right] = number;
    }
  }
  make_grams(weight);
}

void GroupSquares::make_grams(const Eigen::VectorXd& weight) {
  const auto& nodes = matrix_.blocks().basis.nodes;
  const float* numbers = matrix_.blocks().basis.numbers.data();
  first_gram_.resize(nodes.size() + 1, 0);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    first_gram_[k + 1] = first_gram_[k] + std::uint64_t{nodes[k].used} * nodes[k].used;
  }
  grams_.resize(first_gram_.back());
  using Matrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  matrix_.visit_upward([&](std::int32_t k) {
    const NestedBasis::Node& node = nodes[k];
    Eigen::Map<Matrix> gram(&grams_[first_gram_[k]], node.used, node.used);
    if (node.is_leaf()) {
      const Index n = node.end - node.begin;
      const Eigen::Map<const Matrix> values(numbers + node.values, n, node.used);
      const Eigen::VectorXf w = weight.segment(node.begin, n).cast<float>();
      gram = values.transpose() * w.asDiagonal() * values;
      return;
    }
    gram.setZero();
    for (const std::int32_t child : {node.left, node.right}) {
      const Index n = nodes[child].used;
      const Eigen::Map<const Matrix> transfer(numbers + nodes[child].transfer, node.used, n);
      const Eigen::Map<const Matrix> below(&grams_[first_gram_[child]], n, n);
      gram += transfer * below * transfer.transpose();
    }
  });
}

void GroupSquares::find_moments(std::span<const std::int32_t> rows, const Eigen::VectorXd& x,
                                Worker& worker) const {
  const auto& nodes = matrix_.blocks().basis.nodes;
  const float* numbers = matrix_.blocks().basis.numbers.data();
  worker.path.clear();
  for (const std::int32_t row : rows) {
    for (std::int32_t k = leaf_[row]; k >= 0 && worker.slot_of_node[k] < 0; k = parent_[k]) {
      worker.slot_of_node[k] = 0;
      worker.path.push_back(k);
    }
  }
  std::sort(worker.path.begin(), worker.path.end(), std::greater<>());
  worker.first.clear();
  std::size_t n = 0;
  for (std::size_t slot = 0; slot < worker.path.size(); ++slot) {
    worker.slot_of_node[worker.path[slot]] = static_cast<std::int32_t>(slot);
    worker.first.push_back(n);
    n += nodes[worker.path[slot]].used;
  }
  worker.moments.assign(n, 0);
  for (const std::int32_t row : rows) {
    const std::int32_t k = leaf_[row];
    const float* value = numbers + nodes[k].values + (row - nodes[k].begin) * nodes[k].used;
    const std::int32_t slot = worker.slot_of_node[k];
    double* own = worker.moments.data() + worker.first[slot];
    for (int f = 0; f < nodes[k].used; ++f) own[f] += *value++ * x[row];
  }
  for (std::size_t slot = 0; slot < worker.path.size(); ++slot) {
    const std::int32_t k = worker.path[slot];
    if (parent_[k] < 0) continue;
    const std::int32_t above = worker.slot_of_node[parent_[k]];
    const float* transfer = numbers + nodes[k].transfer;
    const double* own = worker.moments.data() + worker.first[slot];
    double* sum = worker.moments.data() + worker.first[above];
    for (int f = 0; f < nodes[parent_[k]].used; ++f) {
      for (int g = 0; g < nodes[k].used; ++g) sum[f] += *transfer++ * own[g];
    }
  }
}

void GroupSquares::find_shares(Worker& worker) const {
  worker.shares.clear();
  const auto add = [&](const CompressedMatrix::Uses& uses, std::int32_t k, bool is_near) {
    uses.visit(k, [&](const CompressedMatrix::Use& use) {
      worker.shares.push_back({use.other, is_near, k, use.first, use.degrees, use.is_a});
    });
  };
  for (const std::int32_t k : worker.path) {
    add(matrix_.far_, k, false);
    add(matrix_.near_, k, true);
  }
  std::sort(worker.shares.begin(), worker.shares.end(), [](const auto& one, const auto& other) {
    return std::tuple(one.node, one.is_near, one.from) <
           std::tuple(other.node, other.is_near, other.from);
  });
}

void GroupSquares::add_far(const Worker::Share& share, const Worker& worker, double* values) const {
  const CompressedBlocks& blocks = matrix_.blocks();
  const auto& nodes = blocks.basis.nodes;
  const float* coefficients = &blocks.coefficients[share.first];
  const double* moments = worker.moments.data() + worker.first[worker.slot_of_node[share.from]];
  for_each_function(nodes[share.from_a ? share.from : share.node].counts,
                    nodes[share.from_a ? share.node : share.from].counts, share.degrees,
                    [&](int row, int count) {
                      for (int l = 0; l < count; ++l) {
                        const double c = *coefficients++;
                        if (share.from_a) {
                          values[l] += c * moments[row];
                        } else {
                          values[row] += c * moments[l];
                        }
                      }
                    });
}

void GroupSquares::add_near(const Worker::Share& share, std::span<const std::int32_t> rows,
                            const Eigen::VectorXd& x, Worker& worker) const {
  const CompressedBlocks& blocks = matrix_.blocks();
  const NestedBasis::Node& from = blocks.basis.nodes[share.from];
  const NestedBasis::Node& node = blocks.basis.nodes[share.node];
  const std::int32_t n = node.end - node.begin;
  const std::int32_t n_from = from.end - from.begin;
  const float* densities = &blocks.densities[share.first];
  for (const std::int32_t row : rows) {
    if (leaf_[row] != share.from) continue;
    const std::int32_t j = row - from.begin;
    for (std::int32_t i = 0; i < n; ++i) {
      const float density = share.from_a ? densities[j * n + i] : densities[i * n_from + j];
      worker.near[i] += density * x[row];
    }
  }
}

/// Σ_i w_i (Σ_k p_k(i) v_k)² over the rows of a node.
double GroupSquares::square(std::int32_t node, const double* values) const {
  const int n = matrix_.blocks().basis.nodes[node].used;
  const float* gram = grams_.data() + first_gram_[node];
  double sum = 0;
  for (int f = 0; f < n; ++f) {
    double inner = 0;
    for (int g = 0; g < n; ++g) inner += *gram++ * values[g];
    sum += values[f] * inner;
  }
  return std::max(sum, 0.0);
}

/// Of the rows of a node, given what they get of blocks above and the shares of it and all below.
double GroupSquares::descend(std::int32_t node, const double* from_above, Shares shares,
                             std::span<const std::int32_t> rows, const Eigen::VectorXd& x,
                             Worker& worker) const {
  const NestedBasis& basis = matrix_.blocks().basis;
  const NestedBasis::Node& its = basis.nodes[node];
  Values values;
  std::copy_n(from_above, its.used, values.begin());
  std::size_t k = 0;
  for (; k < shares.size() && shares[k].node == node && !shares[k].is_near; ++k) {
    add_far(shares[k], worker, values.data());
  }
  if (k == shares.size()) return square(node, values.data());
  double sum = 0;
  if (its.is_leaf()) {
    worker.near.assign(its.end - its.begin, 0);
    for (; k < shares.size(); ++k) add_near(shares[k], rows, x, worker);
    const float* value = basis.numbers.data() + its.values;
    for (std::int32_t row = its.begin; row < its.end; ++row) {
      double received = worker.near[row - its.begin];
      for (int f = 0; f < its.used; ++f) received += *value++ * values[f];
      sum += weight_[row] * received * received;
    }
    return sum;
  }
  shares = shares.subspan(k);
  const auto of_right = std::partition_point(
      shares.begin(), shares.end(), [&](const auto& share) { return share.node < its.right; });
  const auto n_left = static_cast<std::size_t>(of_right - shares.begin());
  for (const std::int32_t child : {its.left, its.right}) {
    const float* transfer = basis.numbers.data() + basis.nodes[child].transfer;
    const int n = basis.nodes[child].used;
    Values below;
    std::fill_n(below.begin(), n, 0.0);
    for (int f = 0; f < its.used; ++f) {
      for (int g = 0; g < n; ++g) below[g] += *transfer++ * values[f];
    }
    sum +=
        descend(child, below.data(),
                child == its.left ? shares.first(n_left) : shares.subspan(n_left), rows, x, worker);
  }
  return sum;
}

double GroupSquares::operator()(std::span<const std::int32_t> rows, const Eigen::VectorXd& x,
                                Worker& worker) const {
  find_moments(rows, x, worker);
  find_shares(worker);
  const Shares shares(worker.shares);
  const Values nothing{};
  double sum = 0;
  for (std::size_t k = 0; k < shares.size();) {
    const std::int32_t node = shares[k].node;
    std::size_t end = k + 1;
    while (end < shares.size() && shares[end].node < matrix_.end_[node]) ++end;
    sum += descend(node, nothing.data(), shares.subspan(k, end - k), rows, x, worker);
    k = end;
  }
  for (const std::int32_t k : worker.path) worker.slot_of_node[k] = -1;
  return sum;
}

}  // namespace radiosity
