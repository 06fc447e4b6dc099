#include "radiosity/base/box_tree.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace radiosity {

BoxTree::BoxTree(std::vector<Box3> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  if (!order_.empty()) build(0, static_cast<std::int32_t>(order_.size()));
}

void BoxTree::build(std::int32_t begin, std::int32_t end) {
  constexpr std::int32_t kLeafSize = 4;
  Box3 box;
  Box3 centers;
  for (std::int32_t k = begin; k < end; ++k) {
    box.extend(boxes_[order_[k]]);
    centers.extend(boxes_[order_[k]].center());
  }
  const auto n = static_cast<std::int32_t>(nodes_.size());
  nodes_.push_back({box, begin, end, -1});
  if (end - begin <= kLeafSize) return;

  int axis = 0;
  centers.sizes().maxCoeff(&axis);
  const std::int32_t middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](std::int32_t a, std::int32_t b) {
                     const double ca = boxes_[a].center()[axis];
                     const double cb = boxes_[b].center()[axis];
                     return ca != cb ? ca < cb : a < b;
                   });
  build(begin, middle);
  nodes_[n].right = static_cast<std::int32_t>(nodes_.size());
  build(middle, end);
}

}  // namespace radiosity
