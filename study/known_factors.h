#pragma once

#include <memory>
#include <string>

#include "radiosity/base/geometry.h"
#include "radiosity/operator/transport.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"
#include "study/study_events.h"
#include "study/study_options.h"

namespace study {

/// Form factors that were made before, to be used for other light, reflectances or bands on the
/// same surfaces.
struct KnownFactors {
  std::string source;         ///< where they come from, for messages
  radiosity::PatchMesh mesh;  ///< the patches that they are of
  std::unique_ptr<radiosity::Transport> transport;
  double tolerance = 0;  ///< relative error that was asked of them
  std::string geometry;  ///< geometry_fingerprint() of their scene; may be empty
};

/// Identifies the surfaces of a scene, whatever their materials: a hash of polygons, names, sides
/// and precision.
std::string geometry_fingerprint(const radiosity::Scene& scene);

/// Throws SolveError, with the reason, if the form factors are of other surfaces than the scene's,
/// of other patches than the options choose, or not made as the options ask. Warns if more exact
/// ones are asked.
void check_known(const radiosity::Scene& scene, const KnownFactors& known,
                 const StudyOptions& options, const StudyEvents& events);

}  // namespace study
