#include "radiosity/compressed/compressed_blocks.h"

#include <algorithm>
#include <cmath>

#include "radiosity/base/parallel.h"

namespace radiosity {
namespace {

/// Parts of a tree that are worked on in parallel, at least, if it is large.
constexpr Index kSubtrees = 256;
constexpr Index kSmallSubtree = 512;
constexpr std::ptrdiff_t kNodeGrain = 64;
/// Columns that go through the matrix at once.
constexpr Index kColumnsAtOnce = 4;

/// sum += values[k] * x, for kColumns columns.
template <int kColumns>
inline void add_scaled(double factor, const double* x, double* sum) {
  for (int c = 0; c < kColumns; ++c) sum[c] += factor * x[c];
}

}  // namespace

CompressedMatrix::CompressedMatrix(CompressedBlocks blocks) : blocks_(std::move(blocks)) {
  far_ = find_uses(blocks_.far);
  near_ = find_uses(blocks_.near);
  find_subtrees();
}

Index CompressedMatrix::size() const {
  return blocks_.basis.nodes.empty() ? 0 : blocks_.basis.nodes[0].end;
}

std::size_t CompressedMatrix::bytes() const {
  return blocks_.basis.bytes() + blocks_.far.size() * sizeof(CompressedBlocks::Far) +
         blocks_.near.size() * sizeof(CompressedBlocks::Near) +
         (blocks_.coefficients.size() + blocks_.densities.size()) * sizeof(float) +
         (far_.all.size() + near_.all.size()) * sizeof(Use) +
         (far_.first.size() + near_.first.size()) * sizeof(std::int64_t) +
         end_.size() * sizeof(std::int32_t);
}

template <typename Block>
CompressedMatrix::Uses CompressedMatrix::find_uses(const std::vector<Block>& blocks) const {
  Uses uses;
  uses.first.assign(blocks_.basis.nodes.size() + 1, 0);
  for (const Block& block : blocks) {
    ++uses.first[block.a + 1];
    if (block.a != block.b) ++uses.first[block.b + 1];
  }
  for (std::size_t k = 1; k < uses.first.size(); ++k) uses.first[k] += uses.first[k - 1];
  uses.all.resize(uses.first.back());
  std::vector<std::int64_t> next(uses.first.begin(), uses.first.end() - 1);
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const Block& block = blocks[k];
    const auto number = static_cast<std::int32_t>(k);
    uses.all[next[block.a]++] = {block.b, number, true};
    if (block.a != block.b) uses.all[next[block.b]++] = {block.a, number, false};
  }
  return uses;
}

void CompressedMatrix::find_subtrees() {
  const auto& nodes = blocks_.basis.nodes;
  end_.resize(nodes.size());
  for (auto k = static_cast<std::int32_t>(nodes.size()) - 1; k >= 0; --k) {
    end_[k] = nodes[k].is_leaf() ? k + 1 : end_[nodes[k].right];
  }
  const Index largest = std::max(size() / kSubtrees, kSmallSubtree);
  for (std::int32_t k = 0; k < static_cast<std::int32_t>(nodes.size());) {
    if (nodes[k].is_leaf() || nodes[k].end - nodes[k].begin <= largest) {
      subtrees_.push_back(k);
      k = end_[k];
    } else {
      top_.push_back(k++);
    }
  }
}

/// visit(node) for all nodes, each before those below it.
template <typename Visit>
void CompressedMatrix::visit_downward(const Visit& visit) const {
  for (const std::int32_t k : top_) visit(k);
  parallel_for(static_cast<std::ptrdiff_t>(subtrees_.size()), [&](std::ptrdiff_t s) {
    for (std::int32_t k = subtrees_[s]; k < end_[subtrees_[s]]; ++k) visit(k);
  });
}

/// Calls visit(row, column, density) for the entries of a node's rows in near blocks.
template <typename Visit>
void CompressedMatrix::visit_near(std::int32_t k, const Visit& visit) const {
  const auto& nodes = blocks_.basis.nodes;
  const std::int32_t n_rows = nodes[k].end - nodes[k].begin;
  for (std::int64_t u = near_.first[k]; u < near_.first[k + 1]; ++u) {
    const Use& use = near_.all[u];
    const NestedBasis::Node& other = nodes[use.other];
    const std::int32_t n_other = other.end - other.begin;
    const float* densities = &blocks_.densities[blocks_.near[use.block].first];
    for (std::int32_t r = 0; r < n_rows; ++r) {
      for (std::int32_t c = 0; c < n_other; ++c) {
        visit(nodes[k].begin + r, other.begin + c,
              use.is_a ? densities[r * n_other + c] : densities[c * n_rows + r]);
      }
    }
  }
}

