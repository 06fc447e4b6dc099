#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "meshing/adaptive/adaptive.h"
#include "radiosity/base/fingerprint.h"
#include "radiosity/compressed/verified_light.h"
#include "radiosity/operator/transport.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solve/conditions.h"
#include "radiosity/solve/discretisation_error.h"
#include "radiosity/solve/solution.h"
#include "radiosity/visibility/incident_irradiance.h"
#include "radiosity/visibility/visibility.h"
#include "study/known_factors.h"
#include "study/settled_emissivity.h"
#include "study/study_events.h"
#include "study/study_options.h"

/// The one way from a scene to its light: each stage takes what the earlier ones made.
namespace study {

/// Form factors of patches.
struct FormFactors {
  std::optional<Patches> refined = {};  ///< those that they belong to, if patches were refined
  std::optional<meshing::Refinement> refinement = {};  ///< how, if so
  std::unique_ptr<radiosity::Transport> transport;
};

/// The light on the patches and how wrong it is.
struct Light {
  radiosity::Solution solution;  ///< its errors include `discretisation`
  radiosity::DiscretisationError discretisation;
  std::optional<EmissivityIteration> emissivity = {};  ///< if it depends on the temperature
};

/// A scene and all that was found out about it.
struct Study {
  radiosity::Scene scene;
  radiosity::PatchMesh mesh;
  radiosity::Visibility visibility;
  std::unique_ptr<radiosity::Transport> transport;
  double factor_tolerance = 0;  ///< relative error that was asked of its form factors
  std::optional<meshing::Refinement> refinement = {};  ///< if patches were refined
  radiosity::Solution solution = {};                   ///< its errors include `discretisation`
  radiosity::DiscretisationError discretisation = {};
  std::optional<EmissivityIteration> emissivity = {};  ///< if it depends on the temperature
  /// Of a compressed operator and this light, if StudyOptions::verifies_light.
  std::optional<radiosity::VerifiedLight> verified = {};
};

/// Divides the scene into patches. Warns of serious flaws of the scene and of patches that could
/// not be cut. Throws MemoryShortage if the form factors will not fit into memory, before patches
/// are made wherever their number can be foreseen (`meshing::least_patches`); MeshError;
/// Interrupted.
Patches divide(const radiosity::Scene& scene, const StudyOptions& options = {},
               const StudyEvents& events = {});

/// Computes the form factors, with PatchChoice::adaptive of patches of its own. Warns of rows that
/// see an opening in a scene taken as closed. Throws MemoryShortage if they don't fit into memory,
/// before anything long; SolveError as `refuse_excess` does; Interrupted.
FormFactors make_form_factors(const radiosity::Scene& scene, const radiosity::PatchMesh& mesh,
                              const radiosity::Visibility& visibility,
                              const StudyOptions& options = {}, const StudyEvents& events = {});

/// What the assembly of an operator takes by these options.
radiosity::TransportOptions transport_options(const radiosity::Scene& scene,
                                              const StudyOptions& options,
                                              const StudyEvents& events);

/// The light that operators are made for.
radiosity::ExpectedLight expected_light(const radiosity::Scene& scene,
                                        const radiosity::PatchMesh& mesh,
                                        const radiosity::Progress& progress);

/// Of the compressed ones that these options make of patches of one size: what a work file has.
radiosity::Fingerprint compressed_fingerprint(const radiosity::Scene& scene,
                                              const radiosity::PatchMesh& mesh,
                                              const StudyOptions& options);

/// The radiosity by the scene's own materials, sun and environment. Warns if nothing emits, if the
/// iteration does not converge and if the errors can't be told. Throws SolveError, Interrupted.
Light solve_light(const radiosity::Scene& scene, const radiosity::PatchMesh& mesh,
                  const radiosity::Transport& transport, const StudyOptions& options = {},
                  const StudyEvents& events = {});

/// The same with the light from without at hand (incident_on_patches).
Light solve_light(const radiosity::Scene& scene, const radiosity::PatchMesh& mesh,
                  const radiosity::Transport& transport,
                  const radiosity::IncidentIrradiance& from_without, const StudyOptions& options,
                  const StudyEvents& events);

/// The same of any conditions, n x k emitted of n x b; tells temperatures if they are of heat.
/// Throws SolveError where heat is given to surfaces that nothing takes it from, with their names,
/// and where a temperature would be below absolute zero.
Light solve_light(const radiosity::PatchMesh& mesh, const radiosity::Transport& transport,
                  const radiosity::Conditions& conditions, const StudyOptions& options = {},
                  const StudyEvents& events = {});

/// The stages up to the form factors: there is no light yet.
Study assemble(radiosity::Scene scene, const StudyOptions& options = {},
               const StudyEvents& events = {});

/// The same with form factors that were made before. What a compressed operator lacks of the light
/// from polygons that emit now is added. Throws SolveError as check_known() does.
Study assemble(radiosity::Scene scene, KnownFactors known, const StudyOptions& options = {},
               const StudyEvents& events = {});

/// The last stage, of one that has no light yet. Warns if the light was to be verified and is off
/// by more than the form factors' tolerance.
Study with_light(Study assembled, const StudyOptions& options = {}, const StudyEvents& events = {});

/// All stages.
Study run(radiosity::Scene scene, const StudyOptions& options = {}, const StudyEvents& events = {});

}  // namespace study
