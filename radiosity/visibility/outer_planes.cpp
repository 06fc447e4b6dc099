#include "radiosity/visibility/outer_planes.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "radiosity/visibility/half_space.h"

namespace radiosity {
namespace {

/// Scenes with more plane-vertex tests than this keep their outer planes among the occluders: that
/// costs time later, never correctness.
constexpr double kMaxOuterPlaneTests = 2e9;
/// Outer planes that are remembered.
constexpr std::size_t kMostKnown = 64;

/// Vertices in one of the blocks that are tested together.
constexpr std::size_t kBlock = 64;
/// Rounding of heights, relative to what they are summed from.
constexpr double kHeightRounding = 1e-12;

/// Whether all points in a box are behind a plane for sure, whatever is rounded.
bool is_behind(const Box3& box, const Vec3& normal, double limit) {
  const Vec3 furthest = (normal.array() > 0).select(box.max(), box.min());
  const Vec3 most = box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs());
  return normal.dot(furthest) + kHeightRounding * normal.cwiseAbs().dot(most) <= limit;
}

/// The planes that have the whole scene on one side.
class OuterPlanes {
 public:
  OuterPlanes(const PatchMesh& mesh, double thickness) : mesh_(mesh), thickness_(thickness) {
    // What lies far out in some direction comes first, so that most planes are done with early.
    order_ = mesh.vertices;
    std::size_t n_first = 0;
    for (int direction = 0; direction < 26; ++direction) {
      const int code = direction < 13 ? direction : direction + 1;
      const Eigen::Array3i digits(code % 3, code / 3 % 3, code / 9);
      const Vec3 way = (digits - 1).matrix().cast<double>();
      const auto furthest =
          std::max_element(order_.begin(), order_.end(),
                           [&](const Vec3& a, const Vec3& b) { return way.dot(a) < way.dot(b); });
      if (furthest == order_.end()) return;
      const auto place = static_cast<std::size_t>(furthest - order_.begin());
      if (place >= n_first) std::swap(order_[place], order_[n_first++]);
    }
  }

  /// Whether one of them holds the patch. Those of a plane polygon are all held or none is: a
  /// surface is not torn where it leaves the outer plane by about the thickness.
  bool holds(Index patch) {
    if (mesh_.n_polygons() == 0) return holds(corners_of(patch), mesh_.normal[patch]);
    if (of_polygon_.empty()) judge_polygons();
    const Held held = of_polygon_[mesh_.polygon[patch]];
    if (held == Held::by_patch) return holds(corners_of(patch), mesh_.normal[patch]);
    return held == Held::yes;
  }

 private:
  enum class Held : char { no, yes, by_patch };

  void judge_polygons() {
    of_polygon_.assign(mesh_.n_polygons(), Held::no);
    std::vector<Vec3> normals;
    for (Index p = 0; p < mesh_.n_polygons(); ++p) {
      normals.push_back(vector_area(mesh_.outline(p)).normalized());
      if (holds(mesh_.outline(p), normals.back())) of_polygon_[p] = Held::yes;
    }
    for (Index i = 0; i < mesh_.size(); ++i) {
      const std::int32_t p = mesh_.polygon[i];
      const Vec3& on_plane = mesh_.outline(p)[0];
      for (const Vec3& corner : corners_of(i)) {
        // Twice: the first corner may be off the plane, too.
        const bool is_on = std::abs(normals[p].dot(corner - on_plane)) <= 2 * thickness_;
        if (!is_on) of_polygon_[p] = Held::by_patch;
      }
    }
  }

  [[nodiscard]] std::vector<Vec3> corners_of(Index patch) const {
    std::vector<Vec3> result;
    for (int k = 0; k < mesh_.n_corners(patch); ++k) result.push_back(mesh_.corner(patch, k));
    return result;
  }

  bool holds(std::span<const Vec3> corners, const Vec3& normal) {
    for (std::size_t k = 0; k < std::min(known_.size(), kMostKnown); ++k) {
      const HalfSpace& plane = known_[k];
      if (std::abs(plane.normal.dot(normal)) > 0.9 && is_in(corners, plane)) return true;
    }
    Vec3 center = Vec3::Zero();
    for (const Vec3& corner : corners) center += corner;
    const HalfSpace plane{normal, normal.dot(center) / static_cast<double>(corners.size())};
    if (n_tests_ > kMaxOuterPlaneTests) return false;
    bool any_above = false;
    bool any_below = false;
    for (const Vec3& vertex : order_) {
      ++n_tests_;
      const double height = plane.normal.dot(vertex) - plane.offset;
      any_above |= height > thickness_;
      any_below |= height < -thickness_;
      if (any_above && any_below) return false;
    }
    known_.push_back(plane);
    return true;
  }

  [[nodiscard]] bool is_in(std::span<const Vec3> corners, const HalfSpace& plane) const {
    return std::all_of(corners.begin(), corners.end(), [&](const Vec3& corner) {
      return std::abs(plane.normal.dot(corner) - plane.offset) <= thickness_;
    });
  }

  const PatchMesh& mesh_;
  double thickness_;
  std::vector<Vec3> order_;
  std::vector<HalfSpace> known_;
  std::vector<Held> of_polygon_;
  double n_tests_ = 0;
};

}  // namespace

VertexBlocks::VertexBlocks(const PatchMesh& mesh) : mesh_(mesh) {
  blocks_.resize((mesh.vertices.size() + kBlock - 1) / kBlock);
  for (std::size_t k = 0; k < mesh.vertices.size(); ++k) {
    blocks_[k / kBlock].extend(mesh.vertices[k]);
    box_.extend(mesh.vertices[k]);
  }
}

bool VertexBlocks::are_all_behind(const Vec3& normal, double limit) const {
  if (blocks_.empty() || is_behind(box_, normal, limit)) return true;
  for (std::size_t block = 0; block < blocks_.size(); ++block) {
    if (is_behind(blocks_[block], normal, limit)) continue;
    const auto begin = mesh_.vertices.begin() + static_cast<std::ptrdiff_t>(block * kBlock);
    const auto rest = static_cast<std::size_t>(mesh_.vertices.end() - begin);
    const auto end = begin + static_cast<std::ptrdiff_t>(std::min(kBlock, rest));
    if (!std::all_of(begin, end, [&](const Vec3& x) { return normal.dot(x) <= limit; })) {
      return false;
    }
  }
  return true;
}

std::vector<std::int32_t> find_blocking_patches(const PatchMesh& mesh, double thickness) {
  std::vector<std::int32_t> patches;
  OuterPlanes outer(mesh, thickness);
  for (std::int32_t i = 0; i < mesh.size(); ++i) {
    const bool is_back_of_earlier = mesh.twin[i] >= 0 && mesh.twin[i] < i;
    if (!is_back_of_earlier && !outer.holds(i)) patches.push_back(i);
  }
  return patches;
}

}  // namespace radiosity
