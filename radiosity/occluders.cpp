#include "radiosity/occluders.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "radiosity/convex_hull.h"
#include "radiosity/disjoint_sets.h"

namespace radiosity {
namespace {

/// Hulls with more corners than this are divided: every test loops over them.
constexpr std::size_t kMaxCorners = 8;
/// A hull is the union of its patches if its area exceeds theirs by no more than this share.
constexpr double kSameArea = 1e-9;

struct Plane {
  Vec3 normal;
  double offset;
};

/// Normal with a unique sign, so that both sides of a plane compare equal.
Plane plane_of(const PatchMesh& mesh, Index i) {
  Vec3 normal = mesh.normal[i];
  int largest = 0;
  normal.cwiseAbs().maxCoeff(&largest);
  if (normal[largest] < 0) normal = -normal;
  return {normal, normal.dot(mesh.centroid[i])};
}

/// Whether an edge of `a` separates it from `b`: b lies outside it but for `thickness`.
bool is_separated_by_edge(const std::vector<Point2>& a, const std::vector<Point2>& b,
                          double thickness) {
  for (std::size_t k = 0; k < a.size(); ++k) {
    const Point2 edge = a[k + 1 < a.size() ? k + 1 : 0] - a[k];
    const double limit = thickness * edge.norm();
    if (std::all_of(b.begin(), b.end(),
                    [&](const Point2& point) { return cross2(edge, point - a[k]) <= limit; })) {
      return true;
    }
  }
  return false;
}

/// Whether two of these convex, counter-clockwise polygons overlap by more than their borders.
bool has_overlap(const std::vector<std::vector<Point2>>& polygons, double thickness) {
  std::vector<Eigen::AlignedBox2d> boxes(polygons.size());
  for (std::size_t k = 0; k < polygons.size(); ++k) {
    for (const Point2& point : polygons[k]) boxes[k].extend(point);
  }
  std::vector<std::size_t> sorted(polygons.size());
  std::iota(sorted.begin(), sorted.end(), 0);
  std::sort(sorted.begin(), sorted.end(),
            [&](std::size_t a, std::size_t b) { return boxes[a].min().x() < boxes[b].min().x(); });
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const std::size_t a = sorted[i];
    for (std::size_t j = i + 1; j < sorted.size(); ++j) {
      const std::size_t b = sorted[j];
      if (boxes[b].min().x() >= boxes[a].max().x() - thickness) break;
      if (boxes[b].min().y() >= boxes[a].max().y() - thickness ||
          boxes[a].min().y() >= boxes[b].max().y() - thickness) {
        continue;
      }
      if (!is_separated_by_edge(polygons[a], polygons[b], thickness) &&
          !is_separated_by_edge(polygons[b], polygons[a], thickness)) {
        return true;
      }
    }
  }
  return false;
}

/// Scenes with more plane-vertex tests than this keep their outer planes among the occluders: that
/// costs time later, never correctness.
constexpr double kMaxOuterPlaneTests = 2e9;

class Merger {
 public:
  Merger(const PatchMesh& mesh, double thickness) : mesh_(mesh), thickness_(thickness) {}

  std::vector<Occluder> merge() {
    std::vector<std::int32_t> patches;
    for (std::int32_t i = 0; i < mesh_.size(); ++i) {
      if (mesh_.twin[i] < 0 || mesh_.twin[i] > i) patches.push_back(i);
    }
    auto groups = coplanar_groups(patches);
    const bool test_outer =
        static_cast<double>(groups.size()) * static_cast<double>(mesh_.vertices.size()) <
        kMaxOuterPlaneTests;
    for (auto& group : groups) {
      if (test_outer && is_outer_plane(group)) continue;
      for (auto& part : connected_parts(group)) merge_group(part);
    }
    return std::move(occluders_);
  }

 private:
  std::vector<std::vector<std::int32_t>> coplanar_groups(std::vector<std::int32_t>& patches) const {
    std::vector<Plane> planes(mesh_.size());
    for (const std::int32_t i : patches) planes[i] = plane_of(mesh_, i);
    const double quantum = 1e-5;  // normals that differ less may share a plane
    const auto key = [&](std::int32_t i) {
      const Vec3& n = planes[i].normal;
      return std::array{std::round(n.x() / quantum), std::round(n.y() / quantum),
                        std::round(n.z() / quantum)};
    };
    std::sort(patches.begin(), patches.end(), [&](std::int32_t a, std::int32_t b) {
      const auto ka = key(a);
      const auto kb = key(b);
      if (ka != kb) return ka < kb;
      return planes[a].offset != planes[b].offset ? planes[a].offset < planes[b].offset : a < b;
    });
    std::vector<std::vector<std::int32_t>> groups;
    for (const std::int32_t i : patches) {
      if (groups.empty() || !is_coplanar(i, groups.back().front())) groups.emplace_back();
      groups.back().push_back(i);
    }
    return groups;
  }

  [[nodiscard]] bool is_coplanar(std::int32_t patch, std::int32_t with) const {
    for (int k = 0; k < mesh_.n_corners(patch); ++k) {
      const Vec3 way = mesh_.corner(patch, k) - mesh_.centroid[with];
      if (std::abs(mesh_.normal[with].dot(way)) > thickness_) return false;
    }
    return true;
  }

