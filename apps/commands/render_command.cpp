#include "apps/commands/render_command.h"

#include <CLI/App.hpp>
#include "apps/run/assembled_scene.h"
#include "apps/run/picture_check.h"
#include "apps/run/picture_output.h"
#include "apps/run/shown_events.h"
#include "apps/summary/summary.h"
#include "apps/terminal/machine.h"
#include "apps/terminal/output_files.h"
#include "radiosity/base/parallel.h"

namespace apps {

RenderCommand::RenderCommand(CLI::App& program, Interruption& interruption)
    : interruption_(interruption) {
  CLI::App* command =
      program.add_subcommand("render", "Compute the radiosity of a scene and write a picture");
  add_common_options(*command, common_);
  command->add_option("-o,--output", output_, "Picture file, .png or .exr")
      ->required()
      ->check([](const std::string& path) { return check_extension(path, picture_extensions()); })
      ->type_name("FILE");
  add_assembly_options(*command, compute_, operator_);
  add_picture_options(*command, picture_);
  command->callback([this] { run(); });
}

void RenderCommand::run() const {
  keep_freed_memory();
  CommonOptions common = common_;
  common.outputs = {output_};
  check_outputs(common.outputs, common_.scene);
  check_false_color(picture_.false_color);
  TerminalProgress terminal(terminal_style(common_));
  const radiosity::ThreadLimit threads(common_.n_threads);
  study::StudyEvents events = shown_events(terminal, interruption_);
  events.divided = [&](const radiosity::Scene& scene, const study::Patches& patches) {
    check_picture(scene, patches, picture_, terminal);
    check_photometry(scene, shown_quantities(picture_.false_color), picture_.photometry, terminal);
  };
  const study::Study solved =
      study::with_light(assemble_scene(common, compute_, operator_, events), compute_, events);
  SolveSummary summary = {.solved = solved, .outputs = common.outputs, .operator_file = operator_};
  summary.false_color = write_picture(output_, solved, picture_, events.progress, interruption_);
  events.progress.check();
  print_summary(summary, common_, terminal);
}

}  // namespace apps
