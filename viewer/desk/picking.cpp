#include "viewer/desk/picking.h"

#include <cmath>

#include "radiosity/scene/patch_mesh.h"
#include "viewer/desk/camera_control.h"

namespace viewer {
namespace {

using radiosity::Vec3;

constexpr double kCornerReach = 8;  // pixels

/// Through a place of the picture, unit length.
Vec3 ray_at(const Desk& desk, double x, double y) {
  const double aspect = static_cast<double>(desk.region.width) / desk.region.height;
  return ray_direction(picture_camera(desk), x, y, aspect);
}

}  // namespace

std::optional<Vec3> point_at(const Desk& desk, double x, double y) {
  const auto hit = hit_at(desk, x, y);
  if (!hit) return std::nullopt;
  const radiosity::Camera camera = picture_camera(desk);
  const Vec3 point = camera.position + hit->distance * ray_at(desk, x, y);
  const double depth = (point - camera.position).dot(camera.direction);
  const double pixel = 2 * depth * std::tan(camera.vertical_fov / 2) / desk.region.height;
  const radiosity::PatchMesh& mesh = *desk.session.model().mesh;
  Vec3 nearest = point;
  double least = kCornerReach * pixel;
  for (int k = 0; k < mesh.n_corners(hit->patch); ++k) {
    const Vec3& corner = mesh.corner(hit->patch, k);
    const double distance = (corner - point).norm();
    if (distance >= least) continue;
    least = distance;
    nearest = corner;
  }
  return nearest;
}

Vec3 point_towards(const Desk& desk, double x, double y) {
  if (desk.region.height <= 0) return desk.camera.pivot();
  const radiosity::Camera& camera = desk.camera.camera();
  const Vec3 ray = ray_at(desk, x, y);
  if (const auto hit = hit_at(desk, x, y)) return camera.position + hit->distance * ray;
  const double depth = (desk.camera.pivot() - camera.position).dot(camera.direction);
  return camera.position + depth / ray.dot(camera.direction) * ray;
}

}  // namespace viewer
