#pragma once

#include <filesystem>
#include <vector>

#include "io/mesh/file_scene.h"
#include "io/mesh/gltf_document.h"
#include "io/mesh/gltf_textures.h"
#include "radiosity/scene/scene.h"

namespace io {

/// The materials of a glTF file, in its order.
struct GltfMaterials {
  std::vector<radiosity::Material> materials;          ///< three RGB bands
  std::vector<bool> two_sided;                         ///< per material: `doubleSided`
  std::vector<std::optional<GltfPlacement>> textures;  ///< per material: if it has a texture
  RepairCount emissive;                                ///< textures, which are not read
  RepairCount unread;                                  ///< pictures that cannot be
};

/// Base colour, and its texture, is the reflectance, emissive colour the radiance. Each name is
/// made one of its own. Throws SceneError for colours that are impossible.
GltfMaterials read_gltf_materials(const std::filesystem::path& path, GltfDocument& document);

}  // namespace io
