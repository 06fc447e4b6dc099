#include "radiosity/visibility/cluster_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "radiosity/base/parallel.h"
#include "radiosity/polygon/convex_hull.h"

namespace radiosity {
namespace {

/// How far apart opposite normals count, in units of the scene's longest side.
constexpr double kNormalWeight = 2;
/// Outlines with more corners are not worth their tests.
constexpr std::size_t kMostOutlineCorners = 8;

/// Halves of clusters of at least so many patches are built in parallel.
constexpr Index kParallelPatches = 4096;

using Point6 = std::array<double, 6>;

class ClusterTreeBuilder {
 public:
  ClusterTreeBuilder(const PatchMesh& mesh, Index leaf_size, double thickness, Index n_parts)
      : mesh_(mesh),
        leaf_size_(leaf_size),
        thickness_(thickness),
        n_parts_(n_parts),
        order_(mesh.size()) {
    const Box3 box = bounds(mesh);
    const double scale = mesh.size() > 0 ? 1 / std::max(box.sizes().maxCoeff(), 1e-300) : 1;
    points_.resize(mesh.size());
    for (Index i = 0; i < mesh.size(); ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        points_[i][axis] = scale * (mesh.centroid[i][axis] - box.min()[axis]);
        points_[i][3 + axis] = 0.5 * kNormalWeight * mesh.normal[i][axis];
      }
    }
    std::iota(order_.begin(), order_.end(), 0);
  }

  ClusterTree build() {
    ClusterTree tree;
    if (!order_.empty()) {
      add_cluster(0, mesh_.size() / n_parts_, part_);
      add_parts(0, n_parts_, tree);
    }
    for (std::size_t k = 0; k < tree.clusters.size(); ++k) {
      if (tree.clusters[k].is_leaf()) tree.leaves.push_back(static_cast<std::int32_t>(k));
    }
    tree.order = std::move(order_);
    return tree;
  }

 private:
  /// Appends the tree of some parts: of each one the first's, and what holds them all.
  std::int32_t add_parts(Index begin, Index end, ClusterTree& tree) {
    const auto self = static_cast<std::int32_t>(tree.clusters.size());
    if (end - begin == 1) {
      tree.roots.push_back(self);
      add_part(begin, tree.clusters);
      return self;
    }
    const Index n = mesh_.size() / n_parts_;
    tree.clusters.emplace_back();
    const Index middle = begin + (end - begin) / 2;
    const std::int32_t left = add_parts(begin, middle, tree);
    const std::int32_t right = add_parts(middle, end, tree);
    Cluster& cluster = tree.clusters[self];
    cluster.begin = begin * n;
    cluster.end = end * n;
    cluster.left = left;
    cluster.right = right;
    cluster.box = tree.clusters[left].box.merged(tree.clusters[right].box);
    find_outline(cluster);
    return self;
  }

  /// Appends the tree of a part. The first comes first.
  void add_part(Index part, std::vector<Cluster>& clusters) {
    if (part == 0) {
      std::vector<Cluster> copy = n_parts_ == 1 ? std::move(part_) : part_;
      append(copy, clusters);
      return;
    }
    const Index n = mesh_.size() / n_parts_;
    const auto root = static_cast<std::int32_t>(clusters.size());
    for (Index k = 0; k < n; ++k) {
      order_[part * n + k] = order_[k] + static_cast<std::int32_t>(part * n);
    }
    for (const Cluster& original : part_) {
      Cluster& image = clusters.emplace_back();
      image.begin = original.begin + part * n;
      image.end = original.end + part * n;
      if (!original.is_leaf()) {
        image.left = root + original.left;
        image.right = root + original.right;
      }
      for (Index k = image.begin; k < image.end; ++k) {
        image.box.extend(patch_box(mesh_, order_[k]));
      }
      find_outline(image);
    }
  }

