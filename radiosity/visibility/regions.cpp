#include "radiosity/visibility/regions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "radiosity/base/box_tree.h"
#include "radiosity/base/disjoint_sets.h"
#include "radiosity/base/parallel.h"
#include "radiosity/visibility/patch_contact.h"

namespace radiosity {
namespace {

/// Distance, in thicknesses, at which edges touch: each may be off by one.
constexpr double kReach = 2;
/// Edges that touch at one end for no more than this share of the shorter one end there.
constexpr double kLongTouch = 0.05;
/// How far from the corner rays start, relative to the scene.
constexpr double kStart = 2e-6;
/// Volume, relative to area times size, that may be rounding.
constexpr double kNoVolume = 1e-6;
/// Directions in which rays leave a border: any that are along no axis or face.
constexpr std::array<std::array<double, 3>, 4> kDirections{{{0.5377, 0.3188, 0.7807},
                                                            {-0.6124, 0.5711, -0.5466},
                                                            {0.2931, -0.8413, 0.4542},
                                                            {0.7213, 0.2479, -0.6468}}};

struct EdgeInterval {
  double low;
  double high;
};

/// A patch at an edge, seen along it.
struct Spoke {
  std::int32_t patch;
  double angle;
  double slack;            ///< by which its angle may be off
  bool front_is_forwards;  ///< whether its front faces growing angles
  EdgeInterval along;      ///< where it is at the edge, m
};

class RegionFinder {
 public:
  RegionFinder(const PatchMesh& mesh, const Visibility& visibility, double thickness)
      : mesh_(mesh),
        visibility_(visibility),
        reach_(kReach * thickness),
        contact_(mesh, reach_),
        boxes_(make_boxes(mesh, reach_)),
        tree_(boxes_),
        sides_(2 * mesh.size() + 1) {}

  std::vector<std::int32_t> run() {
    join_around_edges();
    if (is_one()) return std::vector<std::int32_t>(mesh_.size(), 0);
    join_by_rays();
    std::vector<std::int32_t> region(mesh_.size());
    std::map<Index, std::int32_t> numbers;
    for (Index i = 0; i < mesh_.size(); ++i) {
      const auto next = static_cast<std::int32_t>(numbers.size());
      region[i] = numbers.try_emplace(sides_.find(front(i)), next).first->second;
    }
    return region;
  }

 private:
  /// Sides to join.
  using Joints = std::vector<std::pair<Index, Index>>;

  static std::vector<Box3> make_boxes(const PatchMesh& mesh, double margin) {
    std::vector<Box3> boxes;
    boxes.reserve(mesh.size());
    for (Index i = 0; i < mesh.size(); ++i) boxes.push_back(grown(patch_box(mesh, i), margin));
    return boxes;
  }

  [[nodiscard]] Index front(Index patch) const { return 2 * patch; }
  [[nodiscard]] Index back(Index patch) const {
    return mesh_.twin[patch] < 0 ? 2 * patch + 1 : 2 * Index{mesh_.twin[patch]};
  }
  /// The side of all that lies in no direction behind anything.
  [[nodiscard]] Index outside() const { return 2 * mesh_.size(); }
  /// Of twins the second stands for nothing of its own.
  [[nodiscard]] bool is_second(Index patch) const {
    return mesh_.twin[patch] >= 0 && mesh_.twin[patch] < patch;
  }

  bool is_one() {
    for (Index i = 1; i < mesh_.size(); ++i) {
      if (sides_.find(front(i)) != sides_.find(front(0))) return false;
    }
    return true;
  }

  void join_all(std::int32_t i, std::int32_t j, Joints& joints) const {
    joints.emplace_back(front(i), back(i));
    joints.emplace_back(front(i), front(j));
    joints.emplace_back(front(j), back(j));
  }

  /// Whether two patches that lie on each other, or beside each other, are in one plane.
  [[nodiscard]] bool are_in_one_plane(std::int32_t i, std::int32_t j) const {
    const auto is_in_plane_of = [&](std::int32_t patch, std::int32_t of) {
      for (int k = 0; k < mesh_.n_corners(patch); ++k) {
        const Vec3 off = mesh_.corner(patch, k) - mesh_.centroid[of];
        if (std::abs(mesh_.normal[of].dot(off)) > reach_) return false;
      }
      return true;
    };
    return is_in_plane_of(i, j) && is_in_plane_of(j, i);
  }

