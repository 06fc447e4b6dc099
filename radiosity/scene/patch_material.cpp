#include "radiosity/scene/patch_material.h"

namespace radiosity {

int material_of(const Scene& scene, const PatchMesh& mesh, Index patch) {
  const Surface& surface = scene.surfaces[mesh.surface[patch]];
  // Fronts come before their backs.
  const bool is_back = mesh.twin[patch] >= 0 && mesh.twin[patch] < patch;
  return is_back && surface.back_material >= 0 ? surface.back_material : surface.material;
}

}  // namespace radiosity
