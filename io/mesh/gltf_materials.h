#pragma once

#include <filesystem>
#include <vector>

#include "io/mesh/file_scene.h"
#include "io/mesh/gltf_document.h"
#include "radiosity/scene/scene.h"

namespace io {

/// The materials of a glTF file, in its order.
struct GltfMaterials {
  std::vector<radiosity::Material> materials;  ///< three RGB bands
  std::vector<bool> two_sided;                 ///< per material: `doubleSided`
  RepairCount textures;                        ///< that are not read
};

/// Base colour is the reflectance, emissive colour the radiance. Each name is made one of its own.
/// Throws SceneError for colours that are impossible.
GltfMaterials read_gltf_materials(const std::filesystem::path& path, const GltfDocument& document);

}  // namespace io
