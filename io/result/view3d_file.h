#pragma once

#include <Eigen/Core>
#include <filesystem>

#include "radiosity/scene/patch_mesh.h"

namespace io {

/// Writes form factors between surfaces (radiosity::surface_form_factors) as View3D 4 does into its
/// text files: a header, the areas, a row of factors for each surface with six decimals, and the
/// emissivities, one per surface, with three. Areas in m². Throws OutputError.
void write_view3d(const std::filesystem::path& path, const radiosity::PatchMesh& mesh,
                  const Eigen::MatrixXd& factors, const Eigen::VectorXd& emissivities);

}  // namespace io
