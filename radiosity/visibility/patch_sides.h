#pragma once

#include "radiosity/scene/patch_mesh.h"

namespace radiosity {

/// Numbers for the sides of patches; twins have two, between them. Refers to the mesh.
struct PatchSides {
  const PatchMesh& mesh;

  [[nodiscard]] Index size() const { return 2 * mesh.size(); }
  [[nodiscard]] Index front(Index patch) const { return 2 * patch; }
  [[nodiscard]] Index back(Index patch) const {
    return mesh.twin[patch] < 0 ? 2 * patch + 1 : 2 * Index{mesh.twin[patch]};
  }
  /// Of twins the second has no sides of its own.
  [[nodiscard]] bool is_second(Index patch) const {
    return mesh.twin[patch] >= 0 && mesh.twin[patch] < patch;
  }
};

}  // namespace radiosity