  [[nodiscard]] bool is_outer_plane(const std::vector<std::int32_t>& group) const {
    const Vec3& normal = mesh_.normal[group.front()];
    const Vec3& origin = mesh_.centroid[group.front()];
    bool any_above = false;
    bool any_below = false;
    for (const Vec3& vertex : mesh_.vertices) {
      const double height = normal.dot(vertex - origin);
      any_above |= height > thickness_;
      any_below |= height < -thickness_;
      if (any_above && any_below) return false;
    }
    return true;
  }

  /// The group in parts that share no corner: what lies apart does not merge.
  [[nodiscard]] std::vector<std::vector<std::int32_t>> connected_parts(
      const std::vector<std::int32_t>& group) const {
    DisjointSets parts(static_cast<Index>(group.size()));
    std::map<std::array<double, 3>, Index> first_at;
    for (std::size_t k = 0; k < group.size(); ++k) {
      for (int c = 0; c < mesh_.n_corners(group[k]); ++c) {
        const Vec3& p = mesh_.corner(group[k], c);
        const auto [place, is_new] = first_at.try_emplace({p.x(), p.y(), p.z()}, k);
        if (!is_new) parts.join(static_cast<Index>(k), place->second);
      }
    }
    std::vector<std::vector<std::int32_t>> result;
    for (const std::vector<Index>& part : parts.sets()) {
      auto& patches = result.emplace_back();
      for (const Index k : part) patches.push_back(group[k]);
    }
    return result;
  }

  /// Adds one occluder if the group's hull is covered by it, else halves the group and tries again.
  void merge_group(std::vector<std::int32_t>& group) {
    const Vec3 normal = mesh_.normal[group.front()];
    const Vec3 u = normal.unitOrthogonal();
    const Vec3 v = normal.cross(u);
    const Vec3 origin = mesh_.centroid[group.front()];
    std::vector<Point2> points;
    std::vector<Vec3> corners;
    std::vector<std::vector<Point2>> outlines;
    double area = 0;
    bool is_one_sided = true;
    for (const std::int32_t i : group) {
      area += mesh_.area[i];
      is_one_sided &= mesh_.twin[i] < 0 && mesh_.normal[i].dot(normal) > 0;
      auto& outline = outlines.emplace_back();
      for (int k = 0; k < mesh_.n_corners(i); ++k) {
        corners.push_back(mesh_.corner(i, k));
        outline.emplace_back(u.dot(corners.back() - origin), v.dot(corners.back() - origin));
        points.push_back(outline.back());
      }
      if (mesh_.normal[i].dot(normal) < 0) std::reverse(outline.begin(), outline.end());
    }
    const std::vector<std::int32_t> hull = convex_hull(points, thickness_);
    double hull_area = 0;
    for (std::size_t k = 2; k < hull.size(); ++k) {
      hull_area +=
          0.5 * cross2(points[hull[k - 1]] - points[hull[0]], points[hull[k]] - points[hull[0]]);
    }
    // Equal areas prove that the hull is covered, provided that nothing is covered twice.
    const bool is_covered = std::abs(hull_area - area) <= kSameArea * area && !hull.empty() &&
                            hull.size() <= kMaxCorners && !has_overlap(outlines, thickness_);
    if (group.size() == 1 || is_covered) {
      Occluder occluder;
      for (const std::int32_t k : hull) occluder.corners.push_back(corners[k]);
      if (group.size() == 1) {
        // Exactly the patch: collinear corners or not, its own outline.
        occluder.corners.assign(corners.begin(), corners.end());
      }
      occluder.normal = normal;
      occluder.offset = normal.dot(origin);
      occluder.is_one_sided = is_one_sided;
      for (const Vec3& corner : occluder.corners) occluder.box.extend(corner);
      occluders_.push_back(std::move(occluder));
      return;
    }
    divide(group, u, v);
  }

  void divide(std::vector<std::int32_t>& group, const Vec3& u, const Vec3& v) {
    Eigen::AlignedBox2d box;
    const auto place = [&](std::int32_t i) {
      return Point2(u.dot(mesh_.centroid[i]), v.dot(mesh_.centroid[i]));
    };
    for (const std::int32_t i : group) box.extend(place(i));
    const int axis = box.sizes().x() >= box.sizes().y() ? 0 : 1;
    std::sort(group.begin(), group.end(), [&](std::int32_t a, std::int32_t b) {
      const double x = place(a)[axis];
      const double y = place(b)[axis];
      return x != y ? x < y : a < b;
    });
    const auto half = static_cast<std::ptrdiff_t>(group.size() / 2);
    std::vector<std::int32_t> left(group.begin(), group.begin() + half);
    std::vector<std::int32_t> right(group.begin() + half, group.end());
    group = {};
    merge_group(left);
    merge_group(right);
  }

  const PatchMesh& mesh_;
  double thickness_;
  std::vector<Occluder> occluders_;
};

}  // namespace

std::vector<Occluder> make_occluders(const PatchMesh& mesh, double thickness) {
  return Merger(mesh, thickness).merge();
}

}  // namespace radiosity
