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
  for (const Block& block : blocks) {
    Use use{.first = block.first,
            .other = block.b,
            .error = block.error,
            .degrees = {},
            .is_a = true,
            .may_change = block.may_change};
    if constexpr (requires { block.degrees; }) use.degrees = block.degrees;
    uses.all[next[block.a]++] = use;
    if (block.a == block.b) continue;
    use.other = block.a;
    use.is_a = false;
    uses.all[next[block.b]++] = use;
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
