#include "apps/commands/light_command.h"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "apps/report/light_report.h"
#include "apps/run/assembled_scene.h"
#include "apps/run/shown_events.h"
#include "apps/summary/summary.h"
#include "apps/terminal/machine.h"
#include "apps/terminal/output_files.h"
#include "io/base/atomic_file.h"
#include "io/picture/grid_chart.h"
#include "io/picture/grid_picture.h"
#include "io/result/grid_csv.h"
#include "io/result/grid_vtp.h"
#include "radiosity/base/error.h"
#include "radiosity/base/parallel.h"
#include "radiosity/version.h"
#include "study/measured_plan.h"
#include "study/requirement_check.h"

namespace apps {
namespace {

namespace fs = std::filesystem;
using radiosity::LightPlan;

/// Names of the grids' files, without extension: letters, digits, - and _ of their own, no two the
/// same whatever the case, and not the report's.
std::vector<std::string> file_stems(const LightPlan& plan) {
  std::vector<std::string> stems;
  std::vector<std::string> taken = {"report"};
  for (const radiosity::GridPlan& grid : plan.grids) {
    std::string stem;
    for (const char c : grid.name) {
      const bool is_plain =
          std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_';
      stem += is_plain ? c : '-';
    }
    const auto lower = [](std::string text) {
      for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      return text;
    };
    const std::string base = stem;
    for (int k = 2; std::find(taken.begin(), taken.end(), lower(stem)) != taken.end(); ++k) {
      stem = fmt::format("{}-{}", base, k);
    }
    taken.push_back(lower(stem));
    stems.push_back(stem);
  }
  return stems;
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error && !fs::is_directory(folder)) {
    throw radiosity::OutputError(
        fmt::format("{}: the folder cannot be made: {}", folder.string(), error.message()));
  }
}

void write_page(const fs::path& path, const std::string& text) {
  io::write_stream_atomically(path, [&](std::ofstream& stream) { stream << text; });
}

}  // namespace

LightCommand::LightCommand(CLI::App& program, Interruption& interruption)
    : interruption_(interruption) {
  CLI::App* command = program.add_subcommand(
      "light",
      "Measure illuminance on grids and at points, and glare, and write a report on the lighting");
  add_common_options(*command, common_);
  command
      ->add_option("-o,--output", folder_,
                   "Folder for report.html, report.json and, of each grid, a .csv, .vtp, .svg and "
                   ".png; made if it is not there")
      ->type_name("DIR");
  add_light_options(*command, light_);
  add_photometry_options(*command, photometry_);
  add_compute_options(*command, compute_);
  add_transport_option(*command, compute_);
  add_adaptive_option(*command, compute_);
  add_operator_option(*command, operator_);
  command->callback([this] { run(); });
}

std::vector<std::string> LightCommand::outputs(const LightPlan& plan) const {
  if (folder_.empty()) return {};
  const fs::path folder = folder_;
  std::vector<std::string> files = {folder / "report.html", folder / "report.json"};
  const std::vector<std::string> stems = file_stems(plan);
  for (std::size_t k = 0; k < stems.size(); ++k) {
    for (const char* extension : {".csv", ".vtp"}) files.push_back(folder / (stems[k] + extension));
    if (plan.grids[k].is_list()) continue;
    for (const char* extension : {".svg", ".png"}) files.push_back(folder / (stems[k] + extension));
  }
  return files;
}

void LightCommand::write(const LightSummary& summary, const TerminalProgress& terminal) const {
  if (folder_.empty()) return;
  const fs::path folder = folder_;
  LightPlan plan;
  for (const auto& grid : summary.measured.grids) plan.grids.push_back(grid.plan);
  const std::vector<std::string> stems = file_stems(plan);
  const auto lock = interruption_.hold();
  for (std::size_t k = 0; k < stems.size(); ++k) {
    const study::MeasuredPlanGrid& grid = summary.measured.grids[k];
    io::write_grid_csv(folder / (stems[k] + ".csv"), grid.light);
    io::write_grid_vtp(folder / (stems[k] + ".vtp"), grid.light);
    if (!grid.light.where.grid) continue;
    const io::GridChart chart = grid_chart(summary.measured, grid, grid.light.quantities.front());
    write_page(folder / (stems[k] + ".svg"), io::grid_svg(chart));
    io::write_grid_picture(folder / (stems[k] + ".png"), chart);
  }
  const LightReport report{.summary = summary,
                           .warnings = terminal.warnings(),
                           .version = std::string(radiosity::kVersion),
                           .machine = machine_text(),
                           .date = time_text()};
  write_page(folder / "report.json", light_json(summary, terminal.warnings()) + '\n');
  write_page(folder / "report.html", light_report_html(report));
}

void LightCommand::run() const {
  keep_freed_memory();
  TerminalProgress terminal(terminal_style(common_));
  const radiosity::ThreadLimit threads(common_.n_threads);
  study::StudyEvents events = shown_events(terminal, interruption_);
  if (!folder_.empty()) make_folder(folder_);
  LightPlan plan;
  std::vector<std::string> files;
  events.divided = [&](const radiosity::Scene& scene, const study::Patches& patches) {
    check_photometry(scene, {radiosity::Quantity::illuminance}, photometry_, terminal);
    plan = light_plan(scene, light_);
    for (const radiosity::GridPlan& grid : plan.grids) {
      (void)radiosity::make_measuring_points(grid, patches.mesh);
    }
    files = outputs(plan);
    check_outputs(files, common_.scene);
    check_against_inputs(files, scene.files);
    std::vector<fs::path> inputs(light_.points.begin(), light_.points.end());
    if (operator_) inputs.emplace_back(*operator_);
    check_against_inputs(files, inputs);
  };
  const study::Study solved =
      study::with_light(assemble_scene(common_, compute_, operator_, events), compute_, events);
  const double efficacy = photometry_.efficacy_or_default();
  const study::MeasuredPlan measured =
      study::measure_plan(solved, plan, compute_, efficacy, events);
  const LightSummary summary{.solved = solved,
                             .measured = measured,
                             .checks = study::requirement_checks(measured),
                             .outputs = files,
                             .efficacy = efficacy};
  write(summary, terminal);
  print(common_.json ? light_json(summary, terminal.warnings()) : light_text(summary));
}

}  // namespace apps
