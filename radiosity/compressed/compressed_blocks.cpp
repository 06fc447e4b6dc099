#include "radiosity/compressed/compressed_blocks.h"

#include <algorithm>
#include <cassert>
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
         (blocks_.coefficients.size() + blocks_.densities.size()) * sizeof(float) + far_.bytes() +
         near_.bytes() + functions_.size() * sizeof(Functions) + end_.size() * sizeof(std::int32_t);
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
  near_.visit(k, [&](const Use& use) {
    const NestedBasis::Node& other = nodes[use.other];
    const std::int32_t n_other = other.end - other.begin;
    const float* densities = &blocks_.densities[use.first];
    for (std::int32_t r = 0; r < n_rows; ++r) {
      for (std::int32_t c = 0; c < n_other; ++c) {
        visit(nodes[k].begin + r, other.begin + c,
              use.is_a ? densities[r * n_other + c] : densities[c * n_rows + r]);
      }
    }
  });
}

/// The numbers of a far block, with a row for each function of its a.
StairMatrix CompressedMatrix::numbers(std::int64_t far, std::ptrdiff_t node) const {
  const Uses::Kind& kind = far_.kind[far];
  const std::int32_t other = far_.other[far];
  const auto& counts_a = functions_[kind.is_a ? node : other].counts;
  const auto& counts_b = functions_[kind.is_a ? other : node].counts;
  StairMatrix m{&blocks_.coefficients[far_.numbers[far]], kind.degrees.a + 1, {}};
  int first = 0;
  for (int degree = 0; degree <= kind.degrees.a; ++degree) {
    m.steps[degree] = {counts_a[degree] - first, counts_b[kind.degrees.of_b(degree)]};
    first = counts_a[degree];
  }
  return m;
}

/// Adds what a node's far blocks send to its functions: M m or Mᵀ m of the moments m of the other,
/// M with a row for each function of the block's a. `moments` are those of all functions, `totals`
/// those of each node's first one.
template <int kColumns>
void CompressedMatrix::add_far(std::ptrdiff_t node, const double* moments, const double* totals,
                               double* sum) const {
  constexpr std::int64_t kAhead = 4;
  constexpr std::size_t kLine = 64 / sizeof(float);
  const std::int64_t end = far_.first[node + 1];
  const std::int64_t end_even = far_.first[node] + far_.n_even[node];
  for (std::int64_t k = far_.first[node]; k < end_even; ++k) {
    const double mean = far_.mean[k];
    const double* total = totals + far_.other[k] * std::ptrdiff_t{kColumns};
    for (int c = 0; c < kColumns; ++c) sum[c] += mean * total[c];
  }
  const auto of_other = [&](std::int64_t k) {
    return moments + functions_[far_.other[k]].first * kColumns;
  };
  for (std::int64_t k = end_even; k < end; ++k) {
    if (k + kAhead < end) {
      const float* later = blocks_.coefficients.data() + far_.numbers[k + kAhead];
      __builtin_prefetch(later);
      __builtin_prefetch(later + kLine);
      __builtin_prefetch(of_other(k + kAhead));
    }
    if (far_.kind[k].is_a) {
      add_product<kColumns>(numbers(k, node), of_other(k), sum);
    } else {
      add_transposed_product<kColumns>(numbers(k, node), of_other(k), sum);
    }
  }
}

