#include "io/mesh/gltf_nodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace io {
namespace {

constexpr double kMostInstances = 100'000;

Eigen::Vector4d four_numbers(const JsonItem& item) {
  if (item.size() != 4) item.fail(fmt::format("has {} numbers, expected 4", item.size()));
  return {item[0].number(), item[1].number(), item[2].number(), item[3].number()};
}

Eigen::Affine3d local_transform(const JsonItem& node) {
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  if (const auto matrix = node.find("matrix")) {
    if (matrix->size() != 16) {
      matrix->fail(fmt::format("has {} numbers, expected 16", matrix->size()));
    }
    for (int k = 0; k < 16; ++k) {
      const double value = (*matrix)[static_cast<std::size_t>(k)].number();
      if (k % 4 < 3) transform.matrix()(k % 4, k / 4) = value;  // column by column
    }
    return transform;
  }
  if (const auto item = node.find("translation")) transform.translate(item->point());
  if (const auto item = node.find("rotation")) {
    const Eigen::Vector4d q = four_numbers(*item);
    if (!(q.norm() > 0)) item->fail("is zero, expected a unit quaternion");
    transform.rotate(Eigen::Quaterniond(q[3], q[0], q[1], q[2]).normalized());
  }
  if (const auto item = node.find("scale")) transform.scale(item->point());
  return transform;
}

}  // namespace

GltfTree::GltfTree(const GltfDocument& document)
    : document_(document), children_(document.size("nodes")), counts_(children_.size(), 0.0) {
  find_children();
  find_roots();
  count();
}

void GltfTree::find_children() {
  for (std::size_t i = 0; i < children_.size(); ++i) {
    const auto children = document_.element("nodes", i).find("children");
    if (!children) continue;
    for (std::size_t k = 0; k < children->size(); ++k) {
      (void)document_.element("nodes", (*children)[k]);
      children_[i].push_back(static_cast<std::size_t>((*children)[k].number()));
    }
  }
}

/// Of the scene that the file says to show, else of the first; without scenes, all nodes that are
/// nobody's children.
void GltfTree::find_roots() {
  if (document_.size("scenes") == 0) {
    std::vector<bool> is_child(children_.size(), false);
    for (const auto& children : children_) {
      for (const std::size_t child : children) is_child[child] = true;
    }
    for (std::size_t i = 0; i < children_.size(); ++i) {
      if (!is_child[i]) roots_.push_back(i);
    }
    return;
  }
  const auto shown = document_.root().find("scene");
  const JsonItem scene =
      shown ? document_.element("scenes", *shown) : document_.element("scenes", 0);
  const auto nodes = scene.find("nodes");
  if (!nodes) return;
  for (std::size_t k = 0; k < nodes->size(); ++k) {
    (void)document_.element("nodes", (*nodes)[k]);
    roots_.push_back(static_cast<std::size_t>((*nodes)[k].number()));
  }
}

void GltfTree::count() {
  // Parents before children: how many of its parents have not been counted yet, per node (Kahn).
  std::vector<std::size_t> n_waiting(children_.size(), 0);
  std::vector<bool> is_reached(children_.size(), false);
  std::vector<std::size_t> open = roots_;
  while (!open.empty()) {
    const std::size_t node = open.back();
    open.pop_back();
    if (is_reached[node]) continue;
    is_reached[node] = true;
    for (const std::size_t child : children_[node]) {
      ++n_waiting[child];
      open.push_back(child);
    }
  }
  for (const std::size_t root : roots_) ++counts_[root];
  std::size_t n_left = 0;
  for (std::size_t i = 0; i < children_.size(); ++i) {
    if (!is_reached[i]) continue;
    ++n_left;
    if (n_waiting[i] == 0) open.push_back(i);
  }
  double total = 0;
  double n_meshes = 0;
  while (!open.empty()) {
    const std::size_t node = open.back();
    open.pop_back();
    --n_left;
    total += counts_[node];
    if (document_.element("nodes", node).has("mesh")) n_meshes += counts_[node];
    for (const std::size_t child : children_[node]) {
      counts_[child] += counts_[node];
      if (--n_waiting[child] == 0) open.push_back(child);
    }
  }
  if (n_left > 0) document_.root().fail("a node is among its own descendants");
  const double most = std::max(kMostInstances, static_cast<double>(children_.size()));
  if (total > most) {
    document_.root().fail(
        fmt::format("nodes with shared children make {:.0f} instances of nodes, {:.0f} of meshes, "
                    "expected at most {:.0f}",
                    total, n_meshes, most));
  }
}

void GltfTree::walk(const std::function<void(const GltfNode&)>& visit) const {
  std::vector<GltfNode> open;
  const auto push = [&](const std::vector<std::size_t>& nodes, const Eigen::Affine3d& parent) {
    for (auto i = nodes.rbegin(); i != nodes.rend(); ++i) open.push_back({*i, parent});
  };
  push(roots_, Eigen::Affine3d::Identity());
  while (!open.empty()) {
    GltfNode node = open.back();
    open.pop_back();
    node.transform = node.transform * local_transform(document_.element("nodes", node.index));
    visit(node);
    push(children_[node.index], node.transform);
  }
}

}  // namespace io
