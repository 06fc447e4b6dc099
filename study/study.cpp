#include "study/study.h"

#include <utility>

#include "radiosity/assembly/dense_memory.h"
#include "radiosity/assembly/make_transport.h"
#include "radiosity/compressed/make_compressed_transport.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/solve/solve.h"
#include "radiosity/stream/streaming_memory.h"
#include "study/row_check.h"
#include "study/warnings.h"

namespace study {
namespace {

using namespace radiosity;

/// Throws SolveError if so many patches will not do, of which there may be more in the end.
void check_expected(Index n_patches, Index n_polygons, const StudyOptions& options) {
  if (is_compressed(options)) {
    check_compressed_memory(n_patches, options.memory);
  } else if (options.storage == Storage::memory) {
    check_memory(n_patches, n_polygons, options.memory);
  } else {
    // How much must be allowed can be told once their number is known.
    check_streaming_memory(n_patches);
  }
}

void check_made(Index n_patches, Index n_polygons, const StudyOptions& options) {
  if (is_compressed(options)) {
    check_compressed_memory(n_patches, options.memory);
  } else if (options.storage == Storage::memory) {
    check_memory(n_patches, n_polygons, options.memory);
  } else {
    check_streaming_memory(n_patches,
                           options.memory > 0 ? options.memory : default_streaming_memory());
  }
}

TransportOptions transport_options(const Scene& scene, const StudyOptions& options,
                                   const Progress& progress) {
  return {.tolerance = options.factor_tolerance.value_or(options.tolerance),
          .closed = closedness(scene, options.closed),
          .seed = options.seed,
          .memory = options.memory,
          .progress = progress};
}

FormFactors make_adaptive(const Scene& scene, const StudyOptions& options,
                          const StudyEvents& events) {
  meshing::AdaptiveMesh made = meshing::make_adaptive_patches(
      scene, {.tolerance = options.tolerance,
              .max_patches = options.patches.n_patches.value_or(meshing::kMostAdaptivePatches),
              .transport = transport_options(scene, options, events.progress),
              .progress = events.progress});
  return {.refined = Patches{std::move(made.mesh), std::move(made.visibility)},
          .refinement = made.refinement,
          .transport = std::move(made.transport)};
}

DiscretisationError estimate_discretisation(const PatchMesh& mesh, const Transport& transport,
                                            const Solution& solution, const StudyEvents& events) {
  DiscretisationError result = discretisation_error(mesh, transport, solution, events.progress);
  if (result.n_unknown == mesh.size() && !solution.reflectance.isZero(0)) {
    events.warn(
        "each surface has one patch only, so how far their size makes the result wrong is not "
        "known and not in the errors given; --patches N makes more");
  }
  return result;
}

}  // namespace

Patches divide(const Scene& scene, const StudyOptions& options, const StudyEvents& events) {
  const meshing::PatchOptions patch_options =
      meshing::make_patch_options(options.patches, scene, events.progress);
  check_expected(meshing::least_patches(scene, patch_options), scene.n_polygons(), options);
  warn_of_findings(scene, events);
  PatchMesh mesh = meshing::make_patches(scene, patch_options);
  if (events.warned && !options.patches.as_is) {
    if (const auto uncut = meshing::uncut_warning(mesh)) events.warn(*uncut);
  }
  check_made(mesh.size(), scene.n_polygons(), options);
  Visibility visibility(mesh);
  Patches patches{std::move(mesh), std::move(visibility)};
  if (events.divided) events.divided(scene, patches);
  return patches;
}

FormFactors make_form_factors(const Scene& scene, const PatchMesh& mesh,
                              const Visibility& visibility, const StudyOptions& options,
                              const StudyEvents& events) {
  FormFactors result;
  if (options.patches.adaptive) {
    result = make_adaptive(scene, options, events);
  } else if (is_compressed(options)) {
    result.transport = make_compressed_transport(mesh, visibility,
                                                 transport_options(scene, options, events.progress),
                                                 {exitance(scene, mesh), reflectance(scene, mesh)});
    warn_of_unverified(result.transport->report(),
                       options.factor_tolerance.value_or(options.tolerance), events);
  } else {
    result.transport =
        make_transport(mesh, visibility, transport_options(scene, options, events.progress));
  }
  const PatchMesh& made = result.refined ? result.refined->mesh : mesh;
  refuse_excess(scene, made, result.transport->report(),
                options.factor_tolerance.value_or(options.tolerance),
                [&](Index row) { return rows_of(*result.transport).row_error(row); });
  warn_of_open_rows(result.transport->report(), events);
  if (result.refinement) {
    warn_of_spent_patches(*result.refinement, made.size(), options.tolerance, events);
  }
  return result;
}

Light solve_light(const Scene& scene, const PatchMesh& mesh, const Transport& transport,
                  const StudyOptions& options, const StudyEvents& events) {
  const Eigen::MatrixXd emitted = exitance(scene, mesh);
  if (emitted.isZero(0)) {
    events.warn("no surface emits light: the radiosity is zero everywhere");
  }
  const SolveOptions solving{.method = options.method,
                             .tolerance = iteration_tolerance(options.tolerance),
                             .progress = events.progress};
  Solution solution = solve(transport, emitted, reflectance(scene, mesh), solving);
  warn_of_unconverged(solution, solving, events);
  DiscretisationError discretisation = estimate_discretisation(mesh, transport, solution, events);
  solution = with_discretisation_error(std::move(solution), discretisation);
  return {std::move(solution), std::move(discretisation)};
}

Study assemble(Scene scene, const StudyOptions& options, const StudyEvents& events) {
  Patches patches = divide(scene, options, events);
  FormFactors factors = make_form_factors(scene, patches.mesh, patches.visibility, options, events);
  if (factors.refined) patches = *std::move(factors.refined);
  return {.scene = std::move(scene),
          .mesh = std::move(patches.mesh),
          .visibility = std::move(patches.visibility),
          .transport = std::move(factors.transport),
          .refinement = factors.refinement};
}

Study run(Scene scene, const StudyOptions& options, const StudyEvents& events) {
  Study study = assemble(std::move(scene), options, events);
  Light light = solve_light(study.scene, study.mesh, *study.transport, options, events);
  study.solution = std::move(light.solution);
  study.discretisation = std::move(light.discretisation);
  return study;
}

}  // namespace study
