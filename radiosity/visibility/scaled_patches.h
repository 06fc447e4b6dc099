#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/half_space.h"

namespace radiosity {

/// Triangles in single precision, as rays meet them.
struct RayTriangles {
  std::vector<std::array<float, 3>> vertices;
  std::vector<std::array<unsigned, 3>> corners;
  std::vector<std::int32_t> patch;  ///< that each is a part of
};

/// The patches moved and scaled into [-1, 1]³, where single precision has the same digits for any
/// scene, and which of them count where a ray arrives. Lengths are scaled, too.
class ScaledPatches {
 public:
  explicit ScaledPatches(const PatchMesh& mesh);

  /// The patches, one of each pair of twins, as triangles, and apart from them the needles: those
  /// so slim that in single precision hits of them are misplaced.
  [[nodiscard]] std::array<RayTriangles, 2> triangles(const PatchMesh& mesh) const;

  [[nodiscard]] Vec3 scaled(const Vec3& point) const { return (point - center_) * scale_; }
  [[nodiscard]] const Vec3& center() const { return center_; }  ///< of the mesh's box, m
  [[nodiscard]] double scale() const { return scale_; }         ///< 1/m
  [[nodiscard]] const HalfSpace& plane(std::int32_t patch) const { return planes_[patch]; }
  [[nodiscard]] std::int32_t twin(std::int32_t patch) const { return twin_[patch]; }
  /// How close to its ends a segment is not blocked.
  [[nodiscard]] double end_gap() const { return end_gap_; }
  /// How close to a plane the corners of a patch in it are.
  [[nodiscard]] double coplanar() const { return coplanar_; }

  [[nodiscard]] bool is_in_plane_of(std::int32_t patch, std::int32_t of) const;
  /// Whether a patch does not block a segment between two others (-1: none): it is one of them, the
  /// back of one or in the plane of one.
  [[nodiscard]] bool ignores(std::int32_t patch, std::int32_t source, std::int32_t target) const;
  /// Whether a ray in that direction meets the back of a patch that has no other side.
  [[nodiscard]] bool is_back(std::int32_t patch, const Vec3& direction) const;

 private:
  void add_patch(const PatchMesh& mesh, std::int32_t i);

  Vec3 center_ = Vec3::Zero();
  double scale_ = 1;
  double end_gap_;
  double coplanar_;
  std::vector<std::int32_t> twin_;
  std::vector<HalfSpace> planes_;
  std::vector<std::array<Vec3, 4>> patch_corners_;  // a triangle's last is twice
};

}  // namespace radiosity
