#include "radiosity/visibility/occluders.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "radiosity/base/box_tree.h"
#include "radiosity/base/disjoint_sets.h"
#include "radiosity/base/median_split.h"
#include "radiosity/polygon/convex_hull.h"
#include "radiosity/polygon/flat_overlap.h"
#include "radiosity/visibility/blocker.h"
#include "radiosity/visibility/half_space.h"

namespace radiosity {
namespace {

/// Hulls with more corners than this are divided: every test loops over them.
constexpr std::size_t kMaxCorners = Blocker::kMostFaces - 2;
/// A hull is the union of its patches if its area exceeds theirs by no more than this share, and
/// what the thickness makes along its border.
constexpr double kSameArea = 1e-9;
/// Gaps at least as wide as so many thicknesses are holes.
constexpr double kGapThicknesses = 16;
/// Polygons that meet in one corner are compared with each other up to this number.
constexpr std::size_t kMostAtCorner = 32;

class Merger {
 public:
  Merger(const PatchMesh& mesh, double thickness) : mesh_(mesh), thickness_(thickness) {}

  std::vector<Occluder> merge(const std::vector<std::int32_t>& patches) {
    for (Group& unit : units_of(patches)) units_.push_back(std::move(unit));
    for (std::vector<std::size_t>& part : connected_parts()) merge_units(part);
    return std::move(occluders_);
  }

 private:
  /// Patches in one plane, facing one way.
  struct Group {
    std::vector<std::int32_t> patches;
    HalfSpace plane{};
    double area = 0;
    std::vector<Vec3> outline{};  // corners of its hull, if it is convex
  };

  [[nodiscard]] bool is_in(std::int32_t patch, const HalfSpace& plane) const {
    for (int k = 0; k < mesh_.n_corners(patch); ++k) {
      const double height = plane.normal.dot(mesh_.corner(patch, k)) - plane.offset;
      if (std::abs(height) > thickness_) return false;
    }
    return true;
  }

  /// The plane through the patches that keeps most digits: of their summed vector area.
  [[nodiscard]] HalfSpace plane_of(const std::vector<std::int32_t>& patches) const {
    Vec3 normal = Vec3::Zero();
    Vec3 center = Vec3::Zero();
    double area = 0;
    const Vec3& first = mesh_.normal[patches.front()];
    for (const std::int32_t i : patches) {
      normal += (mesh_.normal[i].dot(first) < 0 ? -1 : 1) * mesh_.area[i] * mesh_.normal[i];
      center += mesh_.area[i] * mesh_.centroid[i];
      area += mesh_.area[i];
    }
    normal.normalize();
    return {normal, normal.dot(center) / area};
  }

  [[nodiscard]] bool are_coplanar(const Group& a, const Group& b) const {
    return a.plane.normal.dot(b.plane.normal) > 0.5 &&
           std::all_of(a.patches.begin(), a.patches.end(),
                       [&](std::int32_t i) { return is_in(i, b.plane); }) &&
           std::all_of(b.patches.begin(), b.patches.end(),
                       [&](std::int32_t i) { return is_in(i, a.plane); });
  }

  /// The patches by input polygon, where these are planar.
  [[nodiscard]] std::vector<Group> units_of(const std::vector<std::int32_t>& patches) const {
    std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::int32_t>> by_polygon;
    for (const std::int32_t i : patches) {
      by_polygon[{mesh_.surface[i], mesh_.polygon[i]}].push_back(i);
    }
    std::vector<Group> units;
    for (auto& [polygon, members] : by_polygon) {
      const HalfSpace plane = plane_of(members);
      const bool is_planar = std::all_of(members.begin(), members.end(), [&](std::int32_t i) {
        return is_in(i, plane) && mesh_.normal[i].dot(plane.normal) > 0.5;
      });
      if (is_planar) {
        units.push_back(make_group(std::move(members)));
      } else {
        for (const std::int32_t i : members) units.push_back(make_group({i}));
      }
    }
    return units;
  }

  [[nodiscard]] Group make_group(std::vector<std::int32_t> patches) const {
    Group group{std::move(patches)};
    group.plane = plane_of(group.patches);
    for (const std::int32_t i : group.patches) group.area += mesh_.area[i];
    group.outline = hull_of(group);
    return group;
  }

  /// Units that touch in a corner and lie in one plane.
  std::vector<std::vector<std::size_t>> connected_parts() {
    std::map<std::array<double, 3>, std::vector<std::size_t>> at;
    for (std::size_t u = 0; u < units_.size(); ++u) {
      for (const std::int32_t i : units_[u].patches) {
        for (int c = 0; c < mesh_.n_corners(i); ++c) {
          const Vec3& p = mesh_.corner(i, c);
          std::vector<std::size_t>& units = at[{p.x(), p.y(), p.z()}];
          if (units.empty() || units.back() != u) units.push_back(u);
        }
      }
    }
    DisjointSets parts(static_cast<Index>(units_.size()));
    for (const auto& [place, units] : at) {
      const std::size_t n = std::min(units.size(), kMostAtCorner);
      for (std::size_t j = 1; j < n; ++j) {
        for (std::size_t i = 0; i < j; ++i) {
          const auto a = static_cast<Index>(units[i]);
          const auto b = static_cast<Index>(units[j]);
          if (parts.find(a) != parts.find(b) && are_coplanar(units_[a], units_[b])) {
            parts.join(a, b);
          }
        }
      }
    }
    std::vector<std::vector<std::size_t>> result;
    for (const std::vector<Index>& part : parts.sets()) {
      result.emplace_back(part.begin(), part.end());
    }
    return result;
  }

