#pragma once

#include <Eigen/Core>

#include "radiosity/operator/transport.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"
#include "study/study_events.h"
#include "study/study_options.h"

namespace study {

/// How emissivities that depend on temperatures were found.
struct EmissivityIteration {
  int n_solves = 0;     ///< each with the emissivities of the temperatures before
  double change = 0;    ///< of the temperatures in the last one, relative, the largest of a patch
  bool settled = true;  ///< whether that is small enough
};

/// Emissivity of each patch at the temperature that follows from it, n.
struct SettledEmissivity {
  Eigen::VectorXd emissivity;
  EmissivityIteration iteration;
};

/// Solves again and again, each time with the emissivities that the patches have at the
/// temperatures found before, until no temperature changes by more than a thousandth of the
/// tolerance, relative, or 50 times. `sun` is the sun's direct irradiance, n x 1, or empty. Warns
/// if they do not settle. Throws SolveError as `solve` does; Interrupted.
SettledEmissivity settle_emissivity(const radiosity::Scene& scene, const radiosity::PatchMesh& mesh,
                                    const radiosity::Transport& transport,
                                    const Eigen::MatrixXd& sun, const StudyOptions& options,
                                    const StudyEvents& events);

}  // namespace study
