#pragma once

#include <memory>

#include "meshing/adaptive/adaptive.h"
#include "meshing/patches/patches.h"
#include "radiosity/assembly/transport_options.h"
#include "radiosity/base/geometry.h"
#include "radiosity/operator/transport.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solve/solution.h"
#include "radiosity/visibility/visibility.h"

namespace apps::validation {

/// A scene with its patches and form factors.
struct Assembly {
  radiosity::Scene scene;
  radiosity::PatchMesh mesh{};
  std::unique_ptr<radiosity::Visibility> visibility{};
  std::unique_ptr<radiosity::Transport> transport{};
};

/// Makes the patches and their form factors. The scene's own word on whether it is closed counts
/// if the options leave it open. Throws what the stages throw.
Assembly assemble(radiosity::Scene scene, const meshing::PatchOptions& patches = {},
                  const radiosity::TransportOptions& options = {});

/// The same with patches that fit the light.
Assembly assemble_adaptively(radiosity::Scene scene, const meshing::AdaptiveOptions& options);

/// The scene's radiosity by its own materials.
radiosity::Solution solve_own_light(const Assembly& assembly,
                                    const radiosity::SolveOptions& options = {});

/// Patch areas, m².
Eigen::Map<const Eigen::VectorXd> areas(const radiosity::PatchMesh& mesh);

/// Area-weighted means over the scene's polygons of values per patch, n_polygons x n_columns.
Eigen::MatrixXd polygon_means(const radiosity::PatchMesh& mesh, const Eigen::MatrixXd& values,
                              radiosity::Index n_polygons);

}  // namespace apps::validation
