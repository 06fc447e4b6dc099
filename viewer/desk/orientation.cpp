#include "viewer/desk/orientation.h"

#include <cmath>

#include "radiosity/picture/render.h"

namespace viewer {

using radiosity::Vec3;

namespace {

constexpr double kClearly =
    1.1;  // times as much area: more than boxes that are nearly cubes differ

}  // namespace

std::string up_name(UpAxis axis) { return axis == UpAxis::z ? "z" : "y"; }

std::optional<UpAxis> up_named(const std::string& name) {
  if (name == "y") return UpAxis::y;
  if (name == "z") return UpAxis::z;
  return std::nullopt;
}

Vec3 up_direction(UpAxis axis) { return axis == UpAxis::z ? Vec3::UnitZ() : Vec3::UnitY(); }

UpAxis guessed_up(const radiosity::PatchMesh& mesh,
                  const std::optional<radiosity::Camera>& camera) {
  if (camera) return std::abs(camera->up.z()) > std::abs(camera->up.y()) ? UpAxis::z : UpAxis::y;
  Vec3 across = Vec3::Zero();
  for (radiosity::Index i = 0; i < mesh.size(); ++i) {
    across += mesh.area[i] * mesh.normal[i].cwiseAbs();
  }
  return across.z() > kClearly * across.y() ? UpAxis::z : UpAxis::y;
}

radiosity::Camera outside_camera(const radiosity::PatchMesh& mesh, UpAxis up) {
  radiosity::Camera camera;
  const Vec3 direction = Vec3(-0.5, -0.45, -1).normalized();  // where y is up
  camera.direction =
      up == UpAxis::z ? Vec3(direction.x(), -direction.z(), direction.y()) : direction;
  camera.up = up_direction(up);
  return radiosity::fit_camera(mesh, camera);
}

}  // namespace viewer
