#pragma once

#include <filesystem>

#include "io/mesh/file_scene.h"

namespace io {

/// Reads the boundary of a case of OpenFOAM, whose folder holds the file `path` (case.foam, as
/// ParaView wants it; it may be empty): the patches of the group viewFactorWall are surfaces, their
/// faces polygons, in their order, seen from the cells. Of constant/polyMesh, in ascii. Throws
/// SceneError with file and line.
FileScene read_foam_case(const std::filesystem::path& path);

}  // namespace io
