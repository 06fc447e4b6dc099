#pragma once

#include <numeric>
#include <utility>
#include <vector>

#include "radiosity/base/geometry.h"

namespace radiosity {

/// The numbers 0 to n - 1 in sets, of which each goes by its least member. (Tarjan & van Leeuwen
/// 1984: union-find with path halving)
class DisjointSets {
 public:
  /// Every number is a set by itself.
  explicit DisjointSets(Index n) : parent_(n) {
    std::iota(parent_.begin(), parent_.end(), Index{0});
  }

  /// Least member of the set that `k` is in.
  Index find(Index k) {
    while (parent_[k] != k) k = parent_[k] = parent_[parent_[k]];
    return k;
  }

  void join(Index a, Index b) {
    a = find(a);
    b = find(b);
    if (a > b) std::swap(a, b);
    parent_[b] = a;
  }

  /// The members of each set, in increasing order, the sets by their least member.
  std::vector<std::vector<Index>> sets() {
    std::vector<std::vector<Index>> members(parent_.size());
    for (Index k = 0; k < static_cast<Index>(parent_.size()); ++k) members[find(k)].push_back(k);
    std::erase_if(members, [](const std::vector<Index>& set) { return set.empty(); });
    return members;
  }

 private:
  std::vector<Index> parent_;
};

}  // namespace radiosity
