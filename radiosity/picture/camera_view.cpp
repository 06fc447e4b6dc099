#include "radiosity/picture/camera_view.h"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "radiosity/polygon/convex_polygon.h"

namespace radiosity {
namespace {

/// Inward normals of the four planes through the camera that bound its picture.
std::array<Vec3, 4> pyramid_normals(const Camera& camera, double aspect) {
  const Vec3 forward = camera.direction.normalized();
  const Vec3 right = forward.cross(camera.up).normalized();
  const Vec3 up = right.cross(forward);
  const double slope = std::tan(camera.vertical_fov / 2);
  return {(aspect * slope * forward + right).normalized(),
          (aspect * slope * forward - right).normalized(), (slope * forward + up).normalized(),
          (slope * forward - up).normalized()};
}

}  // namespace

ViewContent view_content(const PatchMesh& mesh, const Camera& camera, double aspect) {
  const std::array<Vec3, 4> normals = pyramid_normals(camera, aspect);
  const double thickness = plane_thickness(mesh);
  ViewContent content;
  for (Index i = 0; i < mesh.size() && !(content.fronts && content.backs); ++i) {
    ConvexPolygon part;
    for (int k = 0; k < mesh.n_corners(i); ++k) part.push_back(mesh.corner(i, k));
    for (const Vec3& normal : normals) {
      if (!part.empty()) {
        part = clip_to_half_space(part.points(), camera.position, normal, thickness);
      }
    }
    if (part.empty()) continue;
    const double height = mesh.normal[i].dot(camera.position - mesh.centroid[i]);
    content.fronts |= height > thickness;
    content.backs |= height < -thickness;
  }
  return content;
}

Surroundings surroundings(const Visibility& visibility, const Vec3& point) {
  constexpr int kDirections = 1024;
  const double golden_angle = kPi * (3 - std::sqrt(5.0));
  Surroundings result;
  double nearest = std::numeric_limits<double>::infinity();
  int n_backs = 0;
  for (int k = 0; k < kDirections; ++k) {  // Fibonacci's spiral
    const double z = 1 - (2 * k + 1.0) / kDirections;
    const double radius = std::sqrt(1 - z * z);
    const Vec3 direction(radius * std::cos(k * golden_angle), radius * std::sin(k * golden_angle),
                         z);
    const auto hit = visibility.first_hit(point, direction);
    if (!hit || hit->front) continue;
    ++n_backs;
    if (hit->distance < nearest) {
      nearest = hit->distance;
      result.nearest = hit->patch;
    }
  }
  result.backs = static_cast<double>(n_backs) / kDirections;
  return result;
}

}  // namespace radiosity
