#include "meshing/contact_lines.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "meshing/box_tree.h"
#include "radiosity/parallel.h"

namespace meshing {
namespace {

using radiosity::Box3;
using radiosity::Index;
using radiosity::PatchMesh;
using radiosity::Vec3;

/// How far off a plane a corner may be and count as in it, relative to the scene: files round.
constexpr double kThickness = 1e-6;
/// Segments closer to an edge of the patch than this share of its size count as along it.
constexpr double kAlongEdge = 1e-3;

Box3 patch_box(const PatchMesh& mesh, Index i, double margin) {
  Box3 box;
  for (int k = 0; k < mesh.n_corners(i); ++k) box.extend(mesh.corner(i, k));
  box.min().array() -= margin;
  box.max().array() += margin;
  return box;
}

/// The segment in which patch `other` meets the plane of patch `i`, if it reaches in front of it.
std::optional<Segment> meeting(const PatchMesh& mesh, Index i, Index other, double thickness) {
  const Vec3& normal = mesh.normal[i];
  const Vec3 along = normal.cross(mesh.normal[other]);
  constexpr double kParallel = 1e-6;
  if (along.norm() < kParallel) return std::nullopt;

  const int n = mesh.n_corners(other);
  std::array<double, 4> height{};
  for (int k = 0; k < n; ++k) height[k] = normal.dot(mesh.corner(other, k) - mesh.centroid[i]);
  if (*std::max_element(height.begin(), height.begin() + n) <= thickness) return std::nullopt;

  std::optional<Segment> segment;
  const auto add = [&](const Vec3& point) {
    if (!segment) segment = {point, point};
    if (along.dot(point - (*segment)[0]) < 0) (*segment)[0] = point;
    if (along.dot(point - (*segment)[1]) > 0) (*segment)[1] = point;
  };
  for (int k = 0; k < n; ++k) {
    const int next = (k + 1) % n;
    const Vec3& a = mesh.corner(other, k);
    if (std::abs(height[k]) <= thickness) {
      add(a - height[k] * normal);
    } else if (std::abs(height[next]) > thickness && height[k] * height[next] < 0) {
      add(a + height[k] / (height[k] - height[next]) * (mesh.corner(other, next) - a));
    }
  }
  return segment;
}

/// The part of a segment in the plane of patch i that lies inside it, away from its edges.
std::optional<Segment> part_inside(const PatchMesh& mesh, Index i, const Segment& segment) {
  const Vec3 step = segment[1] - segment[0];
  const double size = std::sqrt(mesh.area[i]);
  double from = 0;
  double to = 1;
  const int n = mesh.n_corners(i);
  for (int k = 0; k < n; ++k) {
    const Vec3 edge = mesh.corner(i, (k + 1) % n) - mesh.corner(i, k);
    const Vec3 inwards = mesh.normal[i].cross(edge).normalized();
    const double first = inwards.dot(segment[0] - mesh.corner(i, k));
    const double last = inwards.dot(segment[1] - mesh.corner(i, k));
    if (std::max(first, last) <= kAlongEdge * size) return std::nullopt;
    if (first < 0) from = std::max(from, first / (first - last));
    if (last < 0) to = std::min(to, first / (first - last));
  }
  if ((to - from) * step.norm() <= kAlongEdge * size) return std::nullopt;
  return Segment{segment[0] + from * step, segment[0] + to * step};
}

}  // namespace

std::vector<std::vector<Segment>> contact_lines(const PatchMesh& mesh) {
  const double thickness = kThickness * radiosity::bounds(mesh).diagonal().norm();
  std::vector<Box3> boxes;
  for (Index i = 0; i < mesh.size(); ++i) boxes.push_back(patch_box(mesh, i, thickness));
  const BoxTree tree(boxes);
  std::vector<std::vector<Segment>> lines(mesh.size());
  constexpr Index kGrain = 64;
  radiosity::parallel_for(
      mesh.size(),
      [&](Index i) {
        tree.for_each_meeting(boxes[i], [&](std::int32_t other) {
          if (other == i || other == mesh.twin[i]) return;
          const auto segment = meeting(mesh, i, other, thickness);
          if (!segment) return;
          if (const auto inside = part_inside(mesh, i, *segment)) lines[i].push_back(*inside);
        });
      },
      kGrain);
  return lines;
}

}  // namespace meshing
