#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace meshing {

/// Numbers by size, the largest first; of equal ones that of the least index. A heap of fours: from
/// its end to its top are few cache lines, which is what time goes into where there are many.
class LargestFirst {
 public:
  struct Item {
    double size;
    int index;
  };

  [[nodiscard]] bool is_empty() const { return items_.empty(); }

  void push(const Item& item) {
    std::size_t k = items_.size();
    items_.push_back(item);
    for (; k > 0; k = (k - 1) / 4) {
      const Item& above = items_[(k - 1) / 4];
      if (!is_before(item, above)) break;
      items_[k] = above;
    }
    items_[k] = item;
  }

  /// Takes out the first; there must be one.
  Item pop() {
    const Item first = items_[0];
    const Item last = items_.back();
    items_.pop_back();
    if (items_.empty()) return first;
    std::size_t k = 0;
    for (std::size_t below = 1; below < items_.size(); below = 4 * k + 1) {
      std::size_t next = below;
      for (std::size_t i = below + 1; i < std::min(below + 4, items_.size()); ++i) {
        if (is_before(items_[i], items_[next])) next = i;
      }
      if (!is_before(items_[next], last)) break;
      items_[k] = items_[next];
      k = next;
    }
    items_[k] = last;
    return first;
  }

 private:
  static bool is_before(const Item& one, const Item& other) {
    return one.size != other.size ? one.size > other.size : one.index < other.index;
  }

  std::vector<Item> items_;
};

}  // namespace meshing
