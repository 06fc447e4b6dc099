#pragma once

#include <optional>
#include <string>

#include "meshing/adaptive/adaptive.h"
#include "radiosity/compressed/verified_light.h"
#include "radiosity/operator/transport.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solve/discretisation_error.h"
#include "radiosity/solve/solution.h"
#include "study/study_events.h"

namespace study {

/// Of serious flaws of the scene, unless it is too large to be searched.
void warn_of_findings(const radiosity::Scene& scene, const StudyEvents& events);

/// Of what repeated scenes lose beyond the images that are reckoned with.
void warn_of_cut_off(const radiosity::Scene& scene, const radiosity::PatchMesh& mesh,
                     const StudyEvents& events);

/// If heat is given to single patches, but not to all: they may be those of another division.
/// Throws SceneError as radiosity::patch_heat does.
void warn_of_partly_given_heat(const radiosity::Scene& scene, const radiosity::PatchMesh& mesh,
                               const StudyEvents& events);

/// What to say if a scene taken as closed has patches that see an opening; else empty.
std::optional<std::string> open_rows_warning(const radiosity::AssemblyReport& report);
/// Says it.
void warn_of_open_rows(const radiosity::AssemblyReport& report, const StudyEvents& events);

/// If the reflectance of a texture varies strongly within patches, which have its mean.
void warn_of_textures(const radiosity::Scene& scene, const radiosity::PatchMesh& mesh,
                      const StudyEvents& events);

/// If nothing emits and no sun or luminaire shines, and if these (direct irradiance `incident`,
/// empty without any) reach nothing.
void warn_of_darkness(const Eigen::MatrixXd& exitance, const Eigen::MatrixXd& incident,
                      const StudyEvents& events);

/// If the error of a compressed operator could not be brought down to `tolerance`.
void warn_of_unverified(const radiosity::AssemblyReport& report, double tolerance,
                        const StudyEvents& events);

/// The same of the error for one light.
void warn_of_unverified(const radiosity::VerifiedLight& verified, double tolerance,
                        const StudyEvents& events);

/// If the patches were spent before their error was as asked.
void warn_of_spent_patches(const meshing::Refinement& refinement, radiosity::Index n_patches,
                           double tolerance, const StudyEvents& events);

/// Whether most light is reflected by patches alone on their surfaces: nothing tells what their
/// size makes wrong.
bool is_size_unknown(const radiosity::DiscretisationError& discretisation);
/// Says it.
void warn_of_unknown_size(const radiosity::DiscretisationError& discretisation,
                          const radiosity::Solution& solution, const StudyEvents& events);

/// If the iteration, by `options`, has not converged.
void warn_of_unconverged(const radiosity::Solution& solution,
                         const radiosity::SolveOptions& options, const StudyEvents& events);

}  // namespace study
