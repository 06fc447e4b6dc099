#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "radiosity/scene/patch_mesh.h"

namespace apps {

/// The patches that --row names: those of a surface, or a patch by its number. Throws SceneError
/// naming `source` and the nearest surface if there are none.
std::vector<std::int32_t> patches_named(const std::string& text, const radiosity::PatchMesh& mesh,
                                        const std::string& source);

}  // namespace apps
