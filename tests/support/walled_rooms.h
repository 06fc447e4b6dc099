#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"

namespace radiosity::test {

/// A hut on a floor under a lamp, 3 to 5 walls and a roof. Each wall stands on the floor or goes
/// through it, meets its neighbours at the corner, abuts on them or goes on through them, and ends
/// at the roof or goes through it; sheets in two rooms of three, else boards 5 to 15 cm thick.
/// Within are a partition that crosses floor and walls, and a probe.
struct WalledRoom {
  Scene scene;
  Eigen::Matrix3d rotation;  ///< of the scene: half of the rooms are turned
  std::vector<Vec3> plan;    ///< corners of the inside at z = 0 before that, counter-clockwise, m
  double height = 0;         ///< of the inside, m

  /// Whether a patch looks into the inside.
  [[nodiscard]] bool looks_inside(const PatchMesh& mesh, Index patch) const;
};

enum class Hut {
  sealed,  ///< no light gets in
  open     ///< a wall or the roof is missing, or a wall ends above the floor
};

/// Same seed, same room. By seed coordinates have all their digits, 5 decimals or are of single
/// precision, and Scene::precision tells.
WalledRoom make_walled_room(std::uint64_t seed, Hut hut);

}  // namespace radiosity::test
