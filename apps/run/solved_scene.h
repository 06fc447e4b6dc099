#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "apps/options/common_options.h"
#include "apps/terminal/interruption.h"
#include "apps/terminal/terminal_progress.h"
#include "meshing/adaptive/adaptive.h"
#include "radiosity/base/geometry.h"
#include "radiosity/base/progress.h"
#include "radiosity/operator/transport.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solve/discretisation_error.h"
#include "radiosity/solve/solution.h"
#include "radiosity/visibility/visibility.h"

namespace apps {

/// Throw SolveError if so many patches, of so many polygons, do not fit into memory.
struct MemoryChecks {
  using Check = std::function<void(radiosity::Index n_patches, radiosity::Index n_polygons)>;
  Check expected;  ///< asked before patches are made, with a number that will be reached
  Check made;      ///< asked when their number is known
};

/// A scene file's patches. Stays where it was made, since later stages may refer to earlier ones.
struct PatchedScene {
  /// Runs the stages; warnings go to `terminal`. Throws what the stages and the checks throw.
  PatchedScene(const CommonOptions& common, const ComputeOptions& compute,
               const MemoryChecks& checks, const radiosity::Progress& progress,
               TerminalProgress& terminal);
  /// The same from a scene that has been read.
  PatchedScene(radiosity::Scene read_scene, const ComputeOptions& compute,
               const MemoryChecks& checks, const radiosity::Progress& progress,
               TerminalProgress& terminal);
  PatchedScene(const PatchedScene&) = delete;
  PatchedScene& operator=(const PatchedScene&) = delete;

  radiosity::Scene scene;
  radiosity::PatchMesh mesh;
  radiosity::Visibility visibility;
};

/// What a command wants to know of the patches before the long work; throws if that would be in
/// vain.
using PatchCheck = std::function<void(const PatchedScene&)>;

/// The same with the form factors in memory. Throws SolveError before anything long if they do not
/// fit.
struct AssembledScene : PatchedScene {
  AssembledScene(const CommonOptions& common, const ComputeOptions& compute,
                 const radiosity::Progress& progress, TerminalProgress& terminal,
                 const PatchCheck& check = {});
  /// The same from a scene that has been read.
  AssembledScene(radiosity::Scene read_scene, const ComputeOptions& compute,
                 const radiosity::Progress& progress, TerminalProgress& terminal,
                 const PatchCheck& check = {});

  std::unique_ptr<radiosity::Transport> transport;
  std::optional<meshing::Refinement> refinement;  ///< with --adaptive
};

/// The whole pipeline from a scene file to its radiosity.
struct SolvedScene : AssembledScene {
  SolvedScene(const CommonOptions& common, const ComputeOptions& compute, radiosity::Method method,
              const radiosity::Progress& progress, TerminalProgress& terminal,
              const PatchCheck& check = {});

  radiosity::DiscretisationError discretisation;
  radiosity::Solution solution;  ///< its errors include `discretisation`
};

/// How progress is shown: not at all with --quiet, else as stderr allows.
TerminalProgress::Style terminal_style(const CommonOptions& common);

/// Reads the scene; what the reader noticed becomes warnings.
radiosity::Scene read_scene_warning(const CommonOptions& common,
                                    const radiosity::Progress& progress,
                                    TerminalProgress& terminal);

/// The same; throws SceneError if the scene has no polygons.
radiosity::Scene read_checked_scene(const CommonOptions& common,
                                    const radiosity::Progress& progress,
                                    TerminalProgress& terminal);

/// Serious flaws of the scene become warnings, unless it is too large to be searched.
void warn_of_findings(const radiosity::Scene& scene, TerminalProgress& terminal);

/// Warns if a scene taken as closed has patches that see an opening.
void warn_of_open_rows(const radiosity::AssemblyReport& report, TerminalProgress& terminal);

/// Progress that is shown by `terminal` and stopped by `interruption`.
radiosity::Progress shown_progress(TerminalProgress& terminal, const Interruption& interruption);

/// Renders the picture of a solved scene and writes it; returns the scale if it is in false
/// colours. The file is written under `interruption.hold()`. Throws SceneError if all of it is
/// empty, which `check_picture` finds out beforehand unless it is for lack of pixels.
std::optional<ShownScale> write_picture(const std::string& path, const SolvedScene& solved,
                                        const PictureOptions& options,
                                        const radiosity::Progress& progress,
                                        Interruption& interruption);

}  // namespace apps
