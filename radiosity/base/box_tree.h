#pragma once

#include <cstdint>
#include <vector>

#include "radiosity/base/geometry.h"

namespace radiosity {

/// Finds which of many boxes meet a given one, in a time that grows with the logarithm of their
/// number: a binary tree of boxes, split at the median.
class BoxTree {
 public:
  explicit BoxTree(std::vector<Box3> boxes);

  /// Calls visit(i) for every box i that shares a point with `box`, in an order that depends on
  /// the boxes only.
  template <typename Visit>
  void for_each_meeting(const Box3& box, const Visit& visit) const {
    if (!nodes_.empty()) descend(0, box, visit);
  }

 private:
  struct Node {
    Box3 box;
    std::int32_t begin, end;  // into order_
    std::int32_t right;       // the left child follows its parent; -1 in a leaf
  };

  /// Appends the node of order_[begin..end) and all below it, as numbered in `nodes`.
  void build(std::int32_t begin, std::int32_t end, std::vector<Node>& nodes);
  void halve(std::int32_t begin, std::int32_t middle, std::int32_t end, const Box3& centers);

  template <typename Visit>
  void descend(std::int32_t n, const Box3& box, const Visit& visit) const {
    const Node& node = nodes_[n];
    if (!node.box.intersects(box)) return;
    if (node.right < 0) {
      for (std::int32_t k = node.begin; k < node.end; ++k) {
        if (boxes_[order_[k]].intersects(box)) visit(order_[k]);
      }
      return;
    }
    descend(n + 1, box, visit);
    descend(node.right, box, visit);
  }

  std::vector<Box3> boxes_;
  std::vector<std::int32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace radiosity