  /// Joins what is on either side of patches that touch: of such in one plane the two sides of that
  /// stay apart, as of walls made of two sheets back to back.
  void join_touching(std::int32_t i, std::int32_t j, Joints& joints) const {
    if (!are_in_one_plane(i, j)) return join_all(i, j, joints);
    const bool is_turned = mesh_.normal[i].dot(mesh_.normal[j]) < 0;
    joints.emplace_back(front(i), is_turned ? back(j) : front(j));
    joints.emplace_back(back(i), is_turned ? front(j) : back(j));
  }

  void join_around_edges() {
    constexpr std::int32_t kMostInGroup = 32;
    constexpr Index kGrain = 8;
    const std::vector<BoxTree::Group> groups = tree_.groups(kMostInGroup);
    std::vector<Joints> joints(groups.size());
    parallel_ranges(static_cast<std::ptrdiff_t>(groups.size()), kGrain,
                    [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
                      Around around;
                      for (std::ptrdiff_t g = begin; g < end; ++g) {
                        join_around(groups[g], around, joints[g]);
                      }
                    });
    for (const Joints& of_group : joints) {
      for (const auto& [a, b] : of_group) sides_.join(a, b);
    }
  }

  /// A patch near another, at hand.
  struct Near {
    std::int32_t patch;
    Box3 box;
    int n_corners;
    std::array<Vec3, 4> corners;
  };

  /// What is looked at about one patch; kept for the next one, to spare memory's time.
  struct Around {
    std::vector<Near> near_group;  // near one of a group of patches
    std::vector<const Near*> near;
    std::vector<Spoke> spokes;
    std::vector<double> ends;
    std::vector<const Spoke*> here;
  };

  /// Joins the sides about the patches of a group.
  void join_around(BoxTree::Group group, Around& around, Joints& joints) const {
    around.near_group.clear();
    tree_.for_each_meeting(tree_.box(group), [&](std::int32_t j) {
      if (is_second(j)) return;
      Near& near = around.near_group.emplace_back(Near{j, boxes_[j], mesh_.n_corners(j), {}});
      for (int m = 0; m < near.n_corners; ++m) near.corners[m] = mesh_.corner(j, m);
    });
    for (const std::int32_t i : tree_.members(group)) {
      if (!is_second(i)) join_around_patch(i, around, joints);
    }
  }

  void join_around_patch(std::int32_t i, Around& around, Joints& joints) const {
    around.near.clear();
    for (const Near& near : around.near_group) {
      if (near.patch != i && near.box.intersects(boxes_[i])) around.near.push_back(&near);
    }
    const PatchContact::Inwards inwards = contact_.all_inwards(i);
    for (const Near* near : around.near) {
      const std::int32_t j = near->patch;
      if (j > i && contact_.cross_or_cover(i, j, inwards)) join_touching(i, j, joints);
    }
    for (int k = 0; k < mesh_.n_corners(i); ++k) {
      join_at_edge(i, k, inwards[k], around, joints);
    }
  }

  /// Joins the sides about edge k of patch i with those next to them.
  void join_at_edge(std::int32_t i, int k, const Vec3& zero, Around& around, Joints& joints) const {
    const Vec3& a = contact_.corner(i, k);
    const double length = (contact_.corner(i, k + 1) - a).norm();
    Box3 box(a, a);
    box.extend(contact_.corner(i, k + 1));
    if (length <= 2 * reach_) {
      // Too short to tell what is beside it.
      for (const Near* near : around.near) {
        if (near->box.intersects(box)) join_all(i, near->patch, joints);
      }
      return;
    }
    const Vec3 u = (contact_.corner(i, k + 1) - a) / length;
    around.spokes.clear();
    around.spokes.push_back(spoke(i, k, u, zero, {0, length}));
    // Twice the reach, since the others' boxes are grown, too: whatever is rounded, nothing that
    // touches the edge is outside.
    const Box3 box_of_edge = grown(box, reach_);
    for (const Near* near : around.near) {
      if (near->box.intersects(box_of_edge))
        add_spokes(i, *near, a, u, length, zero, around, joints);
    }
    join_along_edge(length, around, joints);
  }

