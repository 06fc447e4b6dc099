#include "radiosity/visibility/point_shadows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace radiosity {
namespace {

/// The way from a light is searched in at most so many slices, or in fewer that are about as long
/// as they are wide: boxes around slices hold less than one around the whole.
constexpr int kMostSlices = 16;

std::vector<Occluder> blocking_polygons(const PatchMesh& mesh, double thickness) {
  std::vector<std::int32_t> patches;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(mesh.size()); ++i) {
    if (mesh.twin[i] < 0 || i < mesh.twin[i]) patches.push_back(i);
  }
  return make_occluders(centered(mesh), patches, thickness);
}

std::vector<Box3> boxes_of(const std::vector<Occluder>& occluders, double margin) {
  std::vector<Box3> boxes;
  boxes.reserve(occluders.size());
  for (const Occluder& occluder : occluders) boxes.push_back(grown(occluder.box, margin));
  return boxes;
}

double height_over(const Occluder& occluder, const Vec3& x) {
  return occluder.normal.dot(x) - occluder.offset;
}

/// Whether a point in the plane of an occluder is in it or on its border.
bool is_within(const Occluder& occluder, const Vec3& x, double thickness) {
  for (std::size_t k = 0; k < occluder.corners.size(); ++k) {
    const Vec3& a = occluder.corners[k];
    const Vec3 edge = occluder.corners[k + 1 < occluder.corners.size() ? k + 1 : 0] - a;
    if (occluder.normal.dot(edge.cross(x - a)) < -thickness * edge.norm()) return false;
  }
  return true;
}

/// An axis whose cosine to a plane's normal is less than that lies in the plane, but for rounding.
constexpr double kLevelAxis = 1e-9;

/// The side of an occluder that the light is on: 1 in front, -1 behind, 0 beside it in its plane.
/// Mounted on it with an axis within its plane, as a light that hangs down a wall, it is in front.
int side_of_light(const Occluder& occluder, const PointLight& light, double thickness) {
  const double height = height_over(occluder, light.position);
  if (std::abs(height) > thickness) return height > 0 ? 1 : -1;
  if (!is_within(occluder, light.position, thickness)) return 0;
  return occluder.normal.dot(light.axis) >= -kLevelAxis ? 1 : -1;
}

/// What an occluder hides from the light.
Shadow shadow_from(const Occluder& occluder, const PointLight& light, double thickness) {
  const int side = side_of_light(occluder, light, thickness);
  if (side == 0) return {};
  if (std::abs(height_over(occluder, light.position)) > thickness) {
    return shadow_of(occluder, light.position, thickness);
  }
  Shadow shadow;
  shadow.faces.push_back({side * occluder.normal, side * occluder.offset});
  return shadow;
}

/// What an occluder hides of polygons from a point, relative to that; nothing if they do not lie
/// behind it, nor on it and face the other way.
Shadow shadow_on(const Occluder& occluder, const Vec3& point,
                 std::span<const ConvexPolygon> polygons, const Vec3& axis, double thickness) {
  const double height = height_over(occluder, point);
  if (std::abs(height) <= thickness) return {};
  const double side = height > 0 ? 1 : -1;
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -lowest;
  for (const ConvexPolygon& polygon : polygons) {
    for (const Vec3& corner : polygon) {
      const double there = side * (height + occluder.normal.dot(corner));
      lowest = std::min(lowest, there);
      highest = std::max(highest, there);
    }
  }
  const bool is_mounted = lowest >= -thickness && highest <= thickness;
  const bool faces_away = side * occluder.normal.dot(axis) < -kLevelAxis;
  if (is_mounted ? !faces_away : lowest >= -thickness) return {};
  Shadow shadow = shadow_of(occluder, point, thickness);
  for (Shadow::Edge& edge : shadow.edges) {
    edge.start -= point;
    edge.end -= point;
  }
  for (HalfSpace& face : shadow.faces) face.offset -= face.normal.dot(point);
  if (is_mounted) shadow.faces.clear();
  return shadow;
}

}  // namespace

PointShadows::PointShadows(const PatchMesh& mesh)
    : mesh_(mesh),
      center_(mesh.size() > 0 ? Vec3(bounds(mesh).center()) : Vec3(0, 0, 0)),
      thickness_(plane_thickness(mesh)),
      occluders_(blocking_polygons(mesh, thickness_)),
      tree_(boxes_of(occluders_, thickness_)) {}

