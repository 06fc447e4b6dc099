#include "radiosity/visibility/free_sides.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "radiosity/polygon/flat_difference.h"

namespace radiosity {
namespace {

/// Parts narrower than so many reaches are what rounding leaves between covers.
constexpr double kSliverReaches = 4;

/// The plane of a patch, with coordinates.
struct PlaneAxes {
  Vec3 origin;
  Vec3 u;
  Vec3 v;
  PlaneAxes(const PatchMesh& mesh, Index patch)
      : origin(mesh.centroid[patch]),
        u(mesh.normal[patch].unitOrthogonal()),
        v(mesh.normal[patch].cross(u)) {}
  [[nodiscard]] FlatPolygon outline(const PatchMesh& mesh, Index patch) const {
    FlatPolygon result;
    for (int k = 0; k < mesh.n_corners(patch); ++k) {
      const Vec3 off = mesh.corner(patch, k) - origin;
      result.emplace_back(u.dot(off), v.dot(off));
    }
    if (flat_area(result) < 0) std::reverse(result.begin(), result.end());
    return result;
  }
};

bool is_narrow(const FlatPolygon& polygon, double width) {
  double longest2 = 0;
  for (const Point2& a : polygon) {
    for (const Point2& b : polygon) longest2 = std::max(longest2, (b - a).squaredNorm());
  }
  return flat_area(polygon) <= width * std::sqrt(longest2);
}

std::vector<FreeSides::Outline> left_free(const PatchMesh& mesh, Index patch,
                                          std::span<const std::int32_t> covers, double reach) {
  const PlaneAxes axes(mesh, patch);
  std::vector<FlatPolygon> parts{axes.outline(mesh, patch)};
  for (const std::int32_t cover : covers) subtract(axes.outline(mesh, cover), reach, parts);
  std::vector<FreeSides::Outline> result;
  for (const FlatPolygon& part : parts) {
    if (is_narrow(part, kSliverReaches * reach)) continue;
    FreeSides::Outline& outline = result.emplace_back();
    for (const Point2& x : part) {
      outline.emplace_back(axes.origin + x.x() * axes.u + x.y() * axes.v);
    }
  }
  return result;
}

/// One side of a patch.
struct SideOfPatch {
  Index side;
  std::int32_t patch;
  bool is_back;  ///< which emits nothing
};

}  // namespace

FreeSides::FreeSides(const PatchSides& sides,
                     const std::vector<std::pair<std::int32_t, std::int32_t>>& overlaps,
                     double reach) {
  const PatchMesh& mesh = sides.mesh;
  const auto side_of = [&](std::int32_t patch, bool is_front) -> SideOfPatch {
    return {is_front ? sides.front(patch) : sides.back(patch), patch,
            !is_front && mesh.twin[patch] < 0};
  };
  for (const auto& [i, j] : overlaps) {
    const bool is_turned = mesh.normal[i].dot(mesh.normal[j]) < 0;
    for (const bool is_front : {true, false}) {
      SideOfPatch cover = side_of(i, is_front);
      SideOfPatch covered = side_of(j, is_front != is_turned);
      if (std::tie(covered.is_back, covered.side) < std::tie(cover.is_back, cover.side)) {
        std::swap(cover, covered);
      }
      Side& side = covered_[covered.side];
      side.patch = covered.patch;
      side.covers.push_back(cover.patch);
    }
  }
  for (auto& [number, side] : covered_) {
    side.parts = left_free(mesh, side.patch, side.covers, reach);
  }
}

const std::vector<FreeSides::Outline>* FreeSides::parts(Index side) const {
  const auto found = covered_.find(side);
  return found == covered_.end() ? nullptr : &found->second.parts;
}

std::span<const std::int32_t> FreeSides::covers(Index side) const {
  const auto found = covered_.find(side);
  return found == covered_.end() ? std::span<const std::int32_t>() : found->second.covers;
}

}  // namespace radiosity
