#include "radiosity/visibility/regions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <span>

#include "radiosity/base/box_tree.h"
#include "radiosity/base/disjoint_sets.h"
#include "radiosity/visibility/free_sides.h"
#include "radiosity/visibility/patch_sides.h"
#include "radiosity/visibility/region_borders.h"

namespace radiosity {
namespace {

/// Distance, in thicknesses, at which edges touch: each may be off by one.
constexpr double kReach = 2;
/// How far from the corner rays start, relative to the scene.
constexpr double kStart = 2e-6;
/// Volume, relative to area times size, that may be rounding.
constexpr double kNoVolume = 1e-6;
/// How far apart digits may put sheets back to back, in reaches.
constexpr double kApart = 2;
/// Directions in which rays leave a border: any that are along no axis or face.
constexpr std::array<std::array<double, 3>, 4> kDirections{{{0.5377, 0.3188, 0.7807},
                                                            {-0.6124, 0.5711, -0.5466},
                                                            {0.2931, -0.8413, 0.4542},
                                                            {0.7213, 0.2479, -0.6468}}};

class RegionFinder {
 public:
  RegionFinder(const PatchMesh& mesh, const Visibility& visibility, double thickness)
      : mesh_(mesh),
        visibility_(visibility),
        reach_(kReach * thickness),
        sides_{mesh},
        boxes_(make_boxes(mesh, reach_)),
        tree_(boxes_),
        sets_(sides_.size() + 1) {}

  std::vector<std::int32_t> run() {
    std::vector<std::pair<std::int32_t, std::int32_t>> overlaps;
    for (const BorderJoints& joints : find_border_joints(mesh_, reach_, tree_, boxes_)) {
      for (const auto& [a, b] : joints.sides) sets_.join(a, b);
      overlaps.insert(overlaps.end(), joints.overlaps.begin(), joints.overlaps.end());
    }
    if (is_one()) return std::vector<std::int32_t>(mesh_.size(), 0);
    free_.emplace(sides_, overlaps, reach_);
    join_by_rays();
    std::vector<std::int32_t> region(mesh_.size());
    std::map<Index, std::int32_t> numbers;
    for (Index i = 0; i < mesh_.size(); ++i) {
      const auto next = static_cast<std::int32_t>(numbers.size());
      region[i] = numbers.try_emplace(sets_.find(sides_.front(i)), next).first->second;
    }
    return region;
  }

 private:
  static std::vector<Box3> make_boxes(const PatchMesh& mesh, double margin) {
    std::vector<Box3> boxes;
    boxes.reserve(mesh.size());
    for (Index i = 0; i < mesh.size(); ++i) boxes.push_back(grown(patch_box(mesh, i), margin));
    return boxes;
  }

  /// The side of all that lies in no direction behind anything.
  [[nodiscard]] Index outside() const { return sides_.size(); }

  bool is_one() {
    for (Index i = 1; i < mesh_.size(); ++i) {
      if (sets_.find(sides_.front(i)) != sets_.find(sides_.front(0))) return false;
    }
    return true;
  }

  /// The sides of a set, as far as nothing covers them.
  using Outline = FreeSides::Outline;
  struct Border {
    std::vector<Vec3> corners;
    double volume = 0;  ///< within, m³; negative if it is outside
    double area = 0;
  };

