#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "io/picture/rgb_picture.h"
#include "radiosity/base/geometry.h"
#include "radiosity/scene/patch_mesh.h"

namespace viewer {

/// The surfaces of a mesh in few triangles, to be drawn while the camera moves. Vertices are taken
/// together where they lie in one cell of a grid and touch the same faces (polygons or, of many
/// small ones, parts of a surface that face alike), and stand at one of their places. (Rossignac &
/// Borrel 1993) So faces keep their edges and corners, and meet without gaps where the patches do.
class CoarseMesh {
 public:
  /// Of cells such that about `n_wanted` of them cover the surfaces.
  CoarseMesh(const radiosity::PatchMesh& mesh, radiosity::Index n_wanted);

  /// m. Each face has points of its own, so that colours may jump from one to the next.
  [[nodiscard]] const std::vector<radiosity::Vec3>& positions() const { return positions_; }
  [[nodiscard]] const std::vector<std::array<std::int32_t, 3>>& triangles() const {
    return triangles_;
  }
  /// Per triangle: whether its back is shown, as no patch lies there; 0 or 1.
  [[nodiscard]] const std::vector<std::uint8_t>& has_back() const { return has_back_; }

  /// Per triangle.
  [[nodiscard]] const std::vector<std::int32_t>& surfaces() const { return surfaces_; }

  /// The points' colours from those at the patches' corners (slot 4 i + k is corner k of patch i):
  /// the means of the corners that a point stands for.
  [[nodiscard]] std::vector<io::Rgb> colors(std::span<const io::Rgb> corners) const;
  /// The same of numbers, of which negative ones are none.
  [[nodiscard]] std::vector<float> values(std::span<const float> corners) const;

 private:
  void add_triangles(const radiosity::PatchMesh& mesh);

  std::vector<radiosity::Vec3> positions_;
  std::vector<std::array<std::int32_t, 3>> triangles_;
  std::vector<std::uint8_t> has_back_;
  std::vector<std::int32_t> surfaces_;
  std::vector<std::int32_t> point_of_;  // per slot, or -1
};

}  // namespace viewer
