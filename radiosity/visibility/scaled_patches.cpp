#include "radiosity/visibility/scaled_patches.h"

#include <algorithm>
#include <cmath>

namespace radiosity {
namespace {

// Rays are traced in float. The scene is moved into [-1, 1]³ beforehand, so that these lengths
// are relative to half the scene's diagonal.

/// How close to its ends a segment is not blocked, at least: a few roundings of a float coordinate
/// near 1. More where the input is known to less: gaps below its precision are contact.
constexpr double kEndGap = 2e-6;
/// Patches whose corners are this close to the plane of a segment's end cannot block it; see above.
constexpr double kCoplanar = 1e-6;
/// How many times longer than wide a triangle is at least for Embree to place hits of it too badly:
/// in float its normal is off in proportion to that. Up to 100 none was placed wrongly, at 1000 one
/// ray in forty was stopped by the triangle that it started from.
constexpr double kNeedle = 64;

bool is_needle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double length2 =
      std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return kNeedle * (b - a).cross(c - a).norm() < length2;
}

}  // namespace

ScaledPatches::ScaledPatches(const PatchMesh& mesh) : twin_(mesh.twin) {
  const Box3 box = bounds(mesh);
  if (!box.isEmpty()) {
    center_ = box.center();
    const double radius = 0.5 * box.diagonal().norm();
    if (radius > 0) scale_ = 1 / radius;
  }
  planes_.reserve(mesh.size());
  patch_corners_.reserve(mesh.size());
  for (std::int32_t i = 0; i < mesh.size(); ++i) add_patch(mesh, i);
  const double thickness = plane_thickness(mesh) * scale_;
  end_gap_ = std::max(kEndGap, thickness);
  coplanar_ = std::max(kCoplanar, thickness);
}

void ScaledPatches::add_patch(const PatchMesh& mesh, std::int32_t i) {
  std::array<Vec3, 4> corners;
  for (int k = 0; k < 4; ++k) {
    corners[k] = scaled(mesh.corner(i, std::min(k, mesh.n_corners(i) - 1)));
  }
  patch_corners_.push_back(corners);
  planes_.push_back({mesh.normal[i], mesh.normal[i].dot(scaled(mesh.centroid[i]))});
}

std::array<RayTriangles, 2> ScaledPatches::triangles(const PatchMesh& mesh) const {
  std::array<RayTriangles, 2> result;
  for (std::int32_t i = 0; i < mesh.size(); ++i) {
    const bool is_back_of_earlier = twin_[i] >= 0 && twin_[i] < i;
    if (is_back_of_earlier) continue;
    const std::array<Vec3, 4>& corners = patch_corners_[i];
    for (int k = 2; k < mesh.n_corners(i); ++k) {
      const std::array triangle{corners[0], corners[k - 1], corners[k]};
      RayTriangles& some = result[is_needle(triangle[0], triangle[1], triangle[2]) ? 1 : 0];
      const auto first = static_cast<unsigned>(some.vertices.size());
      for (const Vec3& corner : triangle) {
        const Eigen::Vector3f p = corner.cast<float>();
        some.vertices.push_back({p.x(), p.y(), p.z()});
      }
      some.corners.push_back({first, first + 1, first + 2});
      some.patch.push_back(i);
    }
  }
  return result;
}

bool ScaledPatches::is_in_plane_of(std::int32_t patch, std::int32_t of) const {
  const HalfSpace& plane = planes_[of];
  return std::all_of(patch_corners_[patch].begin(), patch_corners_[patch].end(),
                     [&](const Vec3& corner) {
                       return std::abs(plane.normal.dot(corner) - plane.offset) < coplanar_;
                     });
}

bool ScaledPatches::ignores(std::int32_t patch, std::int32_t source, std::int32_t target) const {
  for (const std::int32_t end : {source, target}) {
    if (end < 0) continue;
    if (patch == end || patch == twin_[end] || is_in_plane_of(patch, end)) return true;
  }
  return false;
}

bool ScaledPatches::is_back(std::int32_t patch, const Vec3& direction) const {
  return twin_[patch] < 0 && direction.dot(planes_[patch].normal) >= 0;
}

}  // namespace radiosity