/// The same of near blocks, from x of all rows to the sums of a node's.
template <int kColumns>
void CompressedMatrix::add_near(std::ptrdiff_t node, const double* x, double* sum) const {
  const auto& nodes = blocks_.basis.nodes;
  const int n_rows = nodes[node].end - nodes[node].begin;
  near_.visit(node, [&](const Use& use) {
    const NestedBasis::Node& other = nodes[use.other];
    const int n_other = other.end - other.begin;
    const float* densities = &blocks_.densities[use.first];
    const double* of_other = x + other.begin * std::ptrdiff_t{kColumns};
    if (use.is_a) {
      add_product<kColumns>(SmallMatrix{densities, n_rows, n_other}, of_other, sum);
    } else {
      add_transposed_product<kColumns>(SmallMatrix{densities, n_other, n_rows}, of_other, sum);
    }
  });
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
  const auto totals = std::make_unique_for_overwrite<double[]>(nodes.size() * kColumns);
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
  parallel_for(
      static_cast<std::ptrdiff_t>(nodes.size()),
      [&](std::ptrdiff_t k) {
        std::copy_n(at(moments, functions_[k].first), kColumns, &totals[k * kColumns]);
      },
      kRowGrain);

  const auto exchange = [&](std::ptrdiff_t k) {
    const NestedBasis::Node& node = nodes[k];
    double* functions = at(gathered, node.first);
    std::fill_n(functions, node.used * kColumns, 0.0);
    add_far<kColumns>(k, moments.get(), totals.get(), functions);
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

Index CompressedMatrix::width_of(Index n_left) {
  if (n_left <= 1) return 1;
  return n_left > kFewColumns ? kManyColumns : kFewColumns;
}

CompressedMatrix::Rows CompressedMatrix::product(const Rows& x) const {
  Rows result(x.rows(), x.cols());
  if (x.cols() == kManyColumns) {
    multiply<kManyColumns>(x.data(), result.data());
  } else if (x.cols() == kFewColumns) {
    multiply<kFewColumns>(x.data(), result.data());
  } else {
    assert(x.cols() == 1);
    multiply<1>(x.data(), result.data());
  }
  return result;
}

/// Σ add(block, Σ_{j ∈ b} x_j) over the blocks that hold each row.
template <typename Add>
CompressedMatrix::Rows CompressedMatrix::sum_over_blocks(const Rows& x, const Add& add) const {
  const auto& nodes = blocks_.basis.nodes;
  const Index width = x.cols();
  Rows result(x.rows(), width);
  std::vector<double> sums(nodes.size() * width);
  std::vector<double> gathered(nodes.size() * width);
  const auto at = [width](std::vector<double>& field, std::ptrdiff_t k) {
    return Eigen::Map<Eigen::RowVectorXd>(field.data() + k * width, width);
  };
  visit_upward([&](std::int32_t k) {
    const NestedBasis::Node& node = nodes[k];
    if (node.is_leaf()) {
      at(sums, k) = x.middleRows(node.begin, node.end - node.begin).colwise().sum();
    } else {
      at(sums, k) = at(sums, node.left) + at(sums, node.right);
    }
  });
  visit_own([&](std::ptrdiff_t k) {
    double* own = gathered.data() + k * width;
    std::fill_n(own, width, 0.0);
    const auto add_use = [&](const Use& use) {
      const double* of_other = sums.data() + use.other * width;
      for (Index c = 0; c < width; ++c) own[c] += add(use, of_other[c]);
    };
    far_.visit(k, add_use);
    near_.visit(k, add_use);
  });
  visit_downward([&](std::int32_t k) {
    const NestedBasis::Node& node = nodes[k];
    if (node.is_leaf()) {
      result.middleRows(node.begin, node.end - node.begin).rowwise() = at(gathered, k);
      return;
    }
    at(gathered, node.left) += at(gathered, k);
    at(gathered, node.right) += at(gathered, k);
  });
  share(result.data(), row_shares_, width);
  return result;
}

Eigen::MatrixXd CompressedMatrix::squared_errors(const Eigen::MatrixXd& x) const {
  return sum_over_blocks(
      x, [](const Use& block, double sum) { return square(double{block.error} * sum); });
}

Eigen::MatrixXd CompressedMatrix::common_errors(const Eigen::MatrixXd& x) const {
  return sum_over_blocks(
      x, [](const Use& block, double sum) { return double{block.error} * std::abs(sum); });
}

Eigen::MatrixXd CompressedMatrix::variance_product(const Eigen::MatrixXd& x) const {
  return variances(x);
}

CompressedMatrix::Rows CompressedMatrix::variances(const Rows& x) const {
  return sum_over_blocks(x, [](const Use& block, double sum) {
    return block.may_change ? square(double{block.error}) * sum : 0.0;
  });
}

void CompressedMatrix::add_changes(const Eigen::VectorXd& multipliers, const Rows& x,
                                   Rows& result) const {
  const Index width = x.cols();
  Rows both(x.rows(), 2 * width);
  parallel_ranges(x.rows(), kRowGrain, [&](Index begin, Index end) {
    for (Index row = begin; row < end; ++row) {
      both.row(row) << x.row(row), multipliers[row] * x.row(row);
    }
  });
  const Rows changes = variances(both);
  parallel_ranges(x.rows(), kRowGrain, [&](Index begin, Index end) {
    for (Index row = begin; row < end; ++row) {
      result.row(row) +=
          multipliers[row] * changes.row(row).head(width) + changes.row(row).tail(width);
    }
  });
}

Eigen::MatrixXd CompressedMatrix::weighted_sums(const std::vector<Place>& places,
                                                const Eigen::MatrixXd& x,
                                                const PairSums::Weight& weight) const {
  const auto& nodes = blocks_.basis.nodes;
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
    far_.visit(k, [&](const Use& use) {
      // The first functions are 1, and the others' means 0.
      gathered.row(k) += weigh(use.mean, means[k], means[use.other]) * sums.row(use.other);
    });
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
