#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/polygon/convex_polygon.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/half_space.h"

namespace radiosity {

/// A set of patches that are alike in place and direction: order[begin..end) of its tree.
struct Cluster {
  Index begin = 0;
  Index end = 0;
  std::int32_t left = -1;  ///< child clusters, or -1 for a leaf
  std::int32_t right = -1;
  Box3 box;  ///< around the patches' corners, m
  /// Corners of a convex set that holds the patches: of their hull, where they lie in one plane and
  /// the hull has few corners, else of their box, m.
  std::vector<Vec3> outline;
  bool is_flat = false;            ///< the outline is in one plane
  std::optional<HalfSpace> plane;  ///< if all patches lie in it and face its outside
  [[nodiscard]] bool is_leaf() const { return left < 0; }
};

/// Patches in a binary tree. Splitting goes by normal and place together, with the normals weighted
/// so that walls separate before they are divided.
struct ClusterTree {
  std::vector<std::int32_t> order;   ///< permutation: patches in tree order
  std::vector<Cluster> clusters;     ///< [0] is the root, if there are patches
  std::vector<std::int32_t> leaves;  ///< clusters that are leaves, in tree order
  /// The cluster of each part, of a mesh that is so many images of its first patches: the clusters
  /// of all parts follow their roots in the same order. Else [0], or none if there are no patches.
  std::vector<std::int32_t> roots;

  /// Patches of a part.
  [[nodiscard]] Index part_size() const {
    return static_cast<Index>(order.size() / std::max<std::size_t>(roots.size(), 1));
  }
  /// The image, in part g, of a cluster of the first part.
  [[nodiscard]] std::int32_t image(std::int32_t cluster, std::size_t g) const {
    return roots[g] + cluster - roots[0];
  }
};

/// Builds the tree by halving at the median of the longest of the six axes (three of place, three
/// of the normal) until no leaf has more than `leaf_size` patches. Deterministic. `thickness` is
/// how far off a plane points may be and still count as on it, m. With several parts patch i + g n
/// is the image of patch i of the first n, and all have trees alike.
ClusterTree make_cluster_tree(const PatchMesh& mesh, Index leaf_size, double thickness,
                              Index n_parts = 1);

/// The largest clusters of at most `most` patches, and leaves of more, in the tree's order: they
/// hold each patch of the first part once.
std::vector<std::int32_t> largest_clusters(const ClusterTree& tree, Index most);

/// A cluster by itself that holds what is in a convex polygon, which faces the outside of `plane`.
Cluster cluster_of(const ConvexPolygon& polygon, const HalfSpace& plane);

}  // namespace radiosity