  /// Appends a cluster, and then all in it, as numbered in `clusters`.
  std::int32_t add_cluster(Index begin, Index end, std::vector<Cluster>& clusters) {
    const auto self = static_cast<std::int32_t>(clusters.size());
    Cluster& cluster = clusters.emplace_back();
    cluster.begin = begin;
    cluster.end = end;
    for (Index k = begin; k < end; ++k) cluster.box.extend(patch_box(mesh_, order_[k]));
    find_outline(cluster);
    if (end - begin <= leaf_size_) return self;

    const Index middle = split(begin, end);
    std::int32_t left = -1;
    std::int32_t right = -1;
    if (end - begin < kParallelPatches) {
      left = add_cluster(begin, middle, clusters);
      right = add_cluster(middle, end, clusters);
    } else {
      std::array<std::vector<Cluster>, 2> halves;
      parallel_for(2, [&](std::ptrdiff_t side) {
        side == 0 ? add_cluster(begin, middle, halves[0]) : add_cluster(middle, end, halves[1]);
      });
      left = append(halves[0], clusters);
      right = append(halves[1], clusters);
    }
    clusters[self].left = left;
    clusters[self].right = right;
    return self;
  }

  /// Moves a tree behind others; returns the number that its root has there.
  static std::int32_t append(std::vector<Cluster>& tree, std::vector<Cluster>& clusters) {
    const auto first = static_cast<std::int32_t>(clusters.size());
    for (Cluster& cluster : tree) {
      if (!cluster.is_leaf()) {
        cluster.left += first;
        cluster.right += first;
      }
      clusters.push_back(std::move(cluster));
    }
    tree = {};
    return first;
  }

  void find_outline(Cluster& cluster) const {
    const std::int32_t first = order_[cluster.begin];
    const HalfSpace plane{mesh_.normal[first], mesh_.normal[first].dot(mesh_.centroid[first])};
    if (is_in(cluster, plane)) {
      cluster.plane = plane;
      if (find_hull(cluster, plane.normal)) {
        cluster.is_flat = true;
        return;
      }
    }
    cluster.is_flat = cluster.box.sizes().minCoeff() <= thickness_;
    for (int k = 0; k < 8; ++k) {
      cluster.outline.push_back(cluster.box.corner(static_cast<Box3::CornerType>(k)));
    }
  }

  /// Whether all patches lie in a plane and face its outside.
  [[nodiscard]] bool is_in(const Cluster& cluster, const HalfSpace& plane) const {
    for (Index k = cluster.begin; k < cluster.end; ++k) {
      const std::int32_t patch = order_[k];
      if (!(mesh_.normal[patch].dot(plane.normal) > 0)) return false;
      for (int c = 0; c < mesh_.n_corners(patch); ++c) {
        const double height = plane.normal.dot(mesh_.corner(patch, c)) - plane.offset;
        if (!(std::abs(height) <= thickness_)) return false;
      }
    }
    return true;
  }

  /// Makes the hull of a cluster in a plane its outline, if that has few corners.
  bool find_hull(Cluster& cluster, const Vec3& normal) const {
    const Vec3 u = normal.unitOrthogonal();
    const Vec3 v = normal.cross(u);
    const std::vector<std::int32_t> vertices = vertices_of(cluster);
    std::vector<Point2> points;
    points.reserve(vertices.size());
    for (const std::int32_t vertex : vertices) {
      const Vec3& corner = mesh_.vertices[vertex];
      points.emplace_back(u.dot(corner), v.dot(corner));
    }
    const std::vector<std::int32_t> hull = convex_hull(points, thickness_, kMostOutlineCorners);
    for (const std::int32_t k : hull) cluster.outline.push_back(mesh_.vertices[vertices[k]]);
    return !hull.empty();
  }

