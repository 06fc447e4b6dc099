#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <vector>

#include "io/mesh/gltf_document.h"

namespace io {

/// A node of the tree as often as it stands there.
struct GltfNode {
  std::size_t index;  ///< in "nodes"
  Eigen::Affine3d transform;
};

/// Walks the node tree of the scene that is shown, parents before children. Trees of any depth do:
/// nothing recurses. Nodes may share children, though glTF forbids it.
class GltfTree {
 public:
  /// Throws SceneError for nodes that are their own descendants and for more than 100,000 instances
  /// that nodes with shared children multiply to.
  explicit GltfTree(const GltfDocument& document);

  /// How often each node stands in the tree.
  [[nodiscard]] const std::vector<double>& counts() const { return counts_; }
  void walk(const std::function<void(const GltfNode&)>& visit) const;

 private:
  void find_roots();
  void find_children();
  void count();

  const GltfDocument& document_;
  std::vector<std::size_t> roots_;
  std::vector<std::vector<std::size_t>> children_;
  std::vector<double> counts_;
};

}  // namespace io
