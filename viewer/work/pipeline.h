#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/scene/read_options.h"
#include "radiosity/base/progress.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solve/solution.h"
#include "study/study_options.h"
#include "viewer/work/light_mix.h"
#include "viewer/work/model.h"

namespace viewer {

/// A file that could be opened: nothing of it is missing but what takes long to compute.
struct OpenedFile {
  Model model;                      ///< with its patches
  std::optional<Light> light = {};  ///< of a result file
  std::vector<std::string> warnings = {};
  /// Why the scene cannot be solved, if so: too much for memory. Its patches are its polygons then.
  std::optional<std::string> refusal = {};
};

/// Whether a file holds a result of ours (.vtp, .h5), not a scene.
bool is_result_file(const std::string& path);

/// Reads a result file. Throws SceneError.
OpenedFile open_result(const std::string& path);

/// Reads a scene file. Throws SceneError, also if there are no polygons; Interrupted.
radiosity::Scene read_whole_scene(const std::string& path, const io::ReadOptions& options,
                                  const radiosity::Progress& progress);

/// Divides a scene that was read from `path`. Throws MeshError; SolveError if it does not even fit
/// into memory as it is; Interrupted.
OpenedFile open_scene(const std::string& path, std::shared_ptr<const radiosity::Scene> scene,
                      const study::StudyOptions& options, const radiosity::Progress& progress);

/// What making form factors tells on its way.
struct FormFactorEvents {
  std::function<void(const std::string&)> warned;
  /// Rougher ones, of the same patches, to go on with until they are made.
  std::function<void(std::shared_ptr<const radiosity::Transport>)> rough;
};

/// The model of a scene with its form factors, of refined patches perhaps. Throws MeshError,
/// SolveError, Interrupted.
Model with_form_factors(Model model, const study::StudyOptions& options,
                        const FormFactorEvents& events, const radiosity::Progress& progress);

/// The model with direct light of the mix's sun and sky, found anew if that is of others. Throws
/// Interrupted.
Model below_sky(Model model, const LightMix& mix, const radiosity::Progress& progress);

/// The mix's light by rough form factors, which must have a CompressionReport: a preview, to the
/// accuracy that a picture needs. `irradiance` as in LightStart. Throws Interrupted.
Light rough_light(const Model& model, const radiosity::Transport& rough, const LightMix& mix,
                  const Eigen::MatrixXd& irradiance, const radiosity::Progress& progress);

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
  /// Each emitter's light, whose sum shall be told first; or null.
  std::shared_ptr<const EmitterLights> separated = {};
};

/// Solves the model for a mix: the light, each emitter's light, then the errors. Throws SolveError,
/// Interrupted.
void solve_light(const Model& model, const LightMix& mix, const LightStart& start,
                 const LightEvents& events, const radiosity::Progress& progress);

}  // namespace viewer