  /// Adds the edges of a patch that lie along an edge of patch i, from `a` on in direction `u`, to
  /// the spokes there.
  void add_spokes(std::int32_t i, const Near& near, const Vec3& a, const Vec3& u, double length,
                  const Vec3& zero, Around& around, Joints& joints) const {
    std::array<Vec3, 4> off;
    std::array<double, 4> place;
    for (int m = 0; m < near.n_corners; ++m) {
      off[m] = near.corners[m] - a;
      place[m] = u.dot(off[m]);
    }
    for (int m = 0; m < near.n_corners; ++m) {
      const int next = m + 1 < near.n_corners ? m + 1 : 0;
      const Vec3& p = off[m];
      const Vec3& q = off[next];
      const double t = place[m];
      const double s = place[next];
      if (std::max(t, s) <= 0 || std::min(t, s) >= length) continue;
      if ((p - t * u).norm() > reach_ || (q - s * u).norm() > reach_) {
        if (!touches(p, q, u, length)) continue;
        // Lines at a small angle: beside each other for a while only.
        join_all(i, near.patch, joints);
        continue;
      }
      const EdgeInterval along{std::max(0.0, std::min(t, s)), std::min(length, std::max(t, s))};
      around.spokes.push_back(spoke(near.patch, m, u, zero, along));
    }
  }

  /// Joins the sides of the spokes of an edge with those next to them, wherever they are along it.
  void join_along_edge(double length, Around& around, Joints& joints) const {
    std::vector<Spoke>& spokes = around.spokes;
    std::vector<double>& ends = around.ends;
    ends.assign({0, length});
    for (const Spoke& s : spokes) {
      ends.push_back(s.along.low);
      ends.push_back(s.along.high);
    }
    std::sort(ends.begin(), ends.end());
    std::sort(spokes.begin(), spokes.end(),
              [](const Spoke& x, const Spoke& y) { return x.angle < y.angle; });
    for (std::size_t e = 0; e + 1 < ends.size(); ++e) {
      if (ends[e + 1] - ends[e] <= 2 * reach_) continue;
      const double middle = (ends[e] + ends[e + 1]) / 2;
      around.here.clear();
      for (const Spoke& s : spokes) {
        if (s.along.low <= middle && middle <= s.along.high) around.here.push_back(&s);
      }
      join_in_turn(around.here, joints);
    }
  }

  /// Whether the line from p to q is closer than `reach_` to that from 0 to length u for a good
  /// part of either.
  [[nodiscard]] bool touches(const Vec3& p, const Vec3& q, const Vec3& u, double length) const {
    // Distance from the line is convex along p-q: look where it is least.
    const Vec3 d = q - p;
    const Vec3 across_p = p - u.dot(p) * u;
    const Vec3 across_d = d - u.dot(d) * u;
    const double squared = across_d.squaredNorm();
    if (squared <= 0) return false;  // parallel and further off
    const double at = std::clamp(-across_p.dot(across_d) / squared, 0.0, 1.0);
    const double least = (across_p + at * across_d).norm();
    if (least > reach_) return false;
    const double half = std::sqrt(reach_ * reach_ - least * least) / std::sqrt(squared);
    const double t0 = u.dot(p + std::max(0.0, at - half) * d);
    const double t1 = u.dot(p + std::min(1.0, at + half) * d);
    const double overlap = std::min(length, std::max(t0, t1)) - std::max(0.0, std::min(t0, t1));
    return overlap > std::max(4 * reach_, kLongTouch * std::min(length, d.norm()));
  }

  [[nodiscard]] Spoke spoke(std::int32_t patch, int edge, const Vec3& u, const Vec3& zero,
                            const EdgeInterval& along) const {
    const Vec3 w = contact_.inwards(patch, edge);
    const double length = (contact_.corner(patch, edge + 1) - contact_.corner(patch, edge)).norm();
    return {patch, std::atan2(w.dot(u.cross(zero)), w.dot(zero)),
            PatchContact::kParallel + reach_ * length / mesh_.area[patch],
            mesh_.normal[patch].dot(u.cross(w)) > 0, along};
  }

