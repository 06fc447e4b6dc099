#include "radiosity/base/box_tree.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "radiosity/base/parallel.h"

namespace radiosity {

BoxTree::BoxTree(std::vector<Box3> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  if (!order_.empty()) build(0, static_cast<std::int32_t>(order_.size()), nodes_);
}

void BoxTree::build(std::int32_t begin, std::int32_t end, std::vector<Node>& nodes) {
  constexpr std::int32_t kLeafSize = 4;
  constexpr std::int32_t kParallelSize = 8192;
  Box3 box;
  Box3 centers;
  for (std::int32_t k = begin; k < end; ++k) {
    box.extend(boxes_[order_[k]]);
    centers.extend(boxes_[order_[k]].center());
  }
  const auto n = static_cast<std::int32_t>(nodes.size());
  nodes.push_back({box, begin, end, -1});
  if (end - begin <= kLeafSize) return;

  const std::int32_t middle = begin + (end - begin) / 2;
  halve(begin, middle, end, centers);
  if (end - begin < kParallelSize) {
    build(begin, middle, nodes);
    nodes[n].right = static_cast<std::int32_t>(nodes.size());
    build(middle, end, nodes);
    return;
  }
  std::array<std::vector<Node>, 2> halves;
  parallel_for(2, [&](std::ptrdiff_t side) {
    side == 0 ? build(begin, middle, halves[0]) : build(middle, end, halves[1]);
  });
  for (std::vector<Node>& half : halves) {
    const auto first = static_cast<std::int32_t>(nodes.size());
    if (&half == &halves[1]) nodes[n].right = first;
    for (Node& node : half) {
      if (node.right >= 0) node.right += first;
      nodes.push_back(node);
    }
    half = {};
  }
}

void BoxTree::halve(std::int32_t begin, std::int32_t middle, std::int32_t end,
                    const Box3& centers) {
  int axis = 0;
  centers.sizes().maxCoeff(&axis);
  std::vector<std::pair<double, std::int32_t>> places;
  places.reserve(end - begin);
  for (std::int32_t k = begin; k < end; ++k) {
    places.emplace_back(boxes_[order_[k]].center()[axis], order_[k]);
  }
  std::nth_element(places.begin(), places.begin() + (middle - begin), places.end());
  for (std::int32_t k = begin; k < end; ++k) order_[k] = places[k - begin].second;
}

std::vector<BoxTree::Group> BoxTree::groups(std::int32_t most) const {
  std::vector<Group> result;
  std::int32_t grouped = 0;  // boxes, in their order, as are the nodes that are wanted
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const Node& node = nodes_[n];
    const bool is_small = node.right < 0 || node.end - node.begin <= most;
    if (node.begin < grouped || !is_small) continue;
    result.push_back(static_cast<Group>(n));
    grouped = node.end;
  }
  return result;
}

}  // namespace radiosity
