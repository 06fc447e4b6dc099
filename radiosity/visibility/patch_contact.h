#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/patch_mesh.h"

namespace radiosity {

/// How patches touch that are no further apart than `reach`, m. Refers to the mesh.
class PatchContact {
 public:
  /// Sine of the angle of planes that count as parallel, but for what their sizes and the thickness
  /// make of it.
  static constexpr double kParallel = 1e-6;

  PatchContact(const PatchMesh& mesh, double reach) : mesh_(mesh), reach_(reach) {}

  /// The directions off the edges of a patch.
  using Inwards = std::array<Vec3, 4>;

  /// Whether two patches touch elsewhere than edge to edge: they pass through each other, one
  /// stands on the other off its edges, or they lie on each other.
  [[nodiscard]] bool cross_or_cover(std::int32_t i, std::int32_t j) const {
    return cross_or_cover(i, j, all_inwards(i));
  }
  /// The same, given what all_inwards(i) returns.
  [[nodiscard]] bool cross_or_cover(std::int32_t i, std::int32_t j, const Inwards& inwards_i) const;

  /// Corner k of a patch; the first one again for k = n_corners.
  [[nodiscard]] const Vec3& corner(std::int32_t patch, int k) const;
  /// The direction in a patch's plane off one of its edges, inwards; unit.
  [[nodiscard]] Vec3 inwards(std::int32_t patch, int edge) const;
  /// The same of all edges of a patch.
  [[nodiscard]] Inwards all_inwards(std::int32_t patch) const;

 private:
  [[nodiscard]] double parallel_sine(std::int32_t i, std::int32_t j) const;
  [[nodiscard]] bool overlap(std::int32_t i, std::int32_t j, const Inwards& inwards_i) const;
  [[nodiscard]] std::optional<std::array<Vec3, 2>> meeting(std::int32_t i, std::int32_t j,
                                                           const Vec3& along) const;
  [[nodiscard]] bool is_along_edge(std::int32_t patch, const std::array<Vec3, 2>& segment,
                                   double margin) const;

  const PatchMesh& mesh_;
  double reach_;
};

}  // namespace radiosity