  [[nodiscard]] Index forwards(const Spoke& s) const {
    return s.front_is_forwards ? front(s.patch) : back(s.patch);
  }
  [[nodiscard]] Index backwards(const Spoke& s) const {
    return s.front_is_forwards ? back(s.patch) : front(s.patch);
  }

  /// Joins what faces each other of neighbours in the order of angles.
  void join_in_turn(std::span<const Spoke* const> spokes, Joints& joints) const {
    for (std::size_t k = 0; k < spokes.size(); ++k) {
      const Spoke& one = *spokes[k];
      const Spoke& next = *spokes[k + 1 < spokes.size() ? k + 1 : 0];
      const double turn = next.angle - one.angle + (k + 1 < spokes.size() ? 0 : 2 * kPi);
      if (&one != &next && turn <= one.slack + next.slack) {
        join_touching(one.patch, next.patch, joints);
      } else {
        joints.emplace_back(forwards(one), backwards(next));
      }
    }
  }

  struct Border {
    std::vector<Index> sides;
    double volume = 0;  ///< within, m³; negative if it is outside
    double area = 0;
  };

  void join_by_rays() {
    const Box3 box = bounds(mesh_);
    const double size = box.diagonal().norm();
    const Vec3 center = box.center();
    std::map<Index, Border> borders;
    for (Index i = 0; i < mesh_.size(); ++i) {
      const double third = mesh_.area[i] * mesh_.normal[i].dot(mesh_.centroid[i] - center) / 3;
      const auto add = [&](Index side, double volume) {
        Border& border = borders[sides_.find(side)];
        border.sides.push_back(i);
        border.volume += volume;
        border.area += mesh_.area[i];
      };
      add(front(i), third);
      if (mesh_.twin[i] < 0) add(back(i), -third);
    }
    for (auto& [name, border] : borders) {
      if (border.volume < -kNoVolume * border.area * size) continue;  // around its region
      for (const auto& [x, y, z] : kDirections) {
        leave(name, border, Vec3(x, y, z).normalized(), kStart * size);
      }
    }
  }

  /// Joins a border to what is beyond it in a direction.
  void leave(Index name, const Border& border, const Vec3& direction, double start) {
    const Vec3* furthest = nullptr;
    for (const Index patch : border.sides) {
      for (int k = 0; k < mesh_.n_corners(patch); ++k) {
        const Vec3& x = mesh_.corner(patch, k);
        if (furthest == nullptr || direction.dot(x) > direction.dot(*furthest)) furthest = &x;
      }
    }
    tree_.for_each_meeting(grown(Box3(*furthest, *furthest), start), [&](std::int32_t patch) {
      // What is closer than rays start.
      const double distance = mesh_.normal[patch].dot(*furthest - mesh_.centroid[patch]);
      if (std::abs(distance) > start + reach_) return;
      if (has_side_of(patch, name)) return;
      sides_.join(name, front(patch));
      sides_.join(name, back(patch));
    });
    const auto hit = visibility_.first_hit(*furthest + start * direction, direction);
    if (!hit) {
      sides_.join(name, outside());
      return;
    }
    sides_.join(name, hit->front ? front(hit->patch) : back(hit->patch));
  }

  /// Whether a patch belongs to the border that `name` stands for.
  bool has_side_of(std::int32_t patch, Index name) {
    const Index set = sides_.find(name);
    return sides_.find(front(patch)) == set || sides_.find(back(patch)) == set;
  }

  const PatchMesh& mesh_;
  const Visibility& visibility_;
  double reach_;
  PatchContact contact_;
  std::vector<Box3> boxes_;
  BoxTree tree_;
  DisjointSets sides_;
};

}  // namespace

std::vector<std::int32_t> find_regions(const PatchMesh& mesh, const Visibility& visibility,
                                       double thickness) {
  if (mesh.size() == 0) return {};
  return RegionFinder(mesh, visibility, thickness).run();
}

}  // namespace radiosity
