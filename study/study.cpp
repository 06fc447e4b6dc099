#include "study/study.h"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "radiosity/compressed/light_polygons.h"
#include "radiosity/compressed/make_compressed_transport.h"
#include "radiosity/compressed/make_transport.h"
#include "radiosity/scene/emissivity_table.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/solve/conditions.h"
#include "radiosity/solve/incident_error.h"
#include "radiosity/solve/solve.h"
#include "radiosity/solve/solve_conditions.h"
#include "radiosity/stream/streaming_memory.h"
#include "radiosity/visibility/incident_light.h"
#include "study/luminaire_warnings.h"
#include "study/row_check.h"
#include "study/warnings.h"

namespace study {
namespace {

using namespace radiosity;

/// Throws SolveError where the method cannot pass heat through the scene's shields.
void check_method(const Scene& scene, const StudyOptions& options) {
  if (options.method != Method::gauss_seidel && options.method != Method::southwell) return;
  for (const Surface& surface : scene.surfaces) {
    if (!surface.is_shield) continue;
    throw SolveError(fmt::format(
        "surface '{}' is a shield, which {} cannot solve for; expected cg, jacobi or chebyshev",
        surface.name, method_name(options.method)));
  }
}

/// Throws SolveError if so many patches will not do, of which there may be more in the end.
void check_expected(const Scene& scene, Index n_patches, const StudyOptions& options) {
  check_method(scene, options);
  const Index n_polygons = scene.n_polygons();
  if (options.storage == Storage::memory) {
    check_choice(transport_choice(scene, options), n_patches, n_polygons, factor_tolerance(options),
                 options.memory);
  } else {
    // How much must be allowed can be told once their number is known.
    check_streaming_memory(n_patches);
  }
}

void check_made(const Scene& scene, Index n_patches, const StudyOptions& options) {
  const Index n_polygons = scene.n_polygons();
  if (options.storage == Storage::memory) {
    check_choice(transport_choice(scene, options), n_patches, n_polygons, factor_tolerance(options),
                 options.memory);
  } else {
    check_streaming_memory(n_patches,
                           options.memory > 0 ? options.memory : default_streaming_memory());
  }
}

FormFactors make_adaptive(const Scene& scene, const StudyOptions& options,
                          const StudyEvents& events) {
  for (const GivenHeat& given : scene.given_heat) {
    if (given.of == GivenHeat::Of::polygons) continue;
    throw SolveError(given.source +
                     ": tells of single patches, which adaptive ones are not before "
                     "they are made; expected a column polygon");
  }
  TransportOptions transport = transport_options(scene, options, events);
  // Each round has patches of its own.
  transport.rough = {};
  transport.work_file.clear();
  meshing::AdaptiveMesh made = meshing::make_adaptive_patches(
      scene, {.tolerance = options.tolerance,
              .max_patches = options.patches.n_patches.value_or(meshing::kMostAdaptivePatches),
              .transport = transport,
              .choice = transport_choice(scene, options),
              .progress = events.progress});
  return {.refined = Patches{std::move(made.mesh), std::move(made.visibility)},
          .refinement = made.refinement,
          .transport = std::move(made.transport)};
}

DiscretisationError estimate_discretisation(const PatchMesh& mesh, const Transport& transport,
                                            const Solution& solution, const StudyEvents& events) {
  DiscretisationError result = discretisation_error(mesh, transport, solution, events.progress);
  warn_of_unknown_size(result, solution, events);
  return result;
}

}  // namespace

Patches divide(const Scene& scene, const StudyOptions& options, const StudyEvents& events) {
  const meshing::PatchOptions patch_options =
      meshing::make_patch_options(options.patches, scene, events.progress);
  check_expected(scene, meshing::least_patches(scene, patch_options), options);
  warn_of_findings(scene, events);
  PatchMesh mesh = meshing::make_patches(scene, patch_options);
  if (events.warned && !options.patches.as_is) {
    if (const auto uncut = meshing::uncut_warning(mesh)) events.warn(*uncut);
  }
  check_made(scene, mesh.size(), options);
  warn_of_cut_off(scene, mesh, events);
  warn_of_partly_given_heat(scene, mesh, events);
  Visibility visibility(mesh);
  warn_of_luminaires(scene, mesh, visibility, events);
  Patches patches{std::move(mesh), std::move(visibility)};
  if (events.divided) events.divided(scene, patches);
  return patches;
}

TransportOptions transport_options(const Scene& scene, const StudyOptions& options,
                                   const StudyEvents& events) {
  return {.tolerance = factor_tolerance(options),
          .closed = closedness(scene, options.closed),
          .seed = options.seed,
          .memory = options.memory,
          .ranks = options.ranks,
          .progress = events.progress,
          .work_file = options.work_file,
          .work_start = options.work_start,
          .rough = events.rough};
}

ExpectedLight expected_light(const Scene& scene, const PatchMesh& mesh, const Progress& progress) {
  return {initial_radiosity(scene, mesh, progress), reflectance(scene, mesh),
          exitance(scene, mesh).cwiseAbs()};
}

Fingerprint compressed_fingerprint(const Scene& scene, const PatchMesh& mesh,
                                   const StudyOptions& options) {
  return radiosity::compressed_fingerprint(mesh, transport_options(scene, options, {}),
                                           expected_light(scene, mesh, {}));
}

FormFactors make_form_factors(const Scene& scene, const PatchMesh& mesh,
                              const Visibility& visibility, const StudyOptions& options,
                              const StudyEvents& events) {
  FormFactors result;
  if (options.patches.adaptive) {
    result = make_adaptive(scene, options, events);
  } else {
    const TransportOptions made = transport_options(scene, options, events);
    const TransportChoice choice = transport_choice(scene, options);
    // Dense ones are the same for any light, which may take long to find.
    const bool is_dense =
        chosen_kind(choice, mesh.size(), made.tolerance, made.memory) == TransportKind::dense;
    result.transport =
        make_transport(mesh, visibility, made, choice,
                       is_dense ? ExpectedLight() : expected_light(scene, mesh, events.progress));
  }
  warn_of_unverified(result.transport->report(), factor_tolerance(options), events);
  const PatchMesh& made = result.refined ? result.refined->mesh : mesh;
  refuse_excess(scene, made, result.transport->report(), factor_tolerance(options),
                [&](Index row) { return rows_of(*result.transport).row_error(row); });
  warn_of_open_rows(result.transport->report(), events);
  warn_of_textures(scene, made, events);
  if (result.refinement) {
    warn_of_spent_patches(*result.refinement, made.size(), options.tolerance, events);
  }
  return result;
}

Light solve_light(const Scene& scene, const PatchMesh& mesh, const Transport& transport,
                  const StudyOptions& options, const StudyEvents& events) {
  return solve_light(scene, mesh, transport, incident_on_patches(scene, mesh, events.progress),
                     options, events);
}

Light solve_light(const Scene& scene, const PatchMesh& mesh, const Transport& transport,
                  const IncidentIrradiance& from_without, const StudyOptions& options,
                  const StudyEvents& events) {
  const Eigen::MatrixXd& sun = from_without.irradiance;
  if (!has_emissivity_tables(scene)) {
    Conditions conditions = make_conditions(scene, mesh, transport, sun);
    conditions.incident_error = from_without.error.replicate(1, scene.bands.count());
    return solve_light(mesh, transport, conditions, options, events);
  }
  const SettledEmissivity settled = settle_emissivity(scene, mesh, transport, sun, options, events);
  Light light = solve_light(mesh, transport,
                            make_conditions(scene, mesh, transport, sun, {}, settled.emissivity),
                            options, events);
  light.emissivity = settled.iteration;
  return light;
}

Light solve_light(const PatchMesh& mesh, const Transport& transport, const Conditions& conditions,
                  const StudyOptions& options, const StudyEvents& events) {
  warn_of_darkness(conditions.exitance, conditions.incident, events);
  const SolveOptions solving = with_conditions({.method = options.method,
                                                .solver = options.solver,
                                                .tolerance = iteration_tolerance(options.tolerance),
                                                .progress = events.progress},
                                               conditions, conditions.exitance.cols());
  Solution solution = solve(mesh, transport, conditions, solving);
  warn_of_unconverged(solution, solving, events);
  DiscretisationError discretisation = estimate_discretisation(mesh, transport, solution, events);
  solution = with_discretisation_error(std::move(solution), discretisation);
  solution = with_incident_error(std::move(solution), transport, conditions.incident_error,
                                 events.progress);
  if (conditions.emissivity.size() > 0 && solution.radiosity.cols() == 1) {
    solution.temperature = temperatures(mesh, solution, conditions.emissivity);
  }
  return {.solution = std::move(solution), .discretisation = std::move(discretisation)};
}

Study assemble(Scene scene, const StudyOptions& options, const StudyEvents& events) {
  Patches patches = divide(scene, options, events);
  FormFactors factors = make_form_factors(scene, patches.mesh, patches.visibility, options, events);
  if (factors.refined) patches = *std::move(factors.refined);
  return {.scene = std::move(scene),
          .mesh = std::move(patches.mesh),
          .visibility = std::move(patches.visibility),
          .transport = std::move(factors.transport),
          .factor_tolerance = factor_tolerance(options),
          .refinement = factors.refinement};
}

Study assemble(Scene scene, KnownFactors known, const StudyOptions& options,
               const StudyEvents& events) {
  check_method(scene, options);
  check_known(scene, known, options, events);
  warn_of_partly_given_heat(scene, known.mesh, events);
  Visibility visibility(known.mesh);
  Patches patches{std::move(known.mesh), std::move(visibility)};
  if (events.divided) events.divided(scene, patches);
  TransportOptions made = transport_options(scene, options, events);
  made.tolerance = known.tolerance;
  add_missing_light(*known.transport, patches.mesh, patches.visibility, made,
                    exitance(scene, patches.mesh).cwiseAbs());
  refuse_excess(scene, patches.mesh, known.transport->report(), known.tolerance,
                [&](Index row) { return rows_of(*known.transport).row_error(row); });
  warn_of_open_rows(known.transport->report(), events);
  warn_of_textures(scene, patches.mesh, events);
  return {.scene = std::move(scene),
          .mesh = std::move(patches.mesh),
          .visibility = std::move(patches.visibility),
          .transport = std::move(known.transport),
          .factor_tolerance = known.tolerance};
}

Study with_light(Study study, const StudyOptions& options, const StudyEvents& events) {
  Light light = solve_light(study.scene, study.mesh, *study.transport, options, events);
  study.solution = std::move(light.solution);
  study.discretisation = std::move(light.discretisation);
  study.emissivity = light.emissivity;
  if (options.verifies_light) {
    TransportOptions made = transport_options(study.scene, options, events);
    made.tolerance = study.factor_tolerance;
    study.verified = verify_light(*study.transport, study.mesh, study.visibility, made,
                                  study.solution.radiosity);
    if (study.verified) warn_of_unverified(*study.verified, made.tolerance, events);
  }
  return study;
}

Study run(Scene scene, const StudyOptions& options, const StudyEvents& events) {
  return with_light(assemble(std::move(scene), options, events), options, events);
}

}  // namespace study
