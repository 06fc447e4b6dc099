#pragma once

#include <Eigen/Core>
#include <string>

#include "apps/run/factor_format.h"
#include "io/result/energyplus_factors.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"

namespace apps {

/// Form factors between surfaces.
struct FactorTable {
  const Eigen::MatrixXd& factors;
  bool is_closed = false;  ///< no radiation leaves them
};

/// The zone of each surface: as the file of EnergyPlus has it that the scene is read from; else all
/// are of one, named after the scene.
io::ZoneFactors zone_factors(const radiosity::Scene& scene, const radiosity::PatchMesh& mesh,
                             const Eigen::MatrixXd& factors);

/// Writes form factors between surfaces: .csv, MOOSE's .csv, EnergyPlus' .idf and .epJSON, or .txt
/// as View3D does, without obstructions. What a .vs3 scene says of the result (emit, out) counts
/// for that. Throws OutputError.
void write_factor_table(const std::string& path, FactorFormat format, const radiosity::Scene& scene,
                        const radiosity::PatchMesh& mesh, const FactorTable& table);

}  // namespace apps
