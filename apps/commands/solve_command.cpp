#include "apps/commands/solve_command.h"

#include <CLI/App.hpp>
#include <algorithm>
#include <filesystem>
#include <utility>

#include "apps/run/assembled_scene.h"
#include "apps/run/lightmap_output.h"
#include "apps/run/picture_check.h"
#include "apps/run/picture_output.h"
#include "apps/run/piece_output.h"
#include "apps/run/rank_memory.h"
#include "apps/run/shown_events.h"
#include "apps/summary/json_summary.h"
#include "apps/summary/summary.h"
#include "apps/summary/text_summary.h"
#include "apps/terminal/machine.h"
#include "apps/terminal/output_files.h"
#include "io/result/result_file.h"
#include "io/result/scenario_csv.h"
#include "io/scene/scenario_file.h"
#include "radiosity/base/error.h"
#include "radiosity/base/parallel.h"
#include "radiosity/picture/light_atlas.h"
#include "study/scenarios.h"

namespace apps {
namespace {

using radiosity::Method;
using radiosity::Quantity;
using radiosity::Scenario;

std::vector<std::string> method_names() {
  std::vector<std::string> names;
  for (const Method method : radiosity::all_methods())
    names.emplace_back(radiosity::method_name(method));
  return names;
}

}  // namespace

SolveCommand::SolveCommand(CLI::App& program, Interruption& interruption, radiosity::Ranks* ranks,
                           MakeSolver make_ksp)
    : interruption_(interruption), ranks_(ranks), make_ksp_(std::move(make_ksp)) {
  CLI::App* command =
      program.add_subcommand("solve", "Compute the radiosity of a scene and write it to files");
  add_common_options(*command, common_);
  std::vector<std::string> extensions = result_extensions();
  if (ranks != nullptr) extensions.emplace_back(".pvtp");
  command
      ->add_option(
          "-o,--output", common_.outputs,
          std::string("Result file, by extension: .vtp (ParaView), .csv, .ply or .glb (coloured "
                      "mesh), .png or .exr (picture), or .h5 (form factors, for --operator); may "
                      "be repeated") +
              (ranks != nullptr ? "; .pvtp has a .vtp of each rank" : ""))
      ->check([extensions](const std::string& path) { return check_extension(path, extensions); })
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
  if (make_ksp_) {
    command
        ->add_option("--ksp", ksp_,
                     "Solve by PETSc with these options of its own, such as \"-ksp_type gmres "
                     "-ksp_rtol 1e-10 -ksp_monitor\"")
        ->type_name("OPTIONS")
        ->excludes("--method");
  }
  add_assembly_options(*command, compute_, operator_);
  add_heat_options(*command, common_.heat);
  auto* verify = command->add_flag(
      "--verify", compute_.verifies_light,
      "Check what compressed form factors of a file are off by for this light, by exact rows");
  verify->needs("--operator");
  auto* scenarios =
      command
          ->add_option("--scenarios", scenarios_,
                       "Solve for each of the lights and reflectances that this file lists (.json) "
                       "instead of the scene's own; -o then writes a file for each")
          ->excludes(verify)
          ->type_name("FILE");
  command
      ->add_option(
          "--table", table_,
          "With --scenarios: means of irradiance and radiosity, and of each --quantity, by "
          "scenario and surface (.csv)")
      ->check([](const std::string& path) { return check_extension(path, {".csv"}); })
      ->type_name("FILE")
      ->needs(scenarios);
  add_quantity_options(*command, quantities_);
  add_picture_options(*command, picture_);
  add_lightmap_options(*command, lightmap_);
  command->get_option("--atlas")->excludes(scenarios);
  command->callback([this] { run(); });
}

void SolveCommand::run() const {
  keep_freed_memory();
  const std::vector<Scenario> scenarios =
      scenarios_ ? io::read_scenarios(*scenarios_) : std::vector<Scenario>();
  CommonOptions common = common_;
  common.outputs = all_outputs(scenarios);
  on_first_rank(ranks_, [&] { check_outputs(common.outputs, common_.scene); });
  if (scenarios_) check_against_inputs(common.outputs, {*scenarios_});
  check_false_color(picture_.false_color);
  check_lightmap(lightmap_, common_.outputs);
  TerminalProgress terminal(terminal_style(common_));
  const radiosity::ThreadLimit threads(common_.n_threads);
  study::StudyEvents events = shown_events(terminal, interruption_);
  const std::vector<Quantity> quantities = chosen_quantities(quantities_);
  const study::StudyOptions compute = shared_options();
  events.divided = [&](const radiosity::Scene& scene, const study::Patches& patches) {
    check_all(scene, patches, quantities, terminal);
    if (ranks_ == nullptr || common_.quiet) return;
    const radiosity::Index n = patches.mesh.size();
    tell_memory(n,
                chosen_kind(study::transport_choice(scene, compute), n,
                            study::factor_tolerance(compute), compute.memory),
                *ranks_);
  };
  study::Study assembled = assemble_scene(common, compute, operator_, events);
  for (const std::string& output : common_.outputs) {
    if (is_factor_file(output)) write_operator(output, assembled, events.progress);
  }
  if (scenarios_) return solve_all(std::move(assembled), scenarios, events, terminal);
  const study::Study solved = study::with_light(std::move(assembled), compute, events);
  const io::ResultOptions options = {.bands = solved.scene.bands,
                                     .quantities = fields(solved, quantities),
                                     .camera = solved.scene.camera};
  SolveSummary summary = {.solved = solved, .outputs = common.outputs, .operator_file = operator_};
  for (const auto& field : options.quantities) {
    summary.quantities.push_back(radiosity::summarize(field, solved.mesh));
  }
  summary.false_color = write_results(solved, common_.outputs, options, events.progress);
  if (!is_first(ranks_)) return;
  print_summary(summary, common_, terminal);
}

study::StudyOptions SolveCommand::shared_options() const {
  study::StudyOptions options = compute_;
  if (ranks_ == nullptr) return options;
  if (operator_ || std::any_of(common_.outputs.begin(), common_.outputs.end(), is_factor_file)) {
    throw radiosity::SolveError(
        "several ranks neither read nor write a file of form factors for 'solve': expected no "
        "--operator and no .h5 output; 'form-factors' writes one");
  }
  options.ranks = ranks_;
  if (ksp_) {
    options.method = Method::external;
    options.solver = make_ksp_(*ksp_);
  }
  options.memory = memory_of_rank(*ranks_, options.memory);
  return options;
}

std::vector<std::string> SolveCommand::all_outputs(const std::vector<Scenario>& scenarios) const {
  std::vector<std::string> outputs;
  if (scenarios.empty()) {
    outputs = common_.outputs;
    outputs.insert(outputs.end(), lightmap_.atlases.begin(), lightmap_.atlases.end());
    return outputs;
  }
  for (const std::string& output : common_.outputs) {
    if (is_factor_file(output)) outputs.push_back(output);
  }
  for (const Scenario& scenario : scenarios) {
    for (const std::string& output : outputs_of(scenario)) outputs.push_back(output);
  }
  if (table_) outputs.push_back(*table_);
  return outputs;
}

std::vector<std::string> SolveCommand::outputs_of(const Scenario& scenario) const {
  std::vector<std::string> outputs;
  for (const std::string& output : common_.outputs) {
    if (is_factor_file(output)) continue;
    std::filesystem::path path = output;
    const std::string extension = path.extension().string();
    path.replace_filename(path.stem().string() + "-" + scenario.name + extension);
    outputs.push_back(path.string());
  }
  return outputs;
}

std::vector<radiosity::QuantityField> SolveCommand::fields(
    const study::Study& solved, const std::vector<Quantity>& quantities) const {
  std::vector<radiosity::QuantityField> result;
  for (const Quantity quantity : quantities) {
    result.push_back(radiosity::make_field(quantity, solved.mesh, solved.solution,
                                           solved.scene.bands,
                                           picture_.photometry.efficacy_or_default()));
  }
  return result;
}

std::optional<ShownScale> SolveCommand::write_results(const study::Study& solved,
                                                      const std::vector<std::string>& outputs,
                                                      const io::ResultOptions& options,
                                                      const radiosity::Progress& progress) const {
  std::optional<ShownScale> shown;
  for (const std::string& output : outputs) {
    if (!is_in_pieces(output)) continue;
    const auto lock = interruption_.hold();
    write_in_pieces(output, *ranks_, solved.mesh, solved.solution, options);
  }
  if (!is_first(ranks_)) return shown;
  if (lightmap_.wanted) {
    write_lightmap(solved, outputs, lightmap_, picture_, progress, interruption_);
  }
  for (const std::string& output : outputs) {
    if (is_in_pieces(output) || (lightmap_.wanted && is_glb(output))) continue;
    if (is_picture(output)) {
      shown = write_picture(output, solved, picture_, progress, interruption_);
    } else if (!is_factor_file(output)) {
      const auto lock = interruption_.hold();
      io::write(output, solved.mesh, solved.solution, options);
    }
    progress.check();
  }
  return shown;
}

void SolveCommand::solve_all(study::Study assembled, const std::vector<Scenario>& scenarios,
                             const study::StudyEvents& events,
                             const TerminalProgress& terminal) const {
  const std::vector<Quantity> asked = chosen_quantities(quantities_);
  std::vector<Quantity> shown = {Quantity::irradiance, Quantity::radiosity};
  for (const Quantity quantity : asked) {
    if (std::find(shown.begin(), shown.end(), quantity) == shown.end()) shown.push_back(quantity);
  }
  std::vector<io::ScenarioRow> rows(scenarios.size());
  std::vector<radiosity::EnergyBalance> energies(scenarios.size());
  const auto visit = [&](std::size_t k, const study::Study& solved) {
    rows[k].name = scenarios[k].name;
    energies[k] = solved.solution.energy;
    for (const auto& field : fields(solved, shown)) {
      rows[k].quantities.push_back(radiosity::summarize(field, solved.mesh));
    }
    write_results(solved, outputs_of(scenarios[k]),
                  {.bands = solved.scene.bands,
                   .quantities = fields(solved, asked),
                   .camera = solved.scene.camera},
                  events.progress);
  };
  const study::Study study =
      study::solve_scenarios(std::move(assembled), scenarios, shared_options(), events, visit);
  if (!is_first(ranks_)) return;
  if (table_) {
    const auto lock = interruption_.hold();
    io::write_scenario_csv(*table_, rows);
  }
  const ScenarioSummary summary{study, std::move(rows), std::move(energies), all_outputs(scenarios),
                                operator_};
  print(common_.json ? scenarios_json(summary, terminal.warnings()) : scenarios_text(summary));
}

void SolveCommand::check_all(const radiosity::Scene& scene, const study::Patches& patches,
                             std::vector<Quantity> quantities, TerminalProgress& terminal) const {
  if (std::any_of(common_.outputs.begin(), common_.outputs.end(), is_picture)) {
    check_picture(scene, patches, picture_, terminal);
    const auto shown = shown_quantities(picture_.false_color);
    quantities.insert(quantities.end(), shown.begin(), shown.end());
  }
  check_photometry(scene, quantities, picture_.photometry, terminal);
  // Refuses more polygons than there is room for; patches made later have the same.
  if (lightmap_.wanted) (void)radiosity::make_light_atlas(patches.mesh, lightmap_.size);
}

}  // namespace apps
