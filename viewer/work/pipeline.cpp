#include "viewer/work/pipeline.h"

#include <optional>
#include <utility>

#include "io/base/extension.h"
#include "io/result/form_factor_reader.h"
#include "io/result/operator_file.h"
#include "io/result/result_reader.h"
#include "io/scene/scene_file.h"
#include "meshing/patches/patches.h"
#include "radiosity/base/error.h"
#include "radiosity/base/machine_memory.h"
#include "radiosity/operator/transport.h"
#include "radiosity/scene/emissivity_table.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/solve/conditions.h"
#include "radiosity/solve/discretisation_error.h"
#include "radiosity/solve/solution.h"
#include "radiosity/solve/solve.h"
#include "radiosity/visibility/visibility.h"
#include "study/study.h"
#include "study/warnings.h"
#include "viewer/work/relative_error.h"

namespace viewer {
namespace {

using radiosity::Index;
using radiosity::PatchMesh;
using radiosity::Progress;
using radiosity::Scene;
using radiosity::Solution;
using radiosity::Transport;

constexpr double kQuickTolerance = 1e-3;  // no pixel shows it

/// Bytes that a polygon takes in the window at most, with its share of the ray tracer's tree.
constexpr std::size_t kShownBytes = 2000;

Model with_patches(Model model, study::Patches patches) {
  model.mesh = std::make_shared<PatchMesh>(std::move(patches.mesh));
  model.bounds = radiosity::bounds(*model.mesh);
  model.visibility = std::make_shared<radiosity::Visibility>(std::move(patches.visibility));
  model.outer = outer_light(*model.scene, *model.mesh, make_mix(*model.scene));
  return model;
}

/// Each polygon as it is, which is enough to be looked at; nothing if even that is too much.
std::optional<study::Patches> polygons_as_patches(const Scene& scene, const Progress& progress) {
  const std::size_t needed = kShownBytes * static_cast<std::size_t>(scene.n_polygons());
  const std::size_t usable = radiosity::usable_memory();
  if (usable > 0 && needed > usable) return std::nullopt;
  PatchMesh mesh = meshing::make_patches(scene, {.progress = progress});
  radiosity::Visibility visibility(mesh);
  return study::Patches{std::move(mesh), std::move(visibility)};
}

radiosity::SolveOptions solve_options(double tolerance, const Progress& progress) {
  radiosity::SolveOptions options;
  options.tolerance = tolerance;
  options.estimates_errors = false;
  options.progress = progress;
  return options;
}

/// What the scene says, with the emission of the mix. `scene` has its reflectances.
radiosity::Conditions mix_conditions(const Model& model, const Transport& transport,
                                     const LightMix& mix, const Scene& scene) {
  radiosity::Conditions conditions =
      make_conditions(scene, *model.mesh, transport, outer_irradiance(model, mix));
  conditions.exitance = mix_exitance(scene, *model.mesh, mix);
  return conditions;
}

/// What patches are at, where the light is heat in one band; a warning where that cannot be.
void set_temperatures(const PatchMesh& mesh, const radiosity::Conditions& conditions,
                      Solution& solution, const LightEvents& events) {
  if (conditions.emissivity.size() == 0 || solution.radiosity.cols() != 1) return;
  try {
    solution.temperature = temperatures(mesh, solution, conditions.emissivity);
  } catch (const radiosity::SolveError& error) {
    events.warned(error.what());
  }
}

/// The light of each emitter, and that of the environment in columns of its own.
EmitterLights separate(const Model& model, const LightMix& mix, const Scene& scene,
                       const radiosity::Conditions& conditions, double tolerance,
                       const Progress& progress) {
  EmitterLights lights;
  lights.reflectance = conditions.reflectance;
  const Index n = conditions.reflectance.rows();
  const Index n_bands = conditions.reflectance.cols();
  const auto n_emitters = static_cast<Index>(mix.emitters.size());
  const Eigen::MatrixXd full = radiosity::exitance(scene, *model.mesh);
  const Eigen::MatrixXd environment =
      make_conditions(scene, *model.mesh, *model.transport).incident;
  const bool has_environment = environment.size() > 0;
  Eigen::MatrixXd all =
      Eigen::MatrixXd::Zero(n, (n_emitters + (has_environment ? 1 : 0)) * n_bands);
  radiosity::SolveOptions options = solve_options(tolerance, progress);
  options.has_sinks = conditions.emissivity.size() > 0;
  if (conditions.incident.size() > 0) options.incident = Eigen::MatrixXd::Zero(n, all.cols());
  for (Index e = 0; e < n_emitters; ++e) {
    const bool is_outer = mix.emitters[e].kind != Emitter::Kind::surfaces;
    lights.exitance.push_back(is_outer ? Eigen::MatrixXd()
                                       : emitter_exitance(*model.mesh, full, mix.emitters[e]));
    (is_outer ? options.incident : all).middleCols(e * n_bands, n_bands) =
        is_outer ? *model.outer->irradiance[e] : lights.exitance.back();
  }
  if (has_environment) options.incident.rightCols(n_bands) = environment;
  const Solution solution = solve(*model.transport, all, conditions.reflectance, options);
  for (Index e = 0; e < n_emitters; ++e) {
    lights.irradiance.emplace_back(solution.irradiance.middleCols(e * n_bands, n_bands));
  }
  if (has_environment) lights.from_without = solution.irradiance.rightCols(n_bands);
  return lights;
}

}  // namespace

bool is_result_file(const std::string& path) {
  const std::string extension = io::lower_case_extension(path);
  return extension == ".vtp" || extension == ".h5";
}

OpenedFile open_result(const std::string& path) {
  OpenedFile file;
  Model& model = file.model;
  model.path = path;
  if (io::lower_case_extension(path) == ".vtp") {
    io::StoredResult result = io::read_result(path);
    file.warnings = std::move(result.warnings);
    model.mesh = std::make_shared<PatchMesh>(std::move(result.mesh));
    model.bands = result.bands;
    model.camera = result.camera;
    file.light = Light{Light::Kind::stored, std::move(result.solution)};
    file.light->relative_error = relative_error(*model.mesh, file.light->solution);
  } else if (io::is_compressed_operator(path)) {
    io::StoredOperator stored = io::read_operator(path);
    model.mesh = std::make_shared<PatchMesh>(std::move(stored.mesh));
    model.bands.kind = radiosity::Bands::Kind::grey;
    const std::shared_ptr<const Transport> transport = std::move(stored.transport);
    model.factors = {transport, transport->rows()};
    model.has_quick_rows = transport->has_quick_rows();
  } else {
    auto reader = std::make_shared<io::FormFactorReader>(path);
    file.warnings = reader->warnings();
    auto mesh = std::make_shared<PatchMesh>(reader->mesh());
    mesh->images = {};  // the part of a symmetric whole is shown by itself
    model.mesh = std::move(mesh);
    model.bands.kind = radiosity::Bands::Kind::grey;
    model.factors = reader;
  }
  model.bounds = radiosity::bounds(*model.mesh);
  model.visibility = std::make_shared<radiosity::Visibility>(*model.mesh);
  return file;
}

Scene read_whole_scene(const std::string& path, const io::ReadOptions& options,
                       const Progress& progress) {
  io::ReadOptions reading = options;
  reading.progress = progress;
  Scene scene = io::read_scene(path, reading);
  if (scene.n_polygons() == 0) throw radiosity::SceneError(path + ": the scene has no polygons");
  if (!scene.symmetry.is_none()) {
    throw radiosity::SceneError(
        path + ": symmetry: the window shows no symmetric scenes; radiosity solve and render do");
  }
  return scene;
}

OpenedFile open_scene(const std::string& path, std::shared_ptr<const Scene> scene,
                      const study::StudyOptions& options, const Progress& progress) {
  OpenedFile file;
  file.warnings = scene->warnings;
  if (has_emissivity_tables(*scene)) {
    file.warnings.emplace_back(
        "emissivities that depend on the temperature count here as at the materials' own, or at "
        "300 K; radiosity solve finds both together");
  }
  file.model.path = path;
  file.model.bands = scene->bands;
  file.model.camera = scene->camera;
  file.model.scene = std::move(scene);
  if (progress.report) progress.report("dividing", 0, 0, "");
  const study::StudyEvents studying = {
      .warned = [&](const std::string& text) { file.warnings.push_back(text); },
      .progress = progress};
  try {
    file.model = with_patches(file.model, study::divide(*file.model.scene, options, studying));
  } catch (const radiosity::SolveError& error) {
    auto polygons = polygons_as_patches(*file.model.scene, progress);
    if (!polygons) throw;
    file.model = with_patches(file.model, *std::move(polygons));
    file.refusal = error.what();
  }
  return file;
}

Model with_form_factors(Model model, const study::StudyOptions& options,
                        const FormFactorEvents& events, const Progress& progress) {
  const study::StudyEvents studying = {
      .warned = events.warned,
      .rough = [&](std::unique_ptr<Transport> transport) { events.rough(std::move(transport)); },
      .progress = progress};
  study::FormFactors factors =
      study::make_form_factors(*model.scene, *model.mesh, *model.visibility, options, studying);
  if (factors.refined) model = with_patches(std::move(model), *std::move(factors.refined));
  model.transport = std::move(factors.transport);
  model.factors = {model.transport, model.transport->rows()};
  model.has_quick_rows = model.transport->has_quick_rows();
  return model;
}

Model below_sky(Model model, const LightMix& mix, const Progress& progress) {
  model.outer = outer_light(*model.scene, *model.mesh, mix, model.outer, progress);
  return model;
}

Light rough_light(const Model& before, const Transport& rough, const LightMix& mix,
                  const Eigen::MatrixXd& irradiance, const Progress& progress) {
  const Model model = below_sky(before, mix, progress);
  const Scene scene = with_reflectance(*model.scene, mix);
  const radiosity::Conditions conditions = mix_conditions(model, rough, mix, scene);
  radiosity::SolveOptions options =
      with_conditions(solve_options(kQuickTolerance, progress), conditions, scene.bands.count());
  options.start = irradiance;
  return {.kind = Light::Kind::preview,
          .solution = solve(rough, conditions.exitance, conditions.reflectance, options),
          .factor_error = rough.report().compression.value().verified_error,
          .outer = model.outer};
}

void solve_light(const Model& before, const LightMix& mix, const LightStart& start,
                 const LightEvents& events, const Progress& progress) {
  const Model model = below_sky(before, mix, progress);
  const auto lit = [&](Light light) {
    light.outer = model.outer;
    events.lit(std::move(light));
  };
  const Scene scene = with_reflectance(*model.scene, mix);
  const radiosity::Conditions conditions = mix_conditions(model, *model.transport, mix, scene);
  const auto solved = [&](const radiosity::SolveOptions& solving) {
    return solve(*model.transport, conditions.exitance, conditions.reflectance, solving);
  };
  radiosity::SolveOptions options =
      with_conditions(solve_options(kQuickTolerance, progress), conditions, scene.bands.count());
  options.start = start.irradiance;
  if (start.separated) {
    Solution sum = superpose(*start.separated, mix);
    options.start = sum.irradiance;
    lit({Light::Kind::solved, std::move(sum)});
  }
  if (start.is_quick_wanted) {
    Solution quick = solved(options);
    options.start = quick.irradiance;
    lit({Light::Kind::quick, std::move(quick)});
  }
  options.tolerance = start.tolerance;
  Solution solution = solved(options);
  study::warn_of_unconverged(solution, options, {.warned = events.warned});
  options.start = solution.irradiance;
  lit({Light::Kind::solved, std::move(solution)});
  // Sums of lights know no shields.
  const bool is_separable = !mix.emitters.empty() && conditions.transmission.size() == 0;
  if (start.is_separation_wanted && is_separable) {
    events.separated(separate(model, mix, scene, conditions, start.tolerance, progress));
  }
  options.estimates_errors = true;
  Solution complete = solved(options);
  const auto discretisation =
      radiosity::discretisation_error(*model.mesh, *model.transport, complete, progress);
  Light light{Light::Kind::complete,
              with_discretisation_error(std::move(complete), discretisation)};
  if (study::is_size_unknown(discretisation)) {
    study::warn_of_unknown_size(discretisation, light.solution, {.warned = events.warned});
  } else {
    light.relative_error = relative_error(*model.mesh, light.solution);
  }
  set_temperatures(*model.mesh, conditions, light.solution, events);
  lit(std::move(light));
}

}  // namespace viewer
