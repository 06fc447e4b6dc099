#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "radiosity/base/geometry.h"
#include "radiosity/polygon/convex_polygon.h"
#include "radiosity/scene/patch_mesh.h"

namespace radiosity {

/// How two patches touch elsewhere than edge to edge.
enum class Contact {
  none,
  overlaps,  ///< they lie on each other in one plane
  leans,     ///< the same in part of where they are over each other, and apart in others
  stands,    ///< an edge of one lies in the other, off its edges
  crosses    ///< they pass through each other, or no edge tells where they meet
};

/// How patches touch that are no further apart than `reach`, m. Refers to the mesh.
class PatchContact {
 public:
  /// Sine of the angle of planes that count as parallel, but for what their sizes and the thickness
  /// make of it.
  static constexpr double kParallel = 1e-6;

  PatchContact(const PatchMesh& mesh, double reach) : mesh_(mesh), reach_(reach) {}

  /// The directions off the edges of a patch.
  using Inwards = std::array<Vec3, 4>;

  /// How two patches touch elsewhere than edge to edge.
  [[nodiscard]] Contact between(std::int32_t i, std::int32_t j) const {
    return between(i, j, all_inwards(i));
  }
  /// The same, given what all_inwards(i) returns.
  [[nodiscard]] Contact between(std::int32_t i, std::int32_t j, const Inwards& inwards_i) const;

  /// From where to where, m.
  struct Part {
    double low;
    double high;
  };
  /// The part of a segment over a patch, if it is longer than twice the reach and all of it is
  /// within reach of the patch's plane.
  [[nodiscard]] std::optional<Part> part_within(const Vec3& start, const Vec3& end,
                                                std::int32_t patch) const;

  /// How far patch j is in front of patch i, m, where it is over it; negative behind.
  [[nodiscard]] std::optional<Part> heights_over(std::int32_t i, std::int32_t j) const;

  /// Corner k of a patch; the first one again for k = n_corners.
  [[nodiscard]] const Vec3& corner(std::int32_t patch, int k) const;
  /// The direction in a patch's plane off one of its edges, inwards; unit.
  [[nodiscard]] Vec3 inwards(std::int32_t patch, int edge) const;
  /// The same of all edges of a patch.
  [[nodiscard]] Inwards all_inwards(std::int32_t patch) const;

 private:
  [[nodiscard]] double width(std::int32_t patch) const;
  [[nodiscard]] double parallel_sine(std::int32_t i, std::int32_t j) const;
  [[nodiscard]] bool are_beside(std::int32_t i, std::int32_t j, const Inwards& inwards_i) const;
  [[nodiscard]] ConvexPolygon common_part(std::int32_t i, std::int32_t j) const;
  [[nodiscard]] Contact between_parallel(std::int32_t i, std::int32_t j,
                                         const Inwards& inwards_i) const;
  [[nodiscard]] std::optional<std::array<Vec3, 2>> meeting(std::int32_t i, std::int32_t j,
                                                           const Vec3& along) const;
  [[nodiscard]] bool is_along_edge(std::int32_t patch, const std::array<Vec3, 2>& segment,
                                   double margin) const;
  [[nodiscard]] bool stands_on(std::int32_t patch, std::int32_t other,
                               const std::array<Vec3, 2>& segment, double margin) const;

  const PatchMesh& mesh_;
  double reach_;
};

}  // namespace radiosity
