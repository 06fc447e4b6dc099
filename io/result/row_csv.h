#pragma once

#include <filesystem>

#include "radiosity/operator/joint_row.h"
#include "radiosity/scene/patch_mesh.h"

namespace io {

/// Writes a row of form factors, one line for each patch: patch,surface,factor,error. Throws
/// OutputError.
void write_row_csv(const std::filesystem::path& path, const radiosity::PatchMesh& mesh,
                   const radiosity::JointRow& row);

}  // namespace io
