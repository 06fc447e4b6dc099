#pragma once

#include <Eigen/Core>
#include <string>

#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"

namespace apps {

/// Writes form factors between surfaces as the extension of the file says: .csv, or .txt as View3D
/// does, without obstructions. What a .vs3 scene says of the result (emit, out) counts for that.
/// Throws OutputError.
void write_factor_table(const std::string& path, const radiosity::Scene& scene,
                        const radiosity::PatchMesh& mesh, const Eigen::MatrixXd& factors,
                        bool is_closed);

}  // namespace apps