  /// The corners of a cluster's patches; each once, where their numbers are close together.
  [[nodiscard]] std::vector<std::int32_t> vertices_of(const Cluster& cluster) const {
    constexpr std::size_t kWidestRange = 64;
    std::vector<std::int32_t> vertices;
    vertices.reserve(4 * (cluster.end - cluster.begin));
    for (Index k = cluster.begin; k < cluster.end; ++k) {
      const std::int32_t patch = order_[k];
      for (int c = 0; c < mesh_.n_corners(patch); ++c) {
        vertices.push_back(mesh_.corners[patch][c]);
      }
    }
    const auto [low, high] = std::minmax_element(vertices.begin(), vertices.end());
    const std::int32_t first = *low;
    const auto range = static_cast<std::size_t>(*high - first) + 1;
    if (range > kWidestRange * vertices.size()) return vertices;
    std::vector<bool> is_known(range, false);
    std::vector<std::int32_t> once;
    for (const std::int32_t vertex : vertices) {
      if (!is_known[vertex - first]) once.push_back(vertex);
      is_known[vertex - first] = true;
    }
    return once;
  }

  /// Sorts order[begin..end) along its longest axis; returns where to cut: the widest gap near the
  /// middle, so that a wall's patches stay together.
  Index split(Index begin, Index end) {
    Point6 low;
    Point6 high;
    low.fill(1e300);
    high.fill(-1e300);
    for (Index k = begin; k < end; ++k) {
      for (int axis = 0; axis < 6; ++axis) {
        low[axis] = std::min(low[axis], points_[order_[k]][axis]);
        high[axis] = std::max(high[axis], points_[order_[k]][axis]);
      }
    }
    int longest = 0;
    for (int axis = 1; axis < 6; ++axis) {
      if (high[axis] - low[axis] > high[longest] - low[longest]) longest = axis;
    }
    std::vector<std::pair<double, std::int32_t>> sorted;
    sorted.reserve(end - begin);
    for (Index k = begin; k < end; ++k) {
      sorted.emplace_back(points_[order_[k]][longest], order_[k]);
    }
    std::sort(sorted.begin(), sorted.end());
    for (Index k = begin; k < end; ++k) order_[k] = sorted[k - begin].second;
    const Index quarter = (end - begin) / 4;
    Index best = (end - begin) / 2;
    const auto gap = [&](Index k) { return sorted[k].first - sorted[k - 1].first; };
    double widest = gap(best) + 1e-9;
    for (Index k = quarter + 1; k < end - begin - quarter; ++k) {
      if (gap(k) > widest) {
        widest = gap(k);
        best = k;
      }
    }
    return begin + best;
  }

  const PatchMesh& mesh_;
  Index leaf_size_;
  double thickness_;
  Index n_parts_;
  std::vector<Cluster> part_;  // the tree of the first part
  std::vector<Point6> points_;
  std::vector<std::int32_t> order_;
};

}  // namespace

ClusterTree make_cluster_tree(const PatchMesh& mesh, Index leaf_size, double thickness,
                              Index n_parts) {
  return ClusterTreeBuilder(mesh, leaf_size, thickness, n_parts).build();
}

std::vector<std::int32_t> largest_clusters(const ClusterTree& tree, Index most) {
  std::vector<std::int32_t> found;
  std::vector<std::int32_t> open;
  if (!tree.clusters.empty()) open.push_back(tree.roots[0]);
  while (!open.empty()) {
    const std::int32_t k = open.back();
    open.pop_back();
    const Cluster& cluster = tree.clusters[k];
    if (cluster.is_leaf() || cluster.end - cluster.begin <= most) {
      found.push_back(k);
    } else {
      open.push_back(cluster.right);
      open.push_back(cluster.left);
    }
  }
  return found;
}

Cluster cluster_of(const ConvexPolygon& polygon, const HalfSpace& plane) {
  Cluster cluster;
  for (const Vec3& corner : polygon) {
    cluster.outline.push_back(corner);
    cluster.box.extend(corner);
  }
  cluster.is_flat = true;
  cluster.plane = plane;
  return cluster;
}

}  // namespace radiosity
