#include "radiosity/compressed/compressed_blocks.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "radiosity/base/parallel.h"
#include "radiosity/compressed/block_product.h"

namespace radiosity {
namespace {

constexpr std::ptrdiff_t kNodeGrain = 64;
constexpr Index kRowGrain = 4096;

}  // namespace

Index CompressedMatrix::size() const {
  return blocks_.basis.nodes.empty() ? 0 : blocks_.basis.nodes[0].end;
}

std::size_t CompressedMatrix::bytes() const {
  return blocks_.basis.bytes() + blocks_.far.size() * sizeof(CompressedBlocks::Far) +
         blocks_.near.size() * sizeof(CompressedBlocks::Near) +
         (blocks_.coefficients.size() + blocks_.densities.size()) * sizeof(float) +
         (far_.all.size() + near_.all.size()) * sizeof(Use) +
         (far_.first.size() + near_.first.size()) * sizeof(std::int64_t) +
         functions_.size() * sizeof(Functions) + end_.size() * sizeof(std::int32_t);
}

/// visit(node), in parallel, for all nodes of the own subtrees and above all subtrees.
template <typename Visit>
void CompressedMatrix::visit_own(const Visit& visit) const {
  const auto [first, last] = own_subtrees();
  const std::int32_t begin = first < last ? subtrees_[first] : 0;
  const std::int32_t end = first < last ? end_[subtrees_[last - 1]] : 0;
  parallel_for(
      end - begin, [&](std::ptrdiff_t k) { visit(begin + k); }, kNodeGrain);
  for (const std::int32_t k : top_) {
    if (k < begin || k >= end) visit(k);
  }
}

/// visit(node) for the nodes above all subtrees and in the own ones, each before those below it.
template <typename Visit>
void CompressedMatrix::visit_downward(const Visit& visit) const {
  for (const std::int32_t k : top_) visit(k);
  const auto [first, last] = own_subtrees();
  parallel_for(last - first, [&, begin = first](std::ptrdiff_t s) {
    const std::int32_t root = subtrees_[begin + s];
    for (std::int32_t k = root; k < end_[root]; ++k) visit(k);
  });
}

/// Calls visit(row, column, density) for the entries of a node's rows in near blocks.
template <typename Visit>
void CompressedMatrix::visit_near(std::int32_t k, const Visit& visit) const {
  const auto& nodes = blocks_.basis.nodes;
  const std::int32_t n_rows = nodes[k].end - nodes[k].begin;
  for (const Use& use : near_.of(k)) {
    const NestedBasis::Node& other = nodes[use.other];
    const std::int32_t n_other = other.end - other.begin;
    const float* densities = &blocks_.densities[use.first];
    for (std::int32_t r = 0; r < n_rows; ++r) {
      for (std::int32_t c = 0; c < n_other; ++c) {
        visit(nodes[k].begin + r, other.begin + c,
              use.is_a ? densities[r * n_other + c] : densities[c * n_rows + r]);
      }
    }
  }
}

/// Adds what a node's far blocks send to its functions: M m or Mᵀ m of the moments m of the other,
/// M with a row for each function of the block's a. `moments` are those of all functions.
template <int kColumns>
void CompressedMatrix::add_far(std::ptrdiff_t node, const double* moments, double* sum) const {
  constexpr std::ptrdiff_t kAhead = 4;
  const std::span<const Use> uses = far_.of(node);
  for (std::size_t u = 0; u < uses.size(); ++u) {
    const Use& use = uses[u];
    if (u + kAhead < uses.size()) {
      const Use& later = uses[u + kAhead];
      __builtin_prefetch(&blocks_.coefficients[later.first]);
      __builtin_prefetch(moments + functions_[later.other].first * kColumns);
    }
    const double* of_other = moments + functions_[use.other].first * kColumns;
    const auto& counts_a = functions_[use.is_a ? node : use.other].counts;
    const auto& counts_b = functions_[use.is_a ? use.other : node].counts;
    const float* coefficients = &blocks_.coefficients[use.first];
    int first = 0;
    for (int degree = 0; degree <= use.degrees.a; ++degree) {
      const int n_rows = counts_a[degree] - first;
      const SmallMatrix m{coefficients, n_rows, counts_b[use.degrees.of_b(degree)]};
      if (use.is_a) {
        add_product<kColumns>(m, of_other, sum + first * kColumns);
      } else {
        add_transposed_product<kColumns>(m, of_other + first * kColumns, sum);
      }
      coefficients += n_rows * m.n_columns;
      first += n_rows;
    }
  }
}

/// The same of near blocks, from x of all rows to the sums of a node's.
template <int kColumns>
void CompressedMatrix::add_near(std::ptrdiff_t node, const double* x, double* sum) const {
  const auto& nodes = blocks_.basis.nodes;
  const int n_rows = nodes[node].end - nodes[node].begin;
  for (const Use& use : near_.of(node)) {
    const NestedBasis::Node& other = nodes[use.other];
    const int n_other = other.end - other.begin;
    const float* densities = &blocks_.densities[use.first];
    const double* of_other = x + other.begin * std::ptrdiff_t{kColumns};
    if (use.is_a) {
      add_product<kColumns>({densities, n_rows, n_other}, of_other, sum);
    } else {
      add_transposed_product<kColumns>({densities, n_other, n_rows}, of_other, sum);
    }
  }
}

template <int kColumns>
void CompressedMatrix::multiply(const double* x, double* result) const {
  const auto& nodes = blocks_.basis.nodes;
  const float* numbers = blocks_.basis.numbers.data();
  // Each thread clears what it is the first to use: new memory is slow.
  const auto moments =
      std::make_unique_for_overwrite<double[]>(blocks_.basis.n_functions * kColumns);
  const auto gathered =
      std::make_unique_for_overwrite<double[]>(blocks_.basis.n_functions * kColumns);
  const auto values = [&](const NestedBasis::Node& leaf) {
    return SmallMatrix{numbers + leaf.values, leaf.end - leaf.begin, leaf.used};
  };
  const auto transfer = [&](const NestedBasis::Node& node, std::int32_t child) {
    return SmallMatrix{numbers + nodes[child].transfer, node.used, nodes[child].used};
  };
  const auto at = [](const std::unique_ptr<double[]>& field, std::uint64_t first) {
    return field.get() + first * kColumns;
  };

  const auto add_moments = [&](std::int32_t k) {
    const NestedBasis::Node& node = nodes[k];
    double* own = at(moments, node.first);
    std::fill_n(own, node.used * kColumns, 0.0);
    if (node.is_leaf()) {
      add_transposed_product<kColumns>(values(node), x + node.begin * std::ptrdiff_t{kColumns},
                                       own);
      return;
    }
    for (const std::int32_t child : {node.left, node.right}) {
      add_product<kColumns>(transfer(node, child), at(moments, nodes[child].first), own);
    }
  };
  const auto [first_subtree, last_subtree] = own_subtrees();
  parallel_for(last_subtree - first_subtree, [&, begin = first_subtree](std::ptrdiff_t s) {
    const std::int32_t root = subtrees_[begin + s];
    for (std::int32_t k = end_[root] - 1; k >= root; --k) add_moments(k);
  });
  share(moments.get(), function_shares_, kColumns);
  for (auto k = top_.rbegin(); k != top_.rend(); ++k) add_moments(*k);

  const auto exchange = [&](std::ptrdiff_t k) {
    const NestedBasis::Node& node = nodes[k];
    double* functions = at(gathered, node.first);
    std::fill_n(functions, node.used * kColumns, 0.0);
    add_far<kColumns>(k, moments.get(), functions);
    if (!node.is_leaf()) return;
    double* rows = result + node.begin * std::ptrdiff_t{kColumns};
    std::fill_n(rows, (node.end - node.begin) * std::ptrdiff_t{kColumns}, 0.0);
    add_near<kColumns>(k, x, rows);
  };
  visit_own(exchange);

  visit_downward([&](std::int32_t k) {
    const NestedBasis::Node& node = nodes[k];
    const double* own = at(gathered, node.first);
    if (node.is_leaf()) {
      add_product<kColumns>(values(node), own, result + node.begin * std::ptrdiff_t{kColumns});
      return;
    }
    for (const std::int32_t child : {node.left, node.right}) {
      add_transposed_product<kColumns>(transfer(node, child), own,
                                       at(gathered, nodes[child].first));
    }
  });
  share(result, row_shares_, kColumns);
}

Eigen::MatrixXd CompressedMatrix::product(const Eigen::MatrixXd& x) const {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Index n = x.rows();
  Eigen::MatrixXd result(n, x.cols());
  for (Index first = 0; first < x.cols();) {
    const Index left = x.cols() - first;
    if (left == 1) {
      multiply<1>(x.col(first).data(), result.col(first).data());
      break;
    }
    const Index width = left > kFewColumns ? kManyColumns : kFewColumns;
    const Index n_columns = std::min(width, left);
    Rows in(n, width);
    Rows out(n, width);
    parallel_ranges(n, kRowGrain, [&](Index begin, Index end) {
      in.block(begin, 0, end - begin, n_columns) = x.block(begin, first, end - begin, n_columns);
      in.block(begin, n_columns, end - begin, width - n_columns).setZero();
    });
    if (width == kManyColumns) {
      multiply<kManyColumns>(in.data(), out.data());
    } else {
      multiply<kFewColumns>(in.data(), out.data());
    }
    parallel_ranges(n, kRowGrain, [&](Index begin, Index end) {
      result.block(begin, first, end - begin, n_columns) =
          out.block(begin, 0, end - begin, n_columns);
    });
    first += n_columns;
  }
  return result;
}

/// Σ add(block, Σ_{j ∈ b} x_j) over the blocks that hold each row.
template <typename Add>
Eigen::MatrixXd CompressedMatrix::sum_over_blocks(const Eigen::MatrixXd& x, const Add& add) const {
  const auto& nodes = blocks_.basis.nodes;
  Eigen::MatrixXd result(x.rows(), x.cols());
  std::vector<double> sums(nodes.size());
  std::vector<double> gathered(nodes.size());
  for (Index column = 0; column < x.cols(); ++column) {
    visit_upward([&](std::int32_t k) {
      const NestedBasis::Node& node = nodes[k];
      sums[k] = node.is_leaf() ? x.col(column).segment(node.begin, node.end - node.begin).sum()
                               : sums[node.left] + sums[node.right];
    });
    visit_own([&](std::ptrdiff_t k) {
      gathered[k] = 0;
      for (const Use& use : far_.of(k)) gathered[k] += add(use, sums[use.other]);
      for (const Use& use : near_.of(k)) gathered[k] += add(use, sums[use.other]);
    });
    visit_downward([&](std::int32_t k) {
      const NestedBasis::Node& node = nodes[k];
      if (node.is_leaf()) {
        result.col(column).segment(node.begin, node.end - node.begin).setConstant(gathered[k]);
        return;
      }
      gathered[node.left] += gathered[k];
      gathered[node.right] += gathered[k];
    });
    share(result.col(column).data(), row_shares_, 1);
  }
  return result;
}

Eigen::MatrixXd CompressedMatrix::squared_errors(const Eigen::MatrixXd& x) const {
  return sum_over_blocks(
      x, [](const auto& block, double sum) { return square(double{block.error} * sum); });
}

Eigen::MatrixXd CompressedMatrix::common_errors(const Eigen::MatrixXd& x) const {
  return sum_over_blocks(
      x, [](const auto& block, double sum) { return double{block.error} * std::abs(sum); });
}

Eigen::MatrixXd CompressedMatrix::variance_product(const Eigen::MatrixXd& x) const {
  return sum_over_blocks(x, [](const auto& block, double sum) {
    return block.may_change ? square(double{block.error}) * sum : 0.0;
  });
}

Eigen::MatrixXd CompressedMatrix::weighted_sums(const std::vector<Place>& places,
                                                const Eigen::MatrixXd& x,
                                                const PairSums::Weight& weight) const {
  const auto& nodes = blocks_.basis.nodes;
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto n_nodes = static_cast<Index>(nodes.size());
  const Rows in = x;
  Rows result = Rows::Zero(x.rows(), x.cols());
  Rows sums(n_nodes, x.cols());
  Rows gathered(n_nodes, x.cols());
  std::vector<Place> means(nodes.size());
  visit_upward([&](std::int32_t k) {
    const NestedBasis::Node& node = nodes[k];
    const double n = node.end - node.begin;
    if (node.is_leaf()) {
      sums.row(k) = in.middleRows(node.begin, node.end - node.begin).colwise().sum();
      for (std::int32_t row = node.begin; row < node.end; ++row) {
        means[k].center += places[row].center / n;
        means[k].size += places[row].size / n;
      }
      return;
    }
    sums.row(k) = sums.row(node.left) + sums.row(node.right);
    for (const std::int32_t child : {node.left, node.right}) {
      const double share = (nodes[child].end - nodes[child].begin) / n;
      means[k].center += share * means[child].center;
      means[k].size += share * means[child].size;
    }
  });
  const auto weigh = [&](double density, const Place& one, const Place& other) {
    return weight({density, (one.center - other.center).norm(), one.size, other.size});
  };
  visit_own([&](std::ptrdiff_t k) {
    gathered.row(k).setZero();
    for (const Use& use : far_.of(k)) {
      // The first functions are 1, and the others' means 0.
      const double density = blocks_.coefficients[use.first];
      gathered.row(k) += weigh(density, means[k], means[use.other]) * sums.row(use.other);
    }
    visit_near(static_cast<std::int32_t>(k),
               [&](std::int32_t row, std::int32_t column, float density) {
                 if (density == 0) return;
                 result.row(row) += weigh(density, places[row], places[column]) * in.row(column);
               });
  });
  visit_downward([&](std::int32_t k) {
    const NestedBasis::Node& node = nodes[k];
    if (node.is_leaf()) {
      result.middleRows(node.begin, node.end - node.begin).rowwise() += gathered.row(k);
      return;
    }
    gathered.row(node.left) += gathered.row(k);
    gathered.row(node.right) += gathered.row(k);
  });
  share(result.data(), row_shares_, x.cols());
  return result;
}

}  // namespace radiosity
