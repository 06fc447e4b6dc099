#pragma once

#include <Eigen/Core>

#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"

namespace radiosity {

/// What a material with a table is taken to be at where its temperature is not known, K.
inline constexpr double kUsualTemperature = 300;

/// Whether it is a heat other than 0 or a temperature above 0 K, which needs an emissivity above 0.
bool needs_emissivity(const Emission& emission);

/// Emissivity of a material with a table at a temperature, K: linear between its pairs, and beyond
/// them what it is at the nearest.
double emissivity_at(const Material& material, double kelvin);

/// Whether the emissivity of a surface's material depends on its temperature.
bool has_emissivity_tables(const Scene& scene);

/// Emissivity of each patch at these temperatures, K, n: by its material's table if it has one,
/// else 1 - ρ. Of one grey band.
Eigen::VectorXd emissivity_at(const Scene& scene, const PatchMesh& mesh,
                              const Eigen::VectorXd& temperature);

/// What patches are at as far as it is given, K, n: by their own or their materials' temperatures;
/// NaN where it follows from the heat.
Eigen::VectorXd given_temperatures(const Scene& scene, const PatchMesh& mesh);

}  // namespace radiosity
