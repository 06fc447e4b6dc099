#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/patch_mesh.h"

namespace radiosity {

/// Patches that can send their light together: of one surface, in one plane, close together. Each
/// group is halved again and again, so that receivers nearby can tell its parts apart.
struct ShootingSources {
  /// Points of a group that stand for it where visibility is tested.
  static constexpr int kPoints = 4;

  /// A part of a group. Its halves follow: the first is the next node, the second comes where the
  /// first one ends.
  struct Node {
    std::int32_t end = 0;     ///< of the nodes in it, itself included
    std::int32_t patch = -1;  ///< the one patch in it; -1 if it has halves
    Vec3 center;              ///< mean over its area, m
    double radius = 0;        ///< of a sphere about the centre that holds all of it, m
    double area = 0;          ///< m²
  };
  struct Group {
    std::int32_t node = 0;  ///< all of it
    std::vector<std::int32_t> patches;
    std::array<Vec3, kPoints> points;  ///< spread over its patches, m
  };

  std::vector<Node> nodes;
  std::vector<Group> groups;
};

/// Point k of four that are spread over a patch: half-way from its centroid to corner k, the fourth
/// of a triangle the centroid itself. m.
Vec3 inner_point(const PatchMesh& mesh, std::int32_t patch, int k);

/// Groups the patches, at most `largest` to a group and a quarter of that where `is_bright`, which
/// has a value per patch. Deterministic.
ShootingSources make_shooting_sources(const PatchMesh& mesh, const std::vector<bool>& is_bright,
                                      Index largest);

}  // namespace radiosity
