#include "radiosity/visibility/region_borders.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "radiosity/base/parallel.h"
#include "radiosity/visibility/patch_contact.h"

namespace radiosity {
namespace {

/// What rounding leaves open between edges that were meant to meet, at most, in reaches. Less than
/// one, so that a wall on such edges is within reach of both.
constexpr double kCrack = 0.5;
/// How far beside an edge it is asked what is there, in reaches: beyond all cracks.
constexpr double kAside = 1.5;
/// Parts of longer edges that are shorter, in reaches, are passed over.
constexpr double kCorner = 32;
/// Edges that leave a plane within so many reaches pass through it.
constexpr double kBrief = 20;

/// A patch near another, at hand.
struct NearPatch {
  std::int32_t patch;
  Box3 box;
  int n_corners;
  std::array<Vec3, 4> corners;
  PatchContact::Inwards inwards;
};

/// A patch in whose plane an edge lies, and from where to where it may be beside it, m.
struct PatchAlong {
  const NearPatch* near;
  Vec3 across;  ///< unit, in the patch's plane
  PatchContact::Part along;
};

/// An edge that is gone around.
struct Edge {
  Vec3 start;
  Vec3 unit;
  double length;
  Vec3 zero;  ///< where angles are counted from: into its patch
  Box3 box;
};

class BorderJoiner {
 public:
  BorderJoiner(const PatchMesh& mesh, double reach, const BoxTree& tree,
               const std::vector<Box3>& boxes)
      : mesh_(mesh),
        sides_{mesh},
        reach_(reach),
        tree_(tree),
        boxes_(boxes),
        contact_(mesh, reach) {}

  std::vector<BorderJoints> run() {
    constexpr std::int32_t kMostInGroup = 32;
    constexpr Index kGrain = 8;
    const std::vector<BoxTree::Group> groups = tree_.groups(kMostInGroup);
    std::vector<BorderJoints> joints(groups.size());
    parallel_ranges(static_cast<std::ptrdiff_t>(groups.size()), kGrain,
                    [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
                      Around around;
                      for (std::ptrdiff_t g = begin; g < end; ++g) {
                        join_around(groups[g], around, joints[g]);
                      }
                    });
    return joints;
  }

 private:
  /// What is looked at about one patch; kept for the next one, to spare memory's time.
  struct Around {
    std::vector<NearPatch> near_group;  // near one of a group of patches
    std::vector<const NearPatch*> near;
    const NearPatch* own = nullptr;
    std::vector<PatchAlong> along;
    std::vector<double> ends;
    std::vector<Spoke> spokes;
  };

  /// Joins the sides about the patches of a group.
  void join_around(BoxTree::Group group, Around& around, BorderJoints& joints) const {
    around.near_group.clear();
    tree_.for_each_meeting(tree_.box(group), [&](std::int32_t j) {
      if (sides_.is_second(j)) return;
      NearPatch& near = around.near_group.emplace_back(
          NearPatch{j, boxes_[j], mesh_.n_corners(j), {}, contact_.all_inwards(j)});
      for (int m = 0; m < near.n_corners; ++m) near.corners[m] = mesh_.corner(j, m);
    });
    for (const std::int32_t i : tree_.members(group)) {
      if (!sides_.is_second(i)) join_around_patch(i, around, joints);
    }
  }

  void join_around_patch(std::int32_t i, Around& around, BorderJoints& joints) const {
    around.near.clear();
    for (const NearPatch& near : around.near_group) {
      if (near.patch == i) around.own = &near;
      if (near.patch != i && near.box.intersects(boxes_[i])) around.near.push_back(&near);
    }
    const PatchContact::Inwards& inwards = around.own->inwards;
    for (const NearPatch* near : around.near) {
      if (near->patch > i) join_pair(i, near->patch, inwards, joints);
    }
    for (int k = 0; k < mesh_.n_corners(i); ++k) {
      join_at_edge(i, k, inwards[k], around, joints);
    }
  }

  /// What no edge tells of two patches that touch.
  void join_pair(std::int32_t i, std::int32_t j, const PatchContact::Inwards& inwards,
                 BorderJoints& joints) const {
    const Contact contact = contact_.between(i, j, inwards);
    if (contact == Contact::overlaps) joints.overlaps.emplace_back(i, j);
    const bool is_flat = contact == Contact::overlaps || contact == Contact::leans;
    if (contact == Contact::crosses || (is_flat && face_each_other(i, j))) {
      join_all(sides_, i, j, joints.sides);
    }
  }

  /// Whether two patches that lie on each other see each other across a gap: in that of what is
  /// not yet in one plane they do.
  [[nodiscard]] bool face_each_other(std::int32_t i, std::int32_t j) const {
    const auto height = contact_.heights_over(i, j);
    const bool is_turned = mesh_.normal[i].dot(mesh_.normal[j]) < 0;
    const bool is_i_two_sided = mesh_.twin[i] >= 0;
    const bool is_j_two_sided = mesh_.twin[j] >= 0;
    const double least = reach_ / 2;
    return (height->high > least && (is_turned || is_j_two_sided)) ||
           (height->low < -least && is_i_two_sided && (!is_turned || is_j_two_sided));
  }