  /// Corners of the hull of a group if the group covers it once and all, else none.
  [[nodiscard]] std::vector<Vec3> hull_of(const Group& group,
                                          std::span<const Group* const> parts = {}) const {
    const Vec3& normal = group.plane.normal;
    const Vec3 u = normal.unitOrthogonal();
    const Vec3 v = normal.cross(u);
    const Vec3 origin = mesh_.centroid[group.patches.front()];
    const auto flatten = [&](const Vec3& p) {
      return Point2(u.dot(p - origin), v.dot(p - origin));
    };
    std::vector<Point2> points;
    std::vector<Vec3> corners;
    std::vector<std::vector<Point2>> outlines;
    const auto add_outline = [&](std::span<const Vec3> outline) {
      auto& flat = outlines.emplace_back();
      for (const Vec3& corner : outline) {
        corners.push_back(corner);
        points.push_back(flatten(corner));
        flat.push_back(points.back());
      }
    };
    if (parts.empty()) {
      for (const std::int32_t i : group.patches) add_outline(corners_of(i));
    } else {
      for (const Group* part : parts) add_outline(part->outline);
    }
    if (group.patches.size() == 1) return corners;  // collinear corners or not, its own outline
    const std::vector<std::int32_t> hull = convex_hull(points, thickness_, kMaxCorners);
    if (hull.empty()) return {};
    double area = 0;
    double perimeter = 0;
    for (std::size_t k = 0; k < hull.size(); ++k) {
      const Point2& a = points[hull[k]];
      const Point2& b = points[hull[k + 1 < hull.size() ? k + 1 : 0]];
      area += 0.5 * cross2(a - points[hull[0]], b - points[hull[0]]);
      perimeter += (b - a).norm();
    }
    // Equal areas prove that the hull is covered, provided that nothing is covered twice.
    const double slack = kSameArea * group.area + thickness_ * perimeter;
    if (std::abs(area - group.area) > slack || has_overlap(outlines, thickness_)) return {};
    // What digits along all edges may be is enough for a small hole.
    if (area - group.area > kSameArea * group.area) {
      std::vector<Point2> border;
      for (const std::int32_t k : hull) border.push_back(points[k]);
      if (has_gap(outlines, border, kGapThicknesses * thickness_)) return {};
    }
    std::vector<Vec3> result;
    for (const std::int32_t k : hull) result.push_back(corners[k]);
    return result;
  }

  [[nodiscard]] std::vector<Vec3> corners_of(std::int32_t patch) const {
    std::vector<Vec3> corners;
    for (int k = 0; k < mesh_.n_corners(patch); ++k) corners.push_back(mesh_.corner(patch, k));
    return corners;
  }

  void add_occluder(const std::vector<Vec3>& outline, const HalfSpace& plane) {
    Occluder occluder;
    occluder.corners = outline;
    occluder.normal = plane.normal;
    occluder.offset = plane.offset;
    for (const Vec3& corner : outline) occluder.box.extend(corner);
    occluders_.push_back(std::move(occluder));
  }

  /// Adds one occluder if the units' hull is covered by them, else halves the set and tries again.
  void merge_units(std::vector<std::size_t>& members) {
    std::vector<const Group*> parts;
    std::vector<std::int32_t> patches;
    bool are_convex = true;
    for (const std::size_t u : members) {
      parts.push_back(&units_[u]);
      are_convex &= !units_[u].outline.empty();
      patches.insert(patches.end(), units_[u].patches.begin(), units_[u].patches.end());
    }
    Group all{patches, plane_of(patches)};
    for (const std::int32_t i : patches) all.area += mesh_.area[i];
    const bool is_planar = std::all_of(patches.begin(), patches.end(),
                                       [&](std::int32_t i) { return is_in(i, all.plane); });
    if (is_planar) {
      const std::vector<Vec3> outline =
          members.size() == 1 ? units_[members[0]].outline
                              : hull_of(all, are_convex ? std::span<const Group* const>(parts)
                                                        : std::span<const Group* const>());
      if (!outline.empty()) {
        add_occluder(outline, all.plane);
        return;
      }
    }
    if (members.size() > 1) {
      const auto [left, right] =
          halved(members, all.plane.normal, [&](std::size_t u) { return center_of(units_[u]); });
      std::vector<std::size_t> first = left;
      std::vector<std::size_t> second = right;
      merge_units(first);
      merge_units(second);
      return;
    }
    merge_patches(patches);
  }

