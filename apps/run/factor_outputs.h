#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/run/factor_format.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"
#include "radiosity/stream/row_stream.h"

namespace apps {

/// The outputs and what is written beside them. Throws CLI::ValidationError if `asked` goes with
/// none of them.
std::vector<std::string> all_factor_outputs(const std::vector<std::string>& outputs,
                                            const std::string& asked);

/// Finds out before the long work what would fail after it. Throws SceneError and SolveError, with
/// the reason, if an output cannot hold the factors between these patches.
void check_factor_outputs(const std::vector<std::string>& outputs, const std::string& asked,
                          const radiosity::Scene& scene, const radiosity::PatchMesh& mesh);

/// Writes a file of factors between polygons. `visit` visits the rows of the patches. Throws
/// OutputError.
void write_polygon_factors(const std::string& path, FactorFormat format,
                           const radiosity::PatchMesh& mesh,
                           const std::function<void(const radiosity::RowVisitor&)>& visit);

}  // namespace apps
