#pragma once

#include <functional>
#include <memory>
#include <string>

#include "io/scene/read_options.h"
#include "radiosity/base/progress.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solve/solution.h"
#include "study/study_options.h"
#include "viewer/work/light_mix.h"
#include "viewer/work/model.h"

namespace viewer {

/// What the pipeline from a file to its form factors tells on its way, on its own thread.
struct PipelineEvents {
  std::function<void(Model)> opened;                                        ///< patches are there
  std::function<void(radiosity::Solution, double unshot_share)> previewed;  ///< every 0.1 s or so
  std::function<void(Model)> assembled;  ///< with form factors, of refined patches perhaps
  std::function<void(radiosity::Solution)> stored;  ///< a result file had light
  std::function<void(const std::string&)> warned;
};

/// Whether a file holds a result of ours (.vtp, .h5), not a scene.
bool is_result_file(const std::string& path);

/// Reads a result file. Throws SceneError.
void open_result(const std::string& path, const PipelineEvents& events);

/// Reads a scene file. Throws SceneError, also if there are no polygons.
radiosity::Scene read_whole_scene(const std::string& path, const io::ReadOptions& options,
                                  const PipelineEvents& events,
                                  const radiosity::Progress& progress);

/// Divides the scene, previews its light by progressive shooting for some seconds, and computes the
/// form factors. `mix` is what the preview shows. A scene whose form factors will not fit into
/// memory is opened as it is before SolveError tells so. Throws MeshError, SolveError, Interrupted.
void run_pipeline(const std::string& path, std::shared_ptr<const radiosity::Scene> scene,
                  const LightMix& mix, const study::StudyOptions& options,
                  const PipelineEvents& events, const radiosity::Progress& progress);

/// Exitance of the mix on the patches, W/m², n x b.
Eigen::MatrixXd mix_exitance(const radiosity::Scene& scene, const radiosity::PatchMesh& mesh,
                             const LightMix& mix);

/// What solving a mix tells on its way.
struct LightEvents {
  std::function<void(Light)> lit;                ///< each time the light is better known
  std::function<void(EmitterLights)> separated;  ///< each emitter alone
  std::function<void(const std::string&)> warned;
};

/// What is known already, and what is wanted.
struct LightStart {
  Eigen::MatrixXd irradiance;        ///< to start from, n x b; empty: darkness
  double tolerance = 1e-8;           ///< of the iteration
  bool is_quick_wanted = false;      ///< first to the accuracy of a picture
  bool is_separation_wanted = true;  ///< find each emitter's light, too
};

/// Solves the model for a mix: the light, each emitter's light, then the errors. Throws SolveError,
/// Interrupted.
void solve_light(const Model& model, const LightMix& mix, const LightStart& start,
                 const LightEvents& events, const radiosity::Progress& progress);

}  // namespace viewer