  /// Joins the sides about edge k of patch i with those next to them.
  void join_at_edge(std::int32_t i, int k, const Vec3& zero, Around& around,
                    BorderJoints& joints) const {
    const Vec3& a = contact_.corner(i, k);
    const Vec3& b = contact_.corner(i, k + 1);
    Edge edge{a, b - a, (b - a).norm(), zero, Box3(a, a)};
    edge.box.extend(b);
    if (edge.length <= 2 * reach_) {
      // Too short to tell what is beside it.
      for (const NearPatch* near : around.near) {
        if (near->box.intersects(edge.box)) join_all(sides_, i, near->patch, joints.sides);
      }
      return;
    }
    edge.unit /= edge.length;
    around.along.clear();
    around.ends.assign({0, edge.length});
    // Twice the reach, since the others' boxes are grown, too: whatever is rounded, nothing that
    // touches the edge is outside.
    edge.box = grown(edge.box, reach_);
    for (const NearPatch* near : around.near) {
      if (near->box.intersects(edge.box)) add_along(*near, edge, around);
    }
    std::sort(around.ends.begin(), around.ends.end());
    // About corners there is more within the reach than one edge tells. The longest part tells
    // most.
    double longest = 0;
    for (std::size_t e = 0; e + 1 < around.ends.size(); ++e) {
      longest = std::max(longest, around.ends[e + 1] - around.ends[e]);
    }
    const double shortest =
        std::min(longest, std::max(2 * reach_, std::min(kCorner * reach_, edge.length / 4)));
    // Where its own patch is narrower than it is looked aside, at a sharp corner, others are there.
    bool is_any_wide = false;
    for (const bool is_wide : {true, false}) {
      for (std::size_t e = 0; e + 1 < around.ends.size(); ++e) {
        if (around.ends[e + 1] - around.ends[e] < shortest) continue;
        const Vec3 point = edge.start + (around.ends[e] + around.ends[e + 1]) / 2 * edge.unit;
        if (is_wide && !holds(*around.own, point + kAside * reach_ * zero)) continue;
        join_at(edge, i, point, around, joints.sides);
        is_any_wide = true;
      }
      if (is_any_wide) return;
    }
  }

  /// Adds a patch if the edge lies in its plane, and where that changes.
  void add_along(const NearPatch& near, const Edge& edge, Around& around) const {
    const Vec3& normal = mesh_.normal[near.patch];
    const double first = normal.dot(edge.start - mesh_.centroid[near.patch]);
    const double rise = normal.dot(edge.unit);
    PatchContact::Part part{0, edge.length};
    if (!narrow(first + reach_, rise, part) || !narrow(reach_ - first, -rise, part)) return;
    const bool is_brief = part.high - part.low < kBrief * reach_;
    if (is_brief && part.high - part.low < edge.length) return;
    PatchContact::Part over = part;
    for (int m = 0; m < near.n_corners; ++m) {
      const Vec3& a = near.corners[m];
      const Vec3& in = near.inwards[m];
      const double height = in.dot(edge.start - a);
      const double slope = in.dot(edge.unit);
      if (!narrow(height + kCrack * reach_, slope, part)) return;
      narrow(height, slope, over);
    }
    if (part.high - part.low <= 2 * reach_) return;
    around.along.push_back({&near, normal.cross(edge.unit).normalized(), part});
    around.ends.insert(around.ends.end(), {part.low, part.high});
    if (over.low < over.high) around.ends.insert(around.ends.end(), {over.low, over.high});
  }

  /// Leaves of a part where start + slope * t >= 0, and tells whether there is any.
  static bool narrow(double start, double slope, PatchContact::Part& part) {
    if (start + slope * part.low < 0) {
      if (slope <= 0) return false;
      part.low = -start / slope;
    }
    if (start + slope * part.high < 0) {
      if (slope >= 0) return false;
      part.high = -start / slope;
    }
    return part.low <= part.high;
  }

  /// Joins the sides of the patches about a point of an edge of patch i.
  void join_at(const Edge& edge, std::int32_t i, const Vec3& point, Around& around,
               SideJoints& joints) const {
    const double place = edge.unit.dot(point - edge.start);
    around.spokes.clear();
    around.spokes.push_back(spoke(i, edge.zero, edge));
    for (const PatchAlong& other : around.along) {
      if (place < other.along.low || place > other.along.high) continue;
      for (const double sign : {1., -1.}) {
        const Vec3 off = sign * other.across;
        if (holds(*other.near, point + kAside * reach_ * off)) {
          around.spokes.push_back(spoke(other.near->patch, off, edge));
        }
      }
    }
    std::sort(around.spokes.begin(), around.spokes.end(),
              [](const Spoke& x, const Spoke& y) { return x.angle < y.angle; });
    join_in_turn(sides_, around.spokes, joints);
  }

  /// Whether a point near a patch's plane is over it.
  [[nodiscard]] bool holds(const NearPatch& near, const Vec3& point) const {
    for (int k = 0; k < near.n_corners; ++k) {
      if (near.inwards[k].dot(point - near.corners[k]) < -kCrack * reach_) return false;
    }
    return true;
  }

  /// A patch that goes off an edge in the direction `off`.
  [[nodiscard]] Spoke spoke(std::int32_t patch, const Vec3& off, const Edge& edge) const {
    double low = 0;
    double high = 0;
    for (int k = 0; k < mesh_.n_corners(patch); ++k) {
      const double there = off.dot(mesh_.corner(patch, k) - edge.start);
      low = std::min(low, there);
      high = std::max(high, there);
    }
    return {patch, std::atan2(off.dot(edge.unit.cross(edge.zero)), off.dot(edge.zero)),
            PatchContact::kParallel + reach_ / (high - low),
            mesh_.normal[patch].dot(edge.unit.cross(off)) > 0};
  }

  const PatchMesh& mesh_;
  PatchSides sides_;
  double reach_;
  const BoxTree& tree_;
  const std::vector<Box3>& boxes_;
  PatchContact contact_;
};

}  // namespace

std::vector<BorderJoints> find_border_joints(const PatchMesh& mesh, double reach,
                                             const BoxTree& tree, const std::vector<Box3>& boxes) {
  return BorderJoiner(mesh, reach, tree, boxes).run();
}

}  // namespace radiosity
