#include "viewer/draw/projection.h"

#include <cmath>

namespace viewer {
namespace {

using radiosity::Vec3;

constexpr double kNear = 1e-3;  // of the scene's size, before the camera

}  // namespace

std::optional<ImVec2> project(const Desk& desk, const Vec3& point) {
  const radiosity::Camera camera = picture_camera(desk);
  const Vec3 offset = point - camera.position;
  const double depth = offset.dot(camera.direction);
  if (!(depth > 0)) return std::nullopt;
  const Vec3 right = camera.direction.cross(camera.up).normalized();
  const Vec3 up = right.cross(camera.direction);
  const double unit = 0.5 * desk.region.height / (depth * std::tan(camera.vertical_fov / 2));
  return ImVec2(
      static_cast<float>(desk.region.left + 0.5 * desk.region.width + unit * offset.dot(right)),
      static_cast<float>(desk.region.top + 0.5 * desk.region.height - unit * offset.dot(up)));
}

std::optional<std::pair<ImVec2, ImVec2>> project_piece(const Desk& desk, Vec3 from, Vec3 to) {
  const radiosity::Camera& camera = desk.camera.camera();
  const double near = kNear * desk.session.model().bounds.diagonal().norm();
  const double from_depth = (from - camera.position).dot(camera.direction) - near;
  const double to_depth = (to - camera.position).dot(camera.direction) - near;
  if (from_depth <= 0 && to_depth <= 0) return std::nullopt;
  const Vec3 cut = from + (to - from) * (from_depth / (from_depth - to_depth));
  if (from_depth <= 0) from = cut;
  if (to_depth <= 0) to = cut;
  const auto first = project(desk, from);
  const auto second = project(desk, to);
  if (!first || !second) return std::nullopt;
  return std::pair(*first, *second);
}

}  // namespace viewer
