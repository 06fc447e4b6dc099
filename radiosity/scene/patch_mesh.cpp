#include "radiosity/scene/patch_mesh.h"

#include <algorithm>
#include <cmath>

namespace radiosity {
namespace {

Vec3 triangle_cross(const Vec3& a, const Vec3& b, const Vec3& c) { return (b - a).cross(c - a); }

}  // namespace

void PatchMesh::reserve(Index n_patches) {
  corners.reserve(n_patches);
  for (auto* numbers : {&surface, &polygon, &twin, &family}) numbers->reserve(n_patches);
  area.reserve(n_patches);
  normal.reserve(n_patches);
  centroid.reserve(n_patches);
}

void PatchMesh::add_patch(const std::array<std::int32_t, 4>& patch_corners,
                          std::int32_t patch_surface, std::int32_t patch_polygon,
                          std::int32_t patch_twin) {
  const bool is_quad = patch_corners[3] >= 0;
  const Vec3& a = vertices[patch_corners[0]];
  const Vec3& b = vertices[patch_corners[1]];
  const Vec3& c = vertices[patch_corners[2]];
  const Vec3 first = triangle_cross(a, b, c);
  const Vec3 second =
      is_quad ? triangle_cross(a, c, vertices[patch_corners[3]]) : Vec3(Vec3::Zero());
  const Vec3 twice_area = first + second;
  const double length = twice_area.norm();

  Vec3 center = (a + b + c) / 3;
  const double sum = first.norm() + second.norm();
  if (is_quad && sum > 0) {
    const Vec3 second_center = (a + c + vertices[patch_corners[3]]) / 3;
    center += second.norm() / sum * (second_center - center);
  }
  corners.push_back(patch_corners);
  surface.push_back(patch_surface);
  polygon.push_back(patch_polygon);
  twin.push_back(patch_twin);
  family.push_back(-1);
  area.push_back(length / 2);
  normal.push_back(length > 0 ? Vec3(twice_area / length) : Vec3(Vec3::Zero()));
  centroid.push_back(center);
}

void add_patches(Fingerprint& fingerprint, const PatchMesh& mesh) {
  fingerprint.add(mesh.vertices);
  fingerprint.add(mesh.corners);
  fingerprint.add(mesh.surface);
  fingerprint.add(mesh.polygon);
  fingerprint.add(mesh.twin);
  for (const std::string& name : mesh.surface_names) fingerprint.add(name);
  for (const bool two_sided : mesh.surface_two_sided) fingerprint.add(two_sided);
  fingerprint.add(mesh.precision);
  for (const Motion& image : mesh.images) {
    fingerprint.add(image.linear);
    fingerprint.add(image.shift);
  }
}

double corner_angle(const PatchMesh& mesh, Index patch, int k) {
  const int n = mesh.n_corners(patch);
  const Vec3& x = mesh.corner(patch, k);
  const Vec3 before = mesh.corner(patch, (k + n - 1) % n) - x;
  const Vec3 after = mesh.corner(patch, (k + 1) % n) - x;
  return std::atan2(before.cross(after).norm(), before.dot(after));
}

Box3 patch_box(const PatchMesh& mesh, Index i) {
  Box3 box;
  for (int k = 0; k < mesh.n_corners(i); ++k) box.extend(mesh.corner(i, k));
  return box;
}

Box3 bounds(const PatchMesh& mesh) {
  Box3 box;
  for (Index i = 0; i < mesh.size(); ++i) box.extend(patch_box(mesh, i));
  return box;
}

PatchMesh centered(const PatchMesh& mesh) {
  PatchMesh result = mesh;
  const Box3 box = bounds(mesh);
  if (box.isEmpty()) return result;
  for (Vec3& vertex : result.vertices) vertex -= box.center();
  for (Vec3& centroid : result.centroid) centroid -= box.center();
  for (Vec3& corner : result.polygon_corners) corner -= box.center();
  for (Motion& image : result.images) image.shift = image(box.center()) - box.center();
  return result;
}

double plane_thickness(const Box3& box) {
  constexpr double kShareOfSize = 1e-11;
  constexpr double kRounding = 4e-16;
  if (box.isEmpty()) return 0;
  const double furthest = box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff();
  return kShareOfSize * box.diagonal().norm() + kRounding * furthest;
}

double plane_thickness(const Box3& box, double precision) {
  constexpr double kPrecisions = 4;
  return std::max(plane_thickness(box), kPrecisions * precision);
}

double plane_thickness(const PatchMesh& mesh) {
  return plane_thickness(bounds(mesh), mesh.precision);
}

}  // namespace radiosity