template <typename Visit>
void PointShadows::for_each_between(const Vec3& light, std::span<const Vec3> ends,
                                    const Visit& visit) const {
  Box3 there;
  for (const Vec3& end : ends) there.extend(end);
  const double distance = (there.center() - light).norm();
  const double width = std::max(there.diagonal().norm(), distance / kMostSlices);
  const int n = std::clamp(static_cast<int>(std::ceil(distance / width)), 1, kMostSlices);
  for (int slice = 0; slice < n; ++slice) {
    Box3 box;
    for (const int border : {slice, slice + 1}) {
      const double share = static_cast<double>(border) / n;
      for (const Vec3& end : ends) box.extend(Vec3(light + share * (end - light)));
    }
    tree_.for_each_meeting(grown(box, thickness_), visit);
  }
}

std::span<const ConvexPolygon> PointShadows::lit_parts(const PointLight& light, Index patch,
                                                       ShadowCutter& cutter) const {
  const PointLight here{light.position - center_, light.axis};
  const Vec3& normal = mesh_.normal[patch];
  if (!(normal.dot(light.position - mesh_.centroid[patch]) > thickness_)) return {};
  ConvexPolygon target;
  ConvexPolygon relative;
  for (int k = 0; k < mesh_.n_corners(patch); ++k) {
    target.push_back(mesh_.corner(patch, k) - center_);
    relative.push_back(mesh_.corner(patch, k) - light.position);
  }
  std::vector<std::int32_t> candidates;
  for_each_between(here.position, target.points(), [&](std::int32_t k) {
    const int side = side_of_light(occluders_[k], here, thickness_);
    if (side == 0) return;
    const bool is_behind = std::any_of(target.begin(), target.end(), [&](const Vec3& corner) {
      return side * height_over(occluders_[k], corner) < -thickness_;
    });
    if (is_behind) candidates.push_back(k);
  });
  std::sort(candidates.begin(), candidates.end());
  candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
  std::vector<Shadow> shadows;
  for (const std::int32_t k : candidates) {
    Shadow shadow = shadow_from(occluders_[k], here, thickness_);
    // Relative to the light.
    for (Shadow::Edge& edge : shadow.edges) {
      edge.start -= here.position;
      edge.end -= here.position;
    }
    for (HalfSpace& face : shadow.faces) face.offset -= face.normal.dot(here.position);
    shadows.push_back(std::move(shadow));
  }
  return cutter.visible_parts(Vec3::Zero(), relative, shadows);
}

std::vector<ConvexPolygon> PointShadows::seen_parts(const Vec3& point,
                                                    std::span<const ConvexPolygon> polygons,
                                                    const Vec3& axis, ShadowCutter& cutter) const {
  const Vec3 x = point - center_;
  std::vector<Vec3> ends;
  for (const ConvexPolygon& polygon : polygons) {
    for (const Vec3& corner : polygon) ends.push_back(x + corner);
  }
  std::vector<std::int32_t> candidates;
  for_each_between(x, ends, [&](std::int32_t k) { candidates.push_back(k); });
  std::sort(candidates.begin(), candidates.end());
  candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
  std::vector<Shadow> shadows;
  for (const std::int32_t k : candidates) {
    Shadow shadow = shadow_on(occluders_[k], x, polygons, axis, thickness_);
    if (!shadow.edges.empty()) shadows.push_back(std::move(shadow));
  }
  std::vector<ConvexPolygon> parts;
  for (const ConvexPolygon& polygon : polygons) {
    const auto seen = cutter.visible_parts(Vec3::Zero(), polygon, shadows);
    parts.insert(parts.end(), seen.begin(), seen.end());
  }
  return parts;
}

bool PointShadows::is_lit(const PointLight& light, const Vec3& point) const {
  const PointLight here{light.position - center_, light.axis};
  const Vec3 x = point - center_;
  bool is_lit = true;
  for_each_between(here.position, std::array{x}, [&](std::int32_t k) {
    if (!is_lit) return;
    const Occluder& occluder = occluders_[k];
    const int side = side_of_light(occluder, here, thickness_);
    if (side == 0 || side * height_over(occluder, x) >= -thickness_) return;
    const Shadow shadow = shadow_from(occluder, here, thickness_);
    is_lit = std::any_of(shadow.edges.begin(), shadow.edges.end(), [&](const Shadow::Edge& edge) {
      const Vec3 inwards = (edge.end - here.position).cross(edge.start - here.position);
      return inwards.dot(x - here.position) < 0;
    });
  });
  return is_lit;
}

}  // namespace radiosity
