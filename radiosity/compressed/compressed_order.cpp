// In which order products of a compressed matrix go through it.
#include <algorithm>
#include <utility>
#include <vector>

#include "radiosity/compressed/compressed_blocks.h"

namespace radiosity {
namespace {

/// Parts of a tree that are worked on in parallel, at least, if it is large.
constexpr Index kSubtrees = 256;
constexpr Index kSmallSubtree = 512;

}  // namespace

CompressedMatrix::CompressedMatrix(CompressedBlocks blocks, Ranks* ranks)
    : blocks_(std::move(blocks)), ranks_(ranks) {
  for (const NestedBasis::Node& node : blocks_.basis.nodes) {
    functions_.push_back({node.first, node.counts});
  }
  sort_far();
  far_ = find_uses(blocks_.far);
  near_ = find_uses(blocks_.near);
  find_subtrees();
  find_shares();
}

/// Far blocks and their numbers in the order of their nodes, so that products find what they need
/// close together.
void CompressedMatrix::sort_far() {
  const auto nodes_of = [](const CompressedBlocks::Far& far) { return std::pair(far.a, far.b); };
  const auto is_before = [&](const CompressedBlocks::Far& x, const CompressedBlocks::Far& y) {
    return nodes_of(x) < nodes_of(y);
  };
  std::vector<CompressedBlocks::Far>& far = blocks_.far;
  if (std::is_sorted(far.begin(), far.end(), is_before)) return;
  std::sort(far.begin(), far.end(), is_before);
  std::vector<float> sorted;
  sorted.reserve(blocks_.coefficients.size());
  for (CompressedBlocks::Far& block : far) {
    const int n =
        n_coefficients(functions_[block.a].counts, functions_[block.b].counts, block.degrees);
    const float* numbers = blocks_.coefficients.data() + block.first;
    block.first = sorted.size();
    sorted.insert(sorted.end(), numbers, numbers + n);
  }
  blocks_.coefficients = std::move(sorted);
}

std::size_t CompressedMatrix::Uses::bytes() const {
  return first.size() * sizeof(first[0]) + n_even.size() * sizeof(n_even[0]) +
         other.size() * (sizeof(other[0]) + sizeof(mean[0]) + sizeof(error[0]) + sizeof(kind[0]) +
                         sizeof(numbers[0]));
}

template <typename Block>
CompressedMatrix::Uses CompressedMatrix::find_uses(const std::vector<Block>& blocks) const {
  constexpr bool is_far = requires(const Block& block) { block.degrees; };
  const auto is_even = [](const Block& block) {
    if constexpr (is_far) return block.degrees.a == 0 && block.degrees.b == 0;
    return false;
  };
  Uses uses;
  const std::size_t n_nodes = blocks_.basis.nodes.size();
  uses.first.assign(n_nodes + 1, 0);
  uses.n_even.assign(n_nodes, 0);
  const auto for_ends = [](const Block& block, const auto& visit) {
    visit(block.a, block.b, true);
    if (block.a != block.b) visit(block.b, block.a, false);
  };
  for (const Block& block : blocks) {
    for_ends(block, [&](std::int32_t node, std::int32_t, bool) {
      ++uses.first[node + 1];
      uses.n_even[node] += is_even(block) ? 1 : 0;
    });
  }
  for (std::size_t k = 1; k < uses.first.size(); ++k) uses.first[k] += uses.first[k - 1];
  const auto n_uses = static_cast<std::size_t>(uses.first.back());
  uses.other.resize(n_uses);
  uses.mean.resize(n_uses);
  uses.error.resize(n_uses);
  uses.kind.resize(n_uses);
  uses.numbers.resize(n_uses);
  std::vector<std::int64_t> next_even(uses.first.begin(), uses.first.end() - 1);
  std::vector<std::int64_t> next(n_nodes);
  for (std::size_t k = 0; k < n_nodes; ++k) next[k] = uses.first[k] + uses.n_even[k];
  for (const Block& block : blocks) {
    for_ends(block, [&](std::int32_t node, std::int32_t other, bool is_a) {
      const std::int64_t k = is_even(block) ? next_even[node]++ : next[node]++;
      uses.other[k] = other;
      uses.error[k] = block.error;
      uses.kind[k] = {{}, is_a, block.may_change};
      uses.numbers[k] = block.first;
      if constexpr (is_far) {
        uses.kind[k].degrees = block.degrees;
        uses.mean[k] = blocks_.coefficients[block.first];
      }
    });
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

}  // namespace radiosity
