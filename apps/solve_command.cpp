#include "apps/solve_command.h"

#include <algorithm>
#include <array>

#include "apps/output_files.h"
#include "apps/solved_scene.h"
#include "apps/summary.h"
#include "io/result_file.h"
#include "radiosity/parallel.h"

namespace apps {
namespace {

using radiosity::Method;

constexpr std::array kMethods = {Method::conjugate_gradients, Method::jacobi, Method::gauss_seidel,
                                 Method::southwell, Method::chebyshev};

std::vector<std::string> method_names() {
  std::vector<std::string> names;
  for (const Method method : kMethods) names.emplace_back(radiosity::method_name(method));
  return names;
}

/// The method of a name that the command line has checked.
Method method_named(const std::string& name) {
  return *std::find_if(kMethods.begin(), kMethods.end(),
                       [&](Method method) { return radiosity::method_name(method) == name; });
}

}  // namespace

SolveCommand::SolveCommand(CLI::App& program, Interruption& interruption)
    : interruption_(interruption), method_(radiosity::method_name(Method::conjugate_gradients)) {
  CLI::App* command =
      program.add_subcommand("solve", "Compute the radiosity of a scene and write it to files");
  add_common_options(*command, common_);
  command
      ->add_option(
          "-o,--output", outputs_,
          "Result file, by extension: .vtp (ParaView), .csv, .ply, .png or .exr (picture); "
          "may be repeated")
      ->check([](const std::string& path) { return check_extension(path, result_extensions()); })
      ->type_name("FILE")
      ->allow_extra_args(false);
  command->add_option("--method", method_, "Iteration; cg (conjugate gradients) is the fastest")
      ->check(CLI::IsMember(method_names()))
      ->capture_default_str()
      ->type_name("M");
  add_compute_options(*command, compute_);
  add_quantity_options(*command, quantities_);
  add_photometry_options(*command, photometry_);
  add_picture_options(*command, picture_);
  command->callback([this] { run(); });
}

void SolveCommand::run() const {
  check_outputs(outputs_, common_.scene);
  TerminalProgress terminal(terminal_style(common_));
  const radiosity::ThreadLimit threads(common_.n_threads);
  const radiosity::Progress progress = shown_progress(terminal, interruption_);
  const std::vector<radiosity::Quantity> quantities = chosen_quantities(quantities_);
  const PatchCheck check = [&](const PatchedScene& patched) {
    check_photometry(patched.scene, quantities, photometry_, terminal);
  };
  const SolvedScene solved(common_, compute_, method_named(method_), progress, terminal, check);
  io::ResultOptions options = {.wavelengths = solved.scene.bands.wavelengths};
  for (const radiosity::Quantity quantity : quantities) {
    options.quantities.push_back(solved_field(solved, quantity, photometry_));
  }
  for (const std::string& output : outputs_) {
    if (is_picture(output)) {
      write_picture(output, solved, picture_, progress, terminal, interruption_);
    } else {
      const auto lock = interruption_.hold();
      io::write(output, solved.mesh, solved.solution, options);
    }
    progress.check();
  }
  print_summary(solved, outputs_, common_, terminal, options.quantities);
}

}  // namespace apps
