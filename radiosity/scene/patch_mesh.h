#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "radiosity/base/fingerprint.h"
#include "radiosity/base/geometry.h"
#include "radiosity/scene/symmetry.h"

namespace radiosity {

/// The patches of a scene: triangles and planar convex quads, counter-clockwise seen from the side
/// that emits and reflects. The back of a patch blocks light and does nothing else. A polygon of a
/// two-sided surface has two patches, back to back, that name each other as `twin`.
struct PatchMesh {
  std::vector<Vec3> vertices;                        ///< m
  std::vector<std::array<std::int32_t, 4>> corners;  ///< per patch; [3] = -1 for a triangle
  std::vector<std::int32_t> surface;                 ///< per patch: index into surface_names
  std::vector<std::int32_t> polygon;                 ///< per patch: input polygon, file order
  std::vector<std::int32_t> twin;                    ///< per patch: its back, or -1
  std::vector<std::int32_t> family;                  ///< per patch: patches of one number are the
                                                     ///< parts of a larger patch; -1 = of none
  std::vector<double> area;                          ///< per patch, m², > 0
  std::vector<Vec3> normal;                          ///< per patch, unit, emitting side
  std::vector<Vec3> centroid;                        ///< per patch, m
  std::vector<std::string> surface_names;
  std::vector<bool> surface_two_sided;  ///< per surface
  /// How far a coordinate may be off what was meant (Scene::precision), m.
  double precision = 0;
  /// The corners of the input polygons, one polygon after the other, m: `polygon` is their number.
  /// Empty in meshes that are not made of a scene.
  std::vector<Vec3> polygon_corners;
  std::vector<std::int64_t> first_polygon_corner;  ///< n + 1 offsets into polygon_corners, or none
  /// What moves the patches to their images, if they are a part of a symmetric whole: these are
  /// there, too, and have the same light (`image_motions`, whole_mesh.h).
  std::vector<Motion> images;

  [[nodiscard]] Index size() const { return static_cast<Index>(corners.size()); }
  [[nodiscard]] int n_corners(Index patch) const { return corners[patch][3] < 0 ? 3 : 4; }
  [[nodiscard]] const Vec3& corner(Index patch, int k) const { return vertices[corners[patch][k]]; }

  /// Number of input polygons that are known, 0 in meshes that are not made of a scene.
  [[nodiscard]] Index n_polygons() const {
    return first_polygon_corner.empty() ? 0 : static_cast<Index>(first_polygon_corner.size()) - 1;
  }
  /// Corners of input polygon i < n_polygons(), in the order that its patches have.
  [[nodiscard]] std::span<const Vec3> outline(Index i) const {
    return std::span(polygon_corners)
        .subspan(first_polygon_corner[i], first_polygon_corner[i + 1] - first_polygon_corner[i]);
  }

  /// Makes room for so many patches.
  void reserve(Index n_patches);

  /// Appends a patch and computes its area, normal and centroid from its corners (corners[3] = -1
  /// for a triangle). Vertices must be there already. A degenerate patch gets area 0 and normal 0.
  void add_patch(const std::array<std::int32_t, 4>& patch_corners, std::int32_t patch_surface,
                 std::int32_t patch_polygon, std::int32_t patch_twin = -1);
};

/// Adds all that form factors depend on.
void add_patches(Fingerprint& fingerprint, const PatchMesh& mesh);

/// Inner angle of a patch at its k-th corner, radian.
double corner_angle(const PatchMesh& mesh, Index patch, int k);

/// The box around patch i.
Box3 patch_box(const PatchMesh& mesh, Index i);

/// The box around all patches. Empty if there are none.
Box3 bounds(const PatchMesh& mesh);

/// The same patches moved so that the centre of their box is the origin, which keeps digits when
/// the scene lies far from it.
PatchMesh centered(const PatchMesh& mesh);

/// How far from a plane a point may be and still count as on it, in a scene within `box`, m: a
/// share of its size, and the rounding of coordinates far from the origin. 0 if it is empty.
double plane_thickness(const Box3& box);

/// The larger of that and of how far a point of one polygon may be off the plane of another that
/// was meant to hold it: coordinates are off by up to p = `precision`, points by up to √3 p, and so
/// is the plane within the polygon that it is taken from: 2√3 p in all. 4 p leaves a little for
/// places beyond it.
double plane_thickness(const Box3& box, double precision);

/// The same for the planes of these patches.
double plane_thickness(const PatchMesh& mesh);

}  // namespace radiosity
