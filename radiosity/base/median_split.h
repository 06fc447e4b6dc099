#pragma once

#include <algorithm>
#include <array>
#include <span>

namespace radiosity {

/// Sorts items by `key`, a coordinate or what else can be compared, equal ones as they were, and
/// returns the halves; of an odd number the second has one more.
template <typename Item, typename Key>
std::array<std::span<Item>, 2> split_at_median(std::span<Item> items, const Key& key) {
  std::stable_sort(items.begin(), items.end(),
                   [&](const Item& a, const Item& b) { return key(a) < key(b); });
  const std::size_t middle = items.size() / 2;
  return {items.first(middle), items.subspan(middle)};
}

}  // namespace radiosity
