#pragma once

#include <Eigen/Core>
#include <filesystem>

#include "radiosity/scene/patch_mesh.h"

namespace io {

/// Writes form factors between surfaces (radiosity::surface_form_factors), one row per surface:
/// surface,area,<name of each surface>...,unseen. Area in m²; unseen is what reaches no surface.
/// Throws OutputError.
void write_surface_csv(const std::filesystem::path& path, const radiosity::PatchMesh& mesh,
                       const Eigen::MatrixXd& factors);

}  // namespace io
