#include "meshing/patches/contact_lines.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "radiosity/base/box_tree.h"
#include "radiosity/base/parallel.h"

namespace meshing {
namespace {

using radiosity::Box3;
using radiosity::BoxTree;
using radiosity::Index;
using radiosity::PatchMesh;
using radiosity::Vec3;

/// Patches that others pass through no further from an edge than this share of their size do not
/// count as crossed.
constexpr double kAlongEdge = 1e-5;

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

/// The part of a segment in the plane of patch i that lies within it or up to `margin` outside, if
/// it is longer than that.
std::optional<Segment> part_within(const PatchMesh& mesh, Index i, const Segment& segment,
                                   double margin) {
  const Vec3 step = segment[1] - segment[0];
  double from = 0;
  double to = 1;
  const int n = mesh.n_corners(i);
  for (int k = 0; k < n; ++k) {
    const Vec3 edge = mesh.corner(i, (k + 1) % n) - mesh.corner(i, k);
    const Vec3 inwards = mesh.normal[i].cross(edge).normalized();
    const double first = inwards.dot(segment[0] - mesh.corner(i, k)) + margin;
    const double last = inwards.dot(segment[1] - mesh.corner(i, k)) + margin;
    if (std::max(first, last) <= 0) return std::nullopt;
    if (first < 0) from = std::max(from, first / (first - last));
    if (last < 0) to = std::min(to, first / (first - last));
  }
  if ((to - from) * step.norm() <= 2 * margin) return std::nullopt;
  return Segment{segment[0] + from * step, segment[0] + to * step};
}

/// Calls visit(i, segment) for what others make of each patch i, from several threads but each i
/// from one.
template <typename Visit>
void for_each_contact(const PatchMesh& mesh, double thickness, const Visit& visit) {
  std::vector<Box3> boxes;
  boxes.reserve(mesh.size());
  for (Index i = 0; i < mesh.size(); ++i)
    boxes.push_back(radiosity::grown(patch_box(mesh, i), thickness));
  const BoxTree tree(boxes);
  constexpr Index kGrain = 64;
  radiosity::parallel_for(
      mesh.size(),
      [&](Index i) {
        tree.for_each_meeting(boxes[i], [&](std::int32_t other) {
          if (other == i || other == mesh.twin[i]) return;
          // One of two back to back is enough.
          if (mesh.twin[other] >= 0 && mesh.twin[other] < other) return;
          const auto segment = meeting(mesh, i, other, thickness);
          if (!segment) return;
          if (const auto part = part_within(mesh, i, *segment, thickness)) visit(i, *part);
        });
      },
      kGrain);
}

std::vector<std::vector<Segment>> lines_off_edges(const PatchMesh& mesh, double thickness,
                                                  double share_of_size) {
  std::vector<std::vector<Segment>> lines(mesh.size());
  for_each_contact(mesh, thickness, [&](Index i, const Segment& segment) {
    const auto corner = [&](int k) -> const Vec3& { return mesh.corner(i, k); };
    const double margin = std::max(4 * thickness, share_of_size * std::sqrt(mesh.area[i]));
    if (radiosity::is_along_edge(segment[0], segment[1], mesh.n_corners(i), corner, margin)) return;
    lines[i].push_back(segment);
  });
  return lines;
}

}  // namespace

std::vector<std::vector<Segment>> contact_lines(const PatchMesh& mesh) {
  return lines_off_edges(mesh, radiosity::plane_thickness(mesh), 0);
}

std::vector<std::vector<Segment>> polygon_contact_lines(const PatchMesh& as_is) {
  const double thickness = radiosity::plane_thickness(as_is);
  std::vector<std::vector<Segment>> of_patch(as_is.size());
  for_each_contact(as_is, thickness, [&](Index i, const Segment& segment) {
    const std::span<const Vec3> outline = as_is.outline(as_is.polygon[i]);
    const auto n = static_cast<int>(outline.size());
    const auto corner = [&](int k) -> const Vec3& { return outline[k]; };
    if (radiosity::is_along_edge(segment[0], segment[1], n, corner, 2 * thickness)) return;
    of_patch[i].push_back(segment);
  });
  std::vector<std::vector<Segment>> lines(as_is.n_polygons());
  for (Index i = 0; i < as_is.size(); ++i) {
    std::vector<Segment>& there = lines[as_is.polygon[i]];
    there.insert(there.end(), of_patch[i].begin(), of_patch[i].end());
  }
  return lines;
}

std::vector<Index> crossed_patches(const PatchMesh& mesh) {
  const std::vector<std::vector<Segment>> lines =
      lines_off_edges(mesh, radiosity::plane_thickness(mesh), kAlongEdge);
  std::vector<Index> crossed;
  for (Index i = 0; i < mesh.size(); ++i) {
    if (!lines[i].empty()) crossed.push_back(i);
  }
  return crossed;
}

}  // namespace meshing
