#include "radiosity/visibility/cluster_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "radiosity/polygon/convex_hull.h"

namespace radiosity {
namespace {

/// How far apart opposite normals count, in units of the scene's longest side.
constexpr double kNormalWeight = 2;
/// Outlines with more corners are not worth their tests.
constexpr std::size_t kMostOutlineCorners = 8;

using Point6 = std::array<double, 6>;

class ClusterTreeBuilder {
 public:
  ClusterTreeBuilder(const PatchMesh& mesh, Index leaf_size, double thickness)
      : mesh_(mesh), leaf_size_(leaf_size), thickness_(thickness) {
    const Box3 box = bounds(mesh);
    const double scale = mesh.size() > 0 ? 1 / std::max(box.sizes().maxCoeff(), 1e-300) : 1;
    points_.resize(mesh.size());
    for (Index i = 0; i < mesh.size(); ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        points_[i][axis] = scale * (mesh.centroid[i][axis] - box.min()[axis]);
        points_[i][3 + axis] = 0.5 * kNormalWeight * mesh.normal[i][axis];
      }
    }
    tree_.order.resize(mesh.size());
    std::iota(tree_.order.begin(), tree_.order.end(), 0);
  }

  ClusterTree build() {
    if (!tree_.order.empty()) add_cluster(0, mesh_.size());
    return std::move(tree_);
  }

 private:
  std::int32_t add_cluster(Index begin, Index end) {
    const auto self = static_cast<std::int32_t>(tree_.clusters.size());
    Cluster cluster;
    cluster.begin = begin;
    cluster.end = end;
    for (Index k = begin; k < end; ++k) {
      const std::int32_t patch = tree_.order[k];
      cluster.box.extend(patch_box(mesh_, patch));
    }
    find_outline(cluster);
    tree_.clusters.push_back(cluster);
    if (end - begin <= leaf_size_) {
      tree_.leaves.push_back(self);
      return self;
    }
    const Index middle = split(begin, end);
    const std::int32_t left = add_cluster(begin, middle);
    const std::int32_t right = add_cluster(middle, end);
    tree_.clusters[self].left = left;
    tree_.clusters[self].right = right;
    return self;
  }

  void find_outline(Cluster& cluster) const {
    const std::int32_t first = tree_.order[cluster.begin];
    const HalfSpace plane{mesh_.normal[first], mesh_.normal[first].dot(mesh_.centroid[first])};
    const Vec3 u = plane.normal.unitOrthogonal();
    const Vec3 v = plane.normal.cross(u);
    std::vector<Vec3> corners;
    std::vector<Point2> points;
    bool is_planar = true;
    for (Index k = cluster.begin; k < cluster.end && is_planar; ++k) {
      const std::int32_t patch = tree_.order[k];
      is_planar &= mesh_.normal[patch].dot(plane.normal) > 0;
      for (int c = 0; c < mesh_.n_corners(patch); ++c) {
        const Vec3& corner = mesh_.corner(patch, c);
        is_planar &= std::abs(plane.normal.dot(corner) - plane.offset) <= thickness_;
        corners.push_back(corner);
        points.emplace_back(u.dot(corner), v.dot(corner));
      }
    }
    if (is_planar) {
      cluster.plane = plane;
      const std::vector<std::int32_t> hull = convex_hull(points, thickness_);
      if (!hull.empty() && hull.size() <= kMostOutlineCorners) {
        for (const std::int32_t k : hull) cluster.outline.push_back(corners[k]);
        cluster.is_flat = true;
        return;
      }
    }
    cluster.is_flat = cluster.box.sizes().minCoeff() <= thickness_;
    for (int k = 0; k < 8; ++k) {
      cluster.outline.push_back(cluster.box.corner(static_cast<Box3::CornerType>(k)));
    }
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
        low[axis] = std::min(low[axis], points_[tree_.order[k]][axis]);
        high[axis] = std::max(high[axis], points_[tree_.order[k]][axis]);
      }
    }
    int longest = 0;
    for (int axis = 1; axis < 6; ++axis) {
      if (high[axis] - low[axis] > high[longest] - low[longest]) longest = axis;
    }
    std::sort(tree_.order.begin() + begin, tree_.order.begin() + end,
              [&](std::int32_t a, std::int32_t b) {
                const double x = points_[a][longest];
                const double y = points_[b][longest];
                return x != y ? x < y : a < b;
              });
    const Index quarter = (end - begin) / 4;
    Index best = begin + (end - begin) / 2;
    const auto gap = [&](Index k) {
      return points_[tree_.order[k]][longest] - points_[tree_.order[k - 1]][longest];
    };
    double widest = gap(best) + 1e-9;
    for (Index k = begin + quarter + 1; k < end - quarter; ++k) {
      if (gap(k) > widest) {
        widest = gap(k);
        best = k;
      }
    }
    return best;
  }

  const PatchMesh& mesh_;
  Index leaf_size_;
  double thickness_;
  std::vector<Point6> points_;
  ClusterTree tree_;
};

}  // namespace

ClusterTree make_cluster_tree(const PatchMesh& mesh, Index leaf_size, double thickness) {
  return ClusterTreeBuilder(mesh, leaf_size, thickness).build();
}

}  // namespace radiosity