  /// The same for the patches of a polygon that is not convex.
  void merge_patches(const std::vector<std::int32_t>& patches) {
    const Group group = make_group(patches);
    if (!group.outline.empty()) {
      add_occluder(group.outline, group.plane);
      return;
    }
    const auto [left, right] =
        halved(patches, group.plane.normal, [&](std::int32_t i) { return mesh_.centroid[i]; });
    merge_patches(left);
    merge_patches(right);
  }

  [[nodiscard]] Vec3 center_of(const Group& group) const {
    Vec3 center = Vec3::Zero();
    for (const std::int32_t i : group.patches) center += mesh_.area[i] * mesh_.centroid[i];
    return center / group.area;
  }

  /// Two halves along the longer of two directions in the plane.
  template <typename T, typename Place>
  static std::array<std::vector<T>, 2> halved(const std::vector<T>& members, const Vec3& normal,
                                              const Place& place) {
    const Vec3 u = normal.unitOrthogonal();
    const Vec3 v = normal.cross(u);
    Eigen::AlignedBox2d box;
    std::vector<std::pair<Point2, T>> places;
    for (const T& member : members) {
      const Vec3 p = place(member);
      places.emplace_back(Point2(u.dot(p), v.dot(p)), member);
      box.extend(places.back().first);
    }
    const int axis = box.sizes().x() >= box.sizes().y() ? 0 : 1;
    const auto halves = split_at_median(std::span(places), [axis](const auto& member) {
      return std::pair(member.first[axis], member.second);
    });
    std::array<std::vector<T>, 2> result;
    for (std::size_t k = 0; k < 2; ++k) {
      for (const auto& [point, member] : halves[k]) result[k].push_back(member);
    }
    return result;
  }

  const PatchMesh& mesh_;
  double thickness_;
  std::vector<Group> units_;
  std::vector<Occluder> occluders_;
};

/// Whether `inner` lies in the plane of `outer` and within its outline.
bool is_within(const Occluder& inner, const Occluder& outer, double thickness) {
  return std::all_of(inner.corners.begin(), inner.corners.end(), [&](const Vec3& point) {
    if (std::abs(outer.normal.dot(point) - outer.offset) > thickness) return false;
    for (std::size_t k = 0; k < outer.corners.size(); ++k) {
      const Vec3& a = outer.corners[k];
      const Vec3 edge = outer.corners[k + 1 < outer.corners.size() ? k + 1 : 0] - a;
      if (outer.normal.dot(edge.cross(point - a)) < -thickness * edge.norm()) return false;
    }
    return true;
  });
}

}  // namespace

std::vector<Occluder> make_occluders(const PatchMesh& mesh,
                                     const std::vector<std::int32_t>& patches, double thickness) {
  return Merger(mesh, thickness).merge(patches);
}

void drop_covered_occluders(std::vector<Occluder>& occluders, double thickness) {
  std::vector<std::int32_t> sorted(occluders.size());
  std::iota(sorted.begin(), sorted.end(), 0);
  std::stable_sort(sorted.begin(), sorted.end(), [&](std::int32_t a, std::int32_t b) {
    return occluders[a].box.min().x() < occluders[b].box.min().x();
  });
  // At a sharp corner what is within may reach further than the thickness.
  constexpr double kMargins = 1024;
  std::vector<Box3> boxes;
  for (const std::int32_t k : sorted)
    boxes.push_back(grown(occluders[k].box, kMargins * thickness));
  const BoxTree tree(boxes);
  std::vector<bool> is_dropped(occluders.size(), false);
  std::vector<std::int32_t> later;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(sorted.size()); ++i) {
    later.clear();
    tree.for_each_meeting(boxes[i], [&](std::int32_t j) {
      if (j > i) later.push_back(j);
    });
    std::sort(later.begin(), later.end());
    for (const std::int32_t j : later) {
      const std::int32_t a = sorted[i];
      const std::int32_t b = sorted[j];
      if (occluders[b].box.min().x() > occluders[a].box.max().x() + thickness) break;
      if (is_dropped[a] || is_dropped[b]) continue;
      if (std::abs(occluders[a].normal.dot(occluders[b].normal)) < 0.5) continue;
      if (is_within(occluders[b], occluders[a], thickness)) {
        is_dropped[b] = true;
      } else if (is_within(occluders[a], occluders[b], thickness)) {
        is_dropped[a] = true;
      }
    }
  }
  std::vector<Occluder> kept;
  for (std::size_t k = 0; k < occluders.size(); ++k) {
    if (!is_dropped[k]) kept.push_back(std::move(occluders[k]));
  }
  occluders = std::move(kept);
}

std::vector<Occluder> occluders_of_kind(const PatchMesh& mesh, std::span<const int> kinds, int kind,
                                        double thickness) {
  std::vector<std::int32_t> patches;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(mesh.size()); ++i) {
    if (!kinds.empty() && kinds[static_cast<std::size_t>(i)] != kind) continue;
    if (mesh.twin[i] < 0 || i < mesh.twin[i]) patches.push_back(i);
  }
  return patches.empty() ? std::vector<Occluder>() : make_occluders(mesh, patches, thickness);
}

}  // namespace radiosity
