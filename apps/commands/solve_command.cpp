#include "apps/commands/solve_command.h"

#include <CLI/App.hpp>
#include <algorithm>

#include "apps/run/picture_check.h"
#include "apps/run/picture_output.h"
#include "apps/run/scene_input.h"
#include "apps/run/shown_events.h"
#include "apps/summary/summary.h"
#include "apps/terminal/output_files.h"
#include "io/result/result_file.h"
#include "radiosity/base/parallel.h"

namespace apps {
namespace {

using radiosity::Method;
using radiosity::Quantity;

std::vector<std::string> method_names() {
  std::vector<std::string> names;
  for (const Method method : radiosity::all_methods())
    names.emplace_back(radiosity::method_name(method));
  return names;
}

}  // namespace

SolveCommand::SolveCommand(CLI::App& program, Interruption& interruption)
    : interruption_(interruption) {
  CLI::App* command =
      program.add_subcommand("solve", "Compute the radiosity of a scene and write it to files");
  add_common_options(*command, common_);
  command
      ->add_option(
          "-o,--output", common_.outputs,
          "Result file, by extension: .vtp (ParaView), .csv, .ply, .png or .exr (picture); "
          "may be repeated")
      ->check([](const std::string& path) { return check_extension(path, result_extensions()); })
      ->type_name("FILE")
      ->allow_extra_args(false);
  command
      ->add_option_function<std::string>(
          "--method",
          [this](const std::string& name) { compute_.method = *radiosity::method_named(name); },
          "Iteration; cg (conjugate gradients) is the fastest")
      ->check(CLI::IsMember(method_names()))
      ->default_str(std::string(radiosity::method_name(compute_.method)))
      ->type_name("M");
  add_compute_options(*command, compute_);
  add_transport_option(*command, compute_);
  add_adaptive_option(*command, compute_);
  add_quantity_options(*command, quantities_);
  add_picture_options(*command, picture_);
  command->callback([this] { run(); });
}

void SolveCommand::run() const {
  check_outputs(common_.outputs, common_.scene);
  check_false_color(picture_.false_color);
  TerminalProgress terminal(terminal_style(common_));
  const radiosity::ThreadLimit threads(common_.n_threads);
  study::StudyEvents events = shown_events(terminal, interruption_);
  const std::vector<Quantity> quantities = chosen_quantities(quantities_);
  events.divided = [&](const radiosity::Scene& scene, const study::Patches& patches) {
    check_all(scene, patches, quantities, terminal);
  };
  const study::Study solved = study::run(read_checked_scene(common_, events), compute_, events);
  io::ResultOptions options = {.wavelengths = solved.scene.bands.wavelengths,
                               .quantities = {},
                               .camera = solved.scene.camera};
  for (const Quantity quantity : quantities) {
    options.quantities.push_back(radiosity::make_field(quantity, solved.mesh, solved.solution,
                                                       solved.scene.bands,
                                                       picture_.photometry.efficacy_or_default()));
  }
  SolveSummary summary = {.solved = solved, .outputs = common_.outputs};
  for (const auto& field : options.quantities) {
    summary.quantities.push_back(radiosity::summarize(field, solved.mesh));
  }
  for (const std::string& output : common_.outputs) {
    if (is_picture(output)) {
      summary.false_color = write_picture(output, solved, picture_, events.progress, interruption_);
    } else {
      const auto lock = interruption_.hold();
      io::write(output, solved.mesh, solved.solution, options);
    }
    events.progress.check();
  }
  print_summary(summary, common_, terminal);
}

void SolveCommand::check_all(const radiosity::Scene& scene, const study::Patches& patches,
                             std::vector<Quantity> quantities, TerminalProgress& terminal) const {
  if (std::any_of(common_.outputs.begin(), common_.outputs.end(), is_picture)) {
    check_picture(scene, patches, picture_, terminal);
    const auto shown = shown_quantities(picture_.false_color);
    quantities.insert(quantities.end(), shown.begin(), shown.end());
  }
  check_photometry(scene, quantities, picture_.photometry, terminal);
}

}  // namespace apps
