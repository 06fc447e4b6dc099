#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/mesh/mtl_texture.h"
#include "io/picture/texture_pictures.h"
#include "radiosity/base/progress.h"
#include "radiosity/scene/scene.h"

namespace io {

/// Reflectance of surfaces that have no material (in a file without materials) or whose material
/// does not tell it.
inline constexpr double kDefaultReflectance = 0.5;

/// The materials of a .mtl file, three RGB bands each, in file order.
struct MtlFile {
  std::vector<radiosity::Material> materials;
  std::vector<MtlTexture> textures;  ///< per material: where its texture lies
  std::vector<std::string> warnings;
  std::vector<std::string> repairs;             ///< see FileScene
  std::vector<std::filesystem::path> pictures;  ///< that it may mean, read or not
};

/// Reads `Kd` (reflectance), `map_Kd` (what that is times from place to place, if there are
/// `pictures`) and `Ke` (radiance, W/(m² sr)); what else the format knows is ignored. Of materials
/// with one name the first counts; those without a name are left out. Throws SceneError with file
/// and line.
MtlFile read_mtl(const std::filesystem::path& path, TexturePictures* pictures,
                 const radiosity::Progress& progress);

}  // namespace io
