#include "apps/commands/inspect_command.h"

#include <CLI/App.hpp>

#include "apps/run/scene_input.h"
#include "apps/run/shown_events.h"
#include "apps/summary/json_summary.h"
#include "apps/summary/summary.h"
#include "apps/summary/text_summary.h"
#include "io/scene/scene_file.h"
#include "meshing/inspect/inspect.h"
#include "meshing/patches/patches.h"
#include "radiosity/base/parallel.h"
#include "radiosity/exchange/openings.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/visibility.h"
#include "study/study_options.h"

namespace apps {
namespace {

/// As the other commands find out, whose form factors would take longer: edges do not tell, for
/// polygons may close a room without sharing them, and share them without closing one.
bool encloses(const radiosity::Scene& scene, const radiosity::Progress& progress) {
  const radiosity::PatchMesh mesh = meshing::make_patches(scene, {.progress = progress});
  const radiosity::Visibility visibility(mesh);
  const study::StudyOptions defaults;
  return radiosity::is_enclosed(mesh, visibility, defaults.tolerance, defaults.seed);
}

}  // namespace

InspectCommand::InspectCommand(CLI::App& program, Interruption& interruption)
    : interruption_(interruption) {
  CLI::App* command =
      program.add_subcommand("inspect", "Show what a scene holds and what is wrong with it");
  add_common_options(*command, common_);
  command->callback([this] { run(); });
}

void InspectCommand::run() const {
  TerminalProgress terminal(terminal_style(common_));
  const radiosity::ThreadLimit threads(common_.n_threads);
  const study::StudyEvents events = shown_events(terminal, interruption_);
  const radiosity::Scene scene = read_scene_warning(common_, events);
  meshing::Inspection inspection = meshing::inspect(scene);
  inspection.closed = scene.closed ? *scene.closed : encloses(scene, events.progress);
  events.progress.check();
  print(common_.json ? inspect_json(scene, inspection, terminal.warnings())
                     : inspect_text(scene, inspection));
}

}  // namespace apps