template <int kColumns>
void CompressedMatrix::add_product(const double* x, double* result) const {
  const auto& nodes = blocks_.basis.nodes;
  const float* numbers = blocks_.basis.numbers.data();
  std::vector<double> moments(blocks_.basis.n_functions * kColumns);
  std::vector<double> gathered(blocks_.basis.n_functions * kColumns);

  const auto gather_moments = [&](std::int32_t k) {
    const NestedBasis::Node& node = nodes[k];
    double* own = &moments[node.first * kColumns];
    if (node.is_leaf()) {
      const float* value = numbers + node.values;
      for (std::int32_t row = node.begin; row < node.end; ++row) {
        for (int f = 0; f < node.used; ++f) {
          add_scaled<kColumns>(*value++, x + row * kColumns, own + f * kColumns);
        }
      }
      return;
    }
    for (const std::int32_t child : {node.left, node.right}) {
      const float* transfer = numbers + nodes[child].transfer;
      const double* below = &moments[nodes[child].first * kColumns];
      for (int f = 0; f < node.used; ++f) {
        for (int g = 0; g < nodes[child].used; ++g) {
          add_scaled<kColumns>(*transfer++, below + g * kColumns, own + f * kColumns);
        }
      }
    }
  };
  visit_upward(gather_moments);

  const auto exchange_far = [&](std::ptrdiff_t k) {
    double* sum = &gathered[nodes[k].first * kColumns];
    for (std::int64_t u = far_.first[k]; u < far_.first[k + 1]; ++u) {
      const Use& use = far_.all[u];
      const CompressedBlocks::Far& block = blocks_.far[use.block];
      const float* coefficients = &blocks_.coefficients[block.first];
      const double* of_other = &moments[nodes[use.other].first * kColumns];
      for_each_function(
          nodes[block.a].counts, nodes[block.b].counts, block.degrees, [&](int row, int count) {
            const float* c = coefficients;
            coefficients += count;
            if (use.is_a) {
              for (int l = 0; l < count; ++l) {
                add_scaled<kColumns>(c[l], of_other + l * kColumns, sum + row * kColumns);
              }
            } else {
              for (int l = 0; l < count; ++l) {
                add_scaled<kColumns>(c[l], of_other + row * kColumns, sum + l * kColumns);
              }
            }
          });
    }
    if (!nodes[k].is_leaf()) return;
    visit_near(static_cast<std::int32_t>(k),
               [&](std::int32_t row, std::int32_t column, float density) {
                 add_scaled<kColumns>(density, x + column * kColumns, result + row * kColumns);
               });
  };
  parallel_for(static_cast<std::ptrdiff_t>(nodes.size()), exchange_far, kNodeGrain);

  const auto hand_down = [&](std::int32_t k) {
    const NestedBasis::Node& node = nodes[k];
    const double* own = &gathered[node.first * kColumns];
    if (node.is_leaf()) {
      const float* value = numbers + node.values;
      for (std::int32_t row = node.begin; row < node.end; ++row) {
        for (int f = 0; f < node.used; ++f) {
          add_scaled<kColumns>(*value++, own + f * kColumns, result + row * kColumns);
        }
      }
      return;
    }
    for (const std::int32_t child : {node.left, node.right}) {
      const float* transfer = numbers + nodes[child].transfer;
      double* below = &gathered[nodes[child].first * kColumns];
      for (int f = 0; f < node.used; ++f) {
        for (int g = 0; g < nodes[child].used; ++g) {
          add_scaled<kColumns>(*transfer++, own + f * kColumns, below + g * kColumns);
        }
      }
    }
  };
  visit_downward(hand_down);
}

Eigen::MatrixXd CompressedMatrix::product(const Eigen::MatrixXd& x) const {
  const Index n = x.rows();
  Eigen::MatrixXd result(n, x.cols());
  for (Index first = 0; first < x.cols(); first += kColumnsAtOnce) {
    const Index n_columns = std::min(kColumnsAtOnce, x.cols() - first);
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Index width = n_columns == 1 ? 1 : kColumnsAtOnce;
    Rows in = Rows::Zero(n, width);
    Rows out = Rows::Zero(n, width);
    in.leftCols(n_columns) = x.middleCols(first, n_columns);
    if (n_columns == 1) {
      add_product<1>(in.data(), out.data());
    } else {
      add_product<kColumnsAtOnce>(in.data(), out.data());
    }
    result.middleCols(first, n_columns) = out.leftCols(n_columns);
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
    parallel_for(
        static_cast<std::ptrdiff_t>(nodes.size()),
        [&](std::ptrdiff_t k) {
          gathered[k] = 0;
          const auto add_all = [&](const Uses& uses, const auto& blocks) {
            for (std::int64_t u = uses.first[k]; u < uses.first[k + 1]; ++u) {
              gathered[k] += add(blocks[uses.all[u].block], sums[uses.all[u].other]);
            }
          };
          add_all(far_, blocks_.far);
          add_all(near_, blocks_.near);
        },
        kNodeGrain);
    visit_downward([&](std::int32_t k) {
      const NestedBasis::Node& node = nodes[k];
      if (node.is_leaf()) {
        result.col(column).segment(node.begin, node.end - node.begin).setConstant(gathered[k]);
        return;
      }
      gathered[node.left] += gathered[k];
      gathered[node.right] += gathered[k];
    });
  }
  return result;
}

Eigen::MatrixXd CompressedMatrix::squared_errors(const Eigen::MatrixXd& x) const {
  return sum_over_blocks(
      x, [](const auto& block, double sum) { return square(double{block.error} * sum); });
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
  parallel_for(
      n_nodes,
      [&](std::ptrdiff_t k) {
        gathered.row(k).setZero();
        for (std::int64_t u = far_.first[k]; u < far_.first[k + 1]; ++u) {
          const Use& use = far_.all[u];
          // The first functions are 1, and the others' means 0.
          const double density = blocks_.coefficients[blocks_.far[use.block].first];
          gathered.row(k) += weigh(density, means[k], means[use.other]) * sums.row(use.other);
        }
        visit_near(static_cast<std::int32_t>(k), [&](std::int32_t row, std::int32_t column,
                                                     float density) {
          if (density == 0) return;
          result.row(row) += weigh(density, places[row], places[column]) * in.row(column);
        });
      },
      kNodeGrain);
  visit_downward([&](std::int32_t k) {
    const NestedBasis::Node& node = nodes[k];
    if (node.is_leaf()) {
      result.middleRows(node.begin, node.end - node.begin).rowwise() += gathered.row(k);
      return;
    }
    gathered.row(node.left) += gathered.row(k);
    gathered.row(node.right) += gathered.row(k);
  });
  return result;
}

}  // namespace radiosity
