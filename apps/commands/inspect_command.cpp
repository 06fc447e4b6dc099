#include "apps/commands/inspect_command.h"

#include <CLI/App.hpp>

#include "apps/commands/inspect_photometry.h"
#include "apps/options/camera_options.h"
#include "apps/run/scene_input.h"
#include "apps/run/shown_events.h"
#include "apps/summary/inspection_summary.h"
#include "apps/summary/json_summary.h"
#include "apps/summary/summary.h"
#include "apps/terminal/output_files.h"
#include "io/base/extension.h"
#include "io/light/photometric_file.h"
#include "io/scene/mitsuba_writer.h"
#include "io/scene/scene_file.h"
#include "io/scene/scene_writer.h"
#include "meshing/inspect/inspect.h"
#include "meshing/patches/patches.h"
#include "radiosity/base/error.h"
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
  CLI::App* command = program.add_subcommand(
      "inspect", "Show what a scene holds and what is wrong with it, or what a luminaire gives");
  add_common_options(*command, common_);
  command
      ->add_option(
          "-o,--output", common_.outputs,
          "Write the scene to this file: .json (own format, all in one) or .xml (for the "
          "path tracer Mitsuba 3, with a .ply beside it for each surface); of a luminaire (.ies, "
          ".ldt) .svg or .png, its polar curve; may be repeated")
      ->check([](const std::string& path) {
        return check_extension(path, {".json", ".xml", ".svg", ".png"});
      })
      ->type_name("FILE")
      ->allow_extra_args(false);
  command->add_flag("--ugr-table", has_ugr_table_,
                    "Of a luminaire: also its UGR in the rooms of CIE 117, by radiosity");
  command->callback([this] { run(); });
}

std::vector<std::string> InspectCommand::write(const radiosity::Scene& scene,
                                               const radiosity::Progress& progress) const {
  std::vector<std::string> written;
  for (const std::string& output : common_.outputs) {
    if (io::lower_case_extension(output) != ".xml") {
      const auto lock = interruption_.hold();
      io::write_scene(output, scene);
      written.push_back(output);
      continue;
    }
    const radiosity::PatchMesh mesh = meshing::make_patches(scene, {.progress = progress});
    std::vector<std::string> files = {output};
    for (const auto& file : io::mitsuba_meshes(output, mesh)) files.push_back(file.string());
    check_outputs(files, common_.scene);
    check_against_inputs(files, scene.files);
    const auto lock = interruption_.hold();
    io::write_mitsuba(output, scene, mesh, choose_camera(scene, mesh, {}).camera);
    written.insert(written.end(), files.begin(), files.end());
  }
  return written;
}

void InspectCommand::run() const {
  if (io::is_photometric_file(common_.scene)) {
    inspect_photometry(common_, has_ugr_table_ ? WantsUgr::yes : WantsUgr::no, interruption_);
    return;
  }
  if (has_ugr_table_) {
    throw radiosity::SceneError(common_.scene +
                                ": is a scene; --ugr-table is for a luminaire, .ies or .ldt");
  }
  for (const std::string& output : common_.outputs) {
    const std::string extension = io::lower_case_extension(output);
    if (extension == ".svg" || extension == ".png") {
      throw radiosity::OutputError(output + ": " + extension +
                                   " is for the polar curve of a luminaire, .ies or .ldt");
    }
  }
  check_outputs(common_.outputs, common_.scene);
  TerminalProgress terminal(terminal_style(common_));
  const radiosity::ThreadLimit threads(common_.n_threads);
  const study::StudyEvents events = shown_events(terminal, interruption_);
  const radiosity::Scene scene = read_scene_warning(common_, events);
  meshing::Inspection inspection = meshing::inspect(scene);
  inspection.closed = scene.closed ? *scene.closed : encloses(scene, events.progress);
  events.progress.check();
  const std::vector<std::string> written = write(scene, events.progress);
  print(common_.json ? inspect_json(scene, inspection, written, terminal.warnings())
                     : inspect_text(scene, inspection, written));
}

}  // namespace apps
