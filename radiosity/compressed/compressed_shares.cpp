// How ranks share products of a compressed matrix.
#include <numeric>
#include <span>

#include "radiosity/base/ranks.h"
#include "radiosity/compressed/compressed_blocks.h"

namespace radiosity {
namespace {

/// Divides things that follow each other among ranks so that each has about as much to do: the
/// first of each rank's, and their number at the end.
std::vector<Index> shares_by_cost(std::span<const double> costs, int n_ranks) {
  const double total = std::accumulate(costs.begin(), costs.end(), 0.0);
  std::vector<Index> first(n_ranks + 1, static_cast<Index>(costs.size()));
  double before = 0;
  int rank = 0;
  for (std::size_t k = 0; k < costs.size(); ++k) {
    // That whose middle lies beyond the rank's part of all costs.
    while (rank < n_ranks && before + 0.5 * costs[k] >= total * rank / n_ranks) {
      first[rank++] = static_cast<Index>(k);
    }
    before += costs[k];
  }
  return first;
}

/// Gives all ranks the values of each: rank r's are those from bounds[r] to before bounds[r + 1].
void share_values(Ranks& ranks, double* values, std::span<const std::size_t> bounds) {
  for (int rank = 0; rank < ranks.size(); ++rank) {
    if (bounds[rank] == bounds[rank + 1]) continue;
    ranks.broadcast(rank, std::as_writable_bytes(
                              std::span(values + bounds[rank], bounds[rank + 1] - bounds[rank])));
  }
}

}  // namespace

double CompressedMatrix::cost(std::int32_t node) const {
  const auto& nodes = blocks_.basis.nodes;
  double sum = nodes[node].used;
  far_.visit(node, [&](const Use& use) {
    const std::int32_t a = use.is_a ? node : use.other;
    const std::int32_t b = use.is_a ? use.other : node;
    sum += n_coefficients(functions_[a].counts, functions_[b].counts, use.degrees);
  });
  const double n_rows = nodes[node].end - nodes[node].begin;
  near_.visit(node, [&](const Use& use) {
    sum += n_rows * (nodes[use.other].end - nodes[use.other].begin);
  });
  return sum;
}

void CompressedMatrix::find_shares() {
  if (ranks_ == nullptr) return;
  std::vector<double> costs(subtrees_.size());
  for (std::size_t s = 0; s < costs.size(); ++s) {
    for (std::int32_t k = subtrees_[s]; k < end_[subtrees_[s]]; ++k) costs[s] += cost(k);
  }
  shares_ = shares_by_cost(costs, ranks_->size());
  for (const Index first : shares_) {
    const bool is_end = first == static_cast<Index>(subtrees_.size());
    const std::int32_t node = is_end ? 0 : subtrees_[first];
    function_shares_.push_back(is_end ? blocks_.basis.n_functions : functions_[node].first);
    row_shares_.push_back(is_end ? size() : blocks_.basis.nodes[node].begin);
  }
}

std::pair<Index, Index> CompressedMatrix::own_subtrees() const {
  if (ranks_ == nullptr) return {0, static_cast<Index>(subtrees_.size())};
  return {shares_[ranks_->rank()], shares_[ranks_->rank() + 1]};
}

/// Gives all ranks the others' values, of which there are `width` for each thing in a share.
void CompressedMatrix::share(double* values, const std::vector<std::size_t>& shares,
                             std::size_t width) const {
  if (ranks_ == nullptr) return;
  std::vector<std::size_t> bounds = shares;
  for (std::size_t& bound : bounds) bound *= width;
  share_values(*ranks_, values, bounds);
}

}  // namespace radiosity
