#pragma once

#include <filesystem>
#include <vector>

#include "io/result/element_rows.h"

namespace io {

/// The files of OpenFOAM's form factors beside the file F of a case: globalFaceFaces, mapDist and,
/// if there is none yet, finalAgglom.
std::vector<std::filesystem::path> foam_companions(const std::filesystem::path& path);

/// Throws SceneError if the case that holds the file F has not as many radiating faces as there are
/// elements, or if they are agglomerated (finalAgglom), but into single faces.
void check_foam_case(const std::filesystem::path& path, radiosity::Index n_elements);

/// Writes form factors as OpenFOAM's radiation model viewFactor reads them: `path` is the file
/// constant/F of a case, beside which globalFaceFaces (the faces that each face sees), mapDist (of
/// one processor) and, if there is none, finalAgglom (each face by itself) are written, in ascii.
/// Faces are those of the case's patches of the group viewFactorWall, in their order. Throws
/// SceneError as check_foam_case does; OutputError.
void write_foam_factors(const std::filesystem::path& path, const ElementRows& rows);

}  // namespace io
