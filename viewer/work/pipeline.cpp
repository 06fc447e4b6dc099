#include "viewer/work/pipeline.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
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
#include "radiosity/picture/shooting_preview.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/solve/discretisation_error.h"
#include "radiosity/solve/solution.h"
#include "radiosity/solve/solve.h"
#include "radiosity/visibility/visibility.h"
#include "study/study.h"
#include "study/warnings.h"

namespace viewer {
namespace {

using radiosity::Index;
using radiosity::PatchMesh;
using radiosity::Progress;
using radiosity::Scene;
using radiosity::Solution;
using radiosity::Transport;

constexpr double kPreviewSeconds = 3;
constexpr double kPreviewInterval = 0.08;  // s
constexpr double kLittleUnshot = 0.01;     // share of the emitted power at which a preview ends

constexpr double kQuickTolerance = 1e-3;  // no pixel shows it

/// Bytes that a polygon takes in the window at most, with its share of the ray tracer's tree.
constexpr std::size_t kShownBytes = 2000;

/// Radiosity before any iteration as a solution, to be shown.
Solution preview_solution(Eigen::MatrixXd radiosity, const Eigen::MatrixXd& exitance,
                          const Eigen::MatrixXd& reflectance) {
  Solution solution;
  // H = (B - M) / ρ; where nothing is reflected it is not known.
  solution.irradiance = (reflectance.array() > 0)
                            .select((radiosity - exitance).array() / reflectance.array(), 0)
                            .matrix();
  solution.radiosity = std::move(radiosity);
  solution.exitance = exitance;
  solution.reflectance = reflectance;
  solution.radiosity_error = Eigen::MatrixXd::Zero(exitance.rows(), exitance.cols());
  return solution;
}

void preview(const Model& model, const LightMix& mix, const PipelineEvents& events,
             const Progress& progress) {
  const Scene scene = with_reflectance(*model.scene, mix);
  const Eigen::MatrixXd emitted = mix_exitance(scene, *model.mesh, mix);
  if (emitted.isZero(0)) return;
  const Eigen::MatrixXd reflectance = radiosity::reflectance(scene, *model.mesh);
  radiosity::ShootingPreview shooting(*model.mesh, *model.visibility, emitted, reflectance);
  const auto start = std::chrono::steady_clock::now();
  double seconds = 0;
  while (seconds < kPreviewSeconds && shooting.unshot_share() > kLittleUnshot) {
    shooting.shoot(kPreviewInterval, progress);
    events.previewed(preview_solution(shooting.with_ambient(), emitted, reflectance),
                     shooting.unshot_share());
    seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    progress.check();
    if (progress.report) progress.report("preview", seconds, kPreviewSeconds, "s");
  }
}

Model with_patches(Model model, study::Patches patches) {
  model.mesh = std::make_shared<PatchMesh>(std::move(patches.mesh));
  model.visibility = std::make_shared<radiosity::Visibility>(std::move(patches.visibility));
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

/// The model with its patches, to be solved. One that is too large for that is opened all the same.
Model divided(const Model& model, const study::StudyOptions& options, const PipelineEvents& events,
              const study::StudyEvents& studying) {
  try {
    return with_patches(model, study::divide(*model.scene, options, studying));
  } catch (const radiosity::SolveError&) {
    auto polygons = polygons_as_patches(*model.scene, studying.progress);
    if (polygons) events.opened(with_patches(model, *std::move(polygons)));
    throw;
  }
}

radiosity::SolveOptions solve_options(double tolerance, const Progress& progress) {
  radiosity::SolveOptions options;
  options.tolerance = tolerance;
  options.estimates_errors = false;
  options.progress = progress;
  return options;
}

EmitterLights separate(const Model& model, const LightMix& mix, const Scene& scene,
                       const Eigen::MatrixXd& reflectance, double tolerance,
                       const Progress& progress) {
  EmitterLights lights;
  lights.reflectance = reflectance;
  const Index n_bands = reflectance.cols();
  const auto n_emitters = static_cast<Index>(mix.emitters.size());
  const Eigen::MatrixXd full = radiosity::exitance(scene, *model.mesh);
  Eigen::MatrixXd all(reflectance.rows(), n_emitters * n_bands);
  for (Index e = 0; e < n_emitters; ++e) {
    lights.exitance.push_back(emitter_exitance(*model.mesh, full, mix.emitters[e]));
    all.middleCols(e * n_bands, n_bands) = lights.exitance.back();
  }
  const Solution solution =
      solve(*model.transport, all, reflectance, solve_options(tolerance, progress));
  for (Index e = 0; e < n_emitters; ++e) {
    lights.irradiance.emplace_back(solution.irradiance.middleCols(e * n_bands, n_bands));
  }
  return lights;
}

}  // namespace

bool is_result_file(const std::string& path) {
  const std::string extension = io::lower_case_extension(path);
  return extension == ".vtp" || extension == ".h5";
}

void open_result(const std::string& path, const PipelineEvents& events) {
  Model model;
  model.path = path;
  std::optional<Solution> solution;
  if (io::lower_case_extension(path) == ".vtp") {
    io::StoredResult result = io::read_result(path);
    for (const std::string& warning : result.warnings) events.warned(warning);
    model.mesh = std::make_shared<PatchMesh>(std::move(result.mesh));
    model.bands = result.bands;
    solution = std::move(result.solution);
  } else if (io::is_compressed_operator(path)) {
    io::StoredOperator stored = io::read_operator(path);
    model.mesh = std::make_shared<PatchMesh>(std::move(stored.mesh));
    model.bands.kind = radiosity::Bands::Kind::grey;
    const std::shared_ptr<const Transport> transport = std::move(stored.transport);
    model.factors = {transport, transport->rows()};
  } else {
    auto reader = std::make_shared<io::FormFactorReader>(path);
    for (const std::string& warning : reader->warnings()) events.warned(warning);
    model.mesh = std::make_shared<PatchMesh>(reader->mesh());
    model.bands.kind = radiosity::Bands::Kind::grey;
    model.factors = reader;
  }
  model.visibility = std::make_shared<radiosity::Visibility>(*model.mesh);
  events.opened(std::move(model));
  if (solution) events.stored(*std::move(solution));
}

Scene read_whole_scene(const std::string& path, const io::ReadOptions& options,
                       const PipelineEvents& events, const Progress& progress) {
  io::ReadOptions reading = options;
  reading.progress = progress;
  Scene scene = io::read_scene(path, reading);
  if (scene.n_polygons() == 0) throw radiosity::SceneError(path + ": the scene has no polygons");
  for (const std::string& warning : scene.warnings) events.warned(warning);
  return scene;
}

void run_pipeline(const std::string& path, std::shared_ptr<const Scene> scene, const LightMix& mix,
                  const study::StudyOptions& options, const PipelineEvents& events,
                  const Progress& progress) {
  const study::StudyEvents studying = {.warned = events.warned, .progress = progress};
  Model model;
  model.path = path;
  model.scene = std::move(scene);
  model.bands = model.scene->bands;
  model = divided(model, options, events, studying);
  events.opened(model);
  preview(model, mix, events, progress);
  study::FormFactors factors =
      study::make_form_factors(*model.scene, *model.mesh, *model.visibility, options, studying);
  if (factors.refined) model = with_patches(model, *std::move(factors.refined));
  model.transport = std::move(factors.transport);
  model.factors = {model.transport, model.transport->rows()};
  events.assembled(std::move(model));
}

Eigen::MatrixXd mix_exitance(const Scene& scene, const PatchMesh& mesh, const LightMix& mix) {
  const Eigen::MatrixXd full = radiosity::exitance(scene, mesh);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(full.rows(), full.cols());
  for (const Emitter& emitter : mix.emitters) {
    if (emitter.factor() > 0) result += emitter.factor() * emitter_exitance(mesh, full, emitter);
  }
  return result;
}

void solve_light(const Model& model, const LightMix& mix, const LightStart& start,
                 const LightEvents& events, const Progress& progress) {
  const Scene scene = with_reflectance(*model.scene, mix);
  const Eigen::MatrixXd reflectance = radiosity::reflectance(scene, *model.mesh);
  const Eigen::MatrixXd emitted = mix_exitance(scene, *model.mesh, mix);
  radiosity::SolveOptions options = solve_options(kQuickTolerance, progress);
  options.start = start.irradiance;
  if (start.is_quick_wanted) {
    Solution quick = solve(*model.transport, emitted, reflectance, options);
    options.start = quick.irradiance;
    events.lit({Light::Kind::quick, std::move(quick)});
  }
  options.tolerance = start.tolerance;
  Solution solution = solve(*model.transport, emitted, reflectance, options);
  study::warn_of_unconverged(solution, options, {.warned = events.warned});
  options.start = solution.irradiance;
  events.lit({Light::Kind::solved, std::move(solution)});
  if (start.is_separation_wanted && !mix.emitters.empty()) {
    events.separated(separate(model, mix, scene, reflectance, start.tolerance, progress));
  }
  options.estimates_errors = true;
  Solution complete = solve(*model.transport, emitted, reflectance, options);
  const auto discretisation =
      radiosity::discretisation_error(*model.mesh, *model.transport, complete, progress);
  events.lit({Light::Kind::complete,
              radiosity::with_discretisation_error(std::move(complete), discretisation)});
}

}  // namespace viewer
