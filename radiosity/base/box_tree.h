#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "radiosity/base/geometry.h"

namespace radiosity {

/// Finds which of many boxes meet a given one, in a time that grows with the logarithm of their
/// number: a binary tree of boxes, split at the median.
class BoxTree {
 public:
  explicit BoxTree(std::vector<Box3> boxes);

  /// Boxes that lie together: a number for those that follow.
  using Group = std::int32_t;
  /// All boxes in groups of at most `most`, but for 4. To look around each box, ask what meets all
  /// boxes of a group at once: for each of them that is in the order that asking for it alone has.
  [[nodiscard]] std::vector<Group> groups(std::int32_t most) const;
  [[nodiscard]] const Box3& box(Group group) const { return nodes_[group].box; }
  [[nodiscard]] std::span<const std::int32_t> members(Group group) const {
    return std::span(order_).subspan(nodes_[group].begin, nodes_[group].end - nodes_[group].begin);
  }

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