  void join_by_rays() {
    const Box3 box = bounds(mesh_);
    const double size = box.diagonal().norm();
    const Vec3 center = box.center();
    std::map<Index, Border> borders;
    for (Index i = 0; i < mesh_.size(); ++i) {
      if (sides_.is_second(i)) continue;
      Outline whole;
      for (int k = 0; k < mesh_.n_corners(i); ++k) whole.push_back(mesh_.corner(i, k));
      for (const bool is_front : {true, false}) {
        const Index side = is_front ? sides_.front(i) : sides_.back(i);
        Border& border = borders[sets_.find(side)];
        const std::vector<Outline>* const parts = free_->parts(side);
        const std::span<const Outline> counted = parts == nullptr
                                                     ? std::span<const Outline>(&whole, 1)
                                                     : std::span<const Outline>(*parts);
        for (const Outline& part : counted) {
          const Vec3 area = (is_front ? 1 : -1) * vector_area(part);
          border.volume += area.dot(part[0] - center) / 3;
          border.area += area.norm();
          border.corners.insert(border.corners.end(), part.begin(), part.end());
        }
        // All that may emit is there.
        if (parts == nullptr || (!is_front && mesh_.twin[i] < 0)) continue;
        border.corners.insert(border.corners.end(), whole.begin(), whole.end());
      }
    }
    for (auto& [name, border] : borders) {
      if (border.corners.empty()) continue;
      // Around its region. Digits make a volume of sheets back to back, too.
      if (border.volume < -(kNoVolume * size + kApart * reach_) * border.area) continue;
      for (const auto& [x, y, z] : kDirections) {
        leave(name, border, Vec3(x, y, z).normalized(), kStart * size);
      }
    }
  }

  /// Joins a border to what is beyond it in a direction.
  void leave(Index name, const Border& border, const Vec3& direction, double start) {
    const Vec3 furthest = *std::max_element(
        border.corners.begin(), border.corners.end(),
        [&](const Vec3& x, const Vec3& y) { return direction.dot(x) < direction.dot(y); });
    tree_.for_each_meeting(grown(Box3(furthest, furthest), start), [&](std::int32_t patch) {
      // What is closer than rays start.
      const double distance = mesh_.normal[patch].dot(furthest - mesh_.centroid[patch]);
      if (std::abs(distance) > start + reach_) return;
      if (has_side_of(patch, name) || !reaches_beyond(patch, furthest, direction)) return;
      sets_.join(name, sides_.front(patch));
      sets_.join(name, sides_.back(patch));
    });
    const Vec3 origin = furthest + start * direction;
    const auto hit = visibility_.first_hit(origin, direction);
    if (!hit) {
      sets_.join(name, outside());
      return;
    }
    sets_.join(name, hit->front ? sides_.front(hit->patch) : sides_.back(hit->patch));
    if (hit->front) return;
    // Another that lies on it may be what is met.
    const Vec3 there = origin + hit->distance * direction;
    for (const std::int32_t cover : free_->covers(sides_.back(hit->patch))) {
      if (!boxes_[cover].intersects(grown(Box3(there, there), start))) continue;
      const bool is_turned = mesh_.normal[cover].dot(mesh_.normal[hit->patch]) < 0;
      sets_.join(name, is_turned ? sides_.front(cover) : sides_.back(cover));
    }
  }

  [[nodiscard]] bool reaches_beyond(std::int32_t patch, const Vec3& point,
                                    const Vec3& direction) const {
    constexpr double kReaches = 4;
    for (int k = 0; k < mesh_.n_corners(patch); ++k) {
      if (direction.dot(mesh_.corner(patch, k) - point) > kReaches * reach_) return true;
    }
    return false;
  }

  /// Whether a patch belongs to the border that `name` stands for.
  bool has_side_of(std::int32_t patch, Index name) {
    const Index set = sets_.find(name);
    return sets_.find(sides_.front(patch)) == set || sets_.find(sides_.back(patch)) == set;
  }

  const PatchMesh& mesh_;
  const Visibility& visibility_;
  double reach_;
  PatchSides sides_;
  std::vector<Box3> boxes_;
  BoxTree tree_;
  DisjointSets sets_;
  std::optional<FreeSides> free_;
};

}  // namespace

std::vector<std::int32_t> find_regions(const PatchMesh& mesh, const Visibility& visibility,
                                       double thickness) {
  if (mesh.size() == 0) return {};
  return RegionFinder(mesh, visibility, thickness).run();
}

}  // namespace radiosity
