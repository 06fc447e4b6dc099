#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "radiosity/scene/scene.h"

namespace io {

/// Sees that polygons whose material has a texture have coordinates at all corners, which do not
/// span more than radiosity::kMostTexels; those of others are made not finite, so that the mean of
/// the picture counts, and a line in `repairs` counts these polygons.
void check_texture_coordinates(const std::filesystem::path& path, radiosity::Scene& scene,
                               std::vector<std::string>& repairs);

/// Gives the polygon that was added last to a scene, which is polygon i of a mesh, perhaps with its
/// corners in reverse, the mesh's coordinates; others before it that have none get some that are
/// not finite.
void append_texture_coordinates(const radiosity::Scene& mesh, radiosity::Index i, bool is_reversed,
                                radiosity::Scene& scene);

/// Those that are not finite for all corners at the end of a scene that have none, if others do.
void pad_texture_coordinates(radiosity::Scene& scene);

}  // namespace io
