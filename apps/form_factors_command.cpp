#include "apps/form_factors_command.h"

#include "apps/factors_from.h"
#include "apps/json_summary.h"
#include "apps/output_files.h"
#include "apps/solved_scene.h"
#include "apps/summary.h"
#include "apps/text_summary.h"
#include "io/destinations_csv.h"
#include "io/extension.h"
#include "io/form_factor_file.h"
#include "io/surface_csv.h"
#include "radiosity/parallel.h"
#include "radiosity/surface_factors.h"

namespace apps {

FormFactorsCommand::FormFactorsCommand(CLI::App& program, Interruption& interruption)
    : interruption_(interruption) {
  compute_.tolerance = 1e-3;
  CLI::App* command = program.add_subcommand(
      "form-factors",
      "Compute the form factors (view factors) of a scene and write them to a file");
  add_common_options(*command, common_);
  command
      ->add_option("-o,--output", outputs_,
                   "Result file: .h5 (HDF5, every pair of patches) or .csv (between surfaces); may "
                   "be repeated")
      ->check(
          [](const std::string& path) { return check_extension(path, form_factor_extensions()); })
      ->type_name("FILE")
      ->allow_extra_args(false);
  auto* by = command->add_option("--by", by_, "Also print the table of factors between surfaces")
                 ->check(CLI::IsMember({"surface"}))
                 ->type_name("WHAT");
  command
      ->add_option("--from", from_,
                   "Only the factors from one surface, by its name, or from the point x,y,z with "
                   "normal nx,ny,nz (metres); shown, and written to a .csv if there is -o")
      ->type_name("NAME|x,y,z,nx,ny,nz")
      ->excludes(by);
  add_compute_options(*command, compute_);
  command->callback([this] { run(); });
}

void FormFactorsCommand::run() const {
  if (from_) return run_from(*from_);
  if (outputs_.empty()) throw CLI::RequiredError("--output");
  check_outputs(outputs_, common_.scene);
  TerminalProgress terminal(terminal_style(common_));
  const radiosity::ThreadLimit threads(common_.n_threads);
  const radiosity::Progress progress = shown_progress(terminal, interruption_);
  const AssembledScene assembled(common_, compute_, progress, terminal);
  const Eigen::MatrixXd by_surface =
      radiosity::surface_form_factors(assembled.mesh, *assembled.transport);
  for (const std::string& output : outputs_) {
    const auto lock = interruption_.hold();
    if (io::lower_case_extension(output) == ".h5") {
      io::write_form_factors(output, assembled.mesh, *assembled.transport,
                             {.tolerance = compute_.tolerance, .progress = progress});
    } else {
      io::write_surface_csv(output, assembled.mesh, by_surface);
    }
    progress.check();
  }
  const Eigen::MatrixXd shown = by_ == "surface" ? by_surface : Eigen::MatrixXd();
  print(common_.json ? form_factors_json(assembled, shown, outputs_, terminal.warnings())
                     : form_factors_text(assembled, shown, outputs_));
}

void FormFactorsCommand::run_from(const std::string& from) const {
  for (const std::string& output : outputs_) {
    const std::string refusal = check_extension(output, {".csv"});
    if (!refusal.empty()) throw CLI::ValidationError("--output with --from", refusal);
  }
  check_outputs(outputs_, common_.scene);
  TerminalProgress terminal(terminal_style(common_));
  const radiosity::ThreadLimit threads(common_.n_threads);
  const radiosity::Progress progress = shown_progress(terminal, interruption_);
  const FactorsFrom factors = compute_factors_from(from, common_, compute_, progress, terminal);
  for (const std::string& output : outputs_) {
    const auto lock = interruption_.hold();
    io::write_destinations_csv(output, factors.surface_names, factors.shares);
  }
  progress.check();
  print(common_.json ? factors_from_json(factors, outputs_, terminal.warnings())
                     : factors_from_text(factors, outputs_));
}

}  // namespace apps
