#include "apps/commands/validate_command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/App.hpp>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <thread>

#include "apps/run/shown_events.h"
#include "apps/summary/summary.h"
#include "apps/terminal/machine.h"
#include "apps/terminal/output_files.h"
#include "apps/terminal/program_data.h"
#include "apps/validation/cases/cases.h"
#include "io/base/atomic_file.h"
#include "radiosity/base/error.h"
#include "radiosity/base/parallel.h"
#include "radiosity/version.h"

namespace apps {
namespace {

namespace fs = std::filesystem;
using Status = validation::CaseOutcome::Status;

std::vector<std::string> case_names() {
  std::vector<std::string> names;
  for (const validation::Case& known : validation::all_cases()) names.push_back(known.name);
  return names;
}

std::string check_case(const std::string& name) {
  if (validation::find_case(name) != nullptr) return "";
  return fmt::format("found '{}', expected one of {}", name, fmt::join(case_names(), ", "));
}

/// Makes the folder if need be, and finds out before the long work whether it can be written to.
void prepare_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error && !fs::is_directory(folder)) {
    throw radiosity::OutputError(
        fmt::format("{}: the folder cannot be made: {}", folder.string(), error.message()));
  }
  check_outputs({folder / "report.html", folder / "report.json"}, "");
}

/// Throws if the folder of `what` is not there; `option` names another.
void check_folder(const fs::path& folder, const char* what, const char* option) {
  std::error_code ignored;
  if (fs::is_directory(folder, ignored)) return;
  throw radiosity::SceneError(fmt::format("{}: there is no such folder; expected the {} ({} DIR)",
                                          folder.string(), what, option));
}

void write_text(const fs::path& path, const std::string& text) {
  io::write_stream_atomically(path, [&](std::ofstream& stream) { stream << text; });
}

std::string list_text() {
  std::string text;
  for (const validation::Case& known : validation::all_cases()) {
    text += fmt::format("{:<22} {}\n", known.name, known.title);
  }
  return text;
}

void throw_if_failed(const validation::Report& report, const fs::path& folder) {
  std::vector<std::string> failed;
  for (const validation::CaseOutcome& outcome : report.outcomes) {
    if (outcome.status == Status::failed) failed.push_back(outcome.name);
  }
  if (failed.empty()) return;
  throw radiosity::SolveError(fmt::format("{} of {} cases failed: {} (see {})", failed.size(),
                                          report.outcomes.size(), fmt::join(failed, ", "),
                                          (folder / "report.html").string()));
}

}  // namespace

ValidateCommand::ValidateCommand(CLI::App& program, Interruption& interruption)
    : interruption_(interruption),
      data_(program_data(RADIOSITY_REFERENCE_DATA, "tests/data")),
      scenes_(program_data(RADIOSITY_SCENES, "scenes")) {
  CLI::App* command = program.add_subcommand(
      "validate", "Compare what the program computes with known answers and write a report");
  command->add_option("CASE", cases_, "Cases to run; none: all (see --list)")
      ->check(check_case)
      ->type_name("");
  command
      ->add_option("-o,--output", folder_,
                   "Folder for report.html and report.json; made if it is not there")
      ->type_name("DIR");
  command->add_flag("--list", list_, "Show the cases and do nothing else");
  add_run_options(*command, common_);
  add_seed_option(*command, seed_);
  command->add_option("--data", data_, "Folder of the reference data, tests/data of the source")
      ->type_name("DIR");
  command->add_option("--scenes", scenes_, "Folder of the scenes, scenes of the source")
      ->type_name("DIR");
  command->callback([this] { run(); });
}

std::vector<validation::Case> ValidateCommand::chosen_cases() const {
  if (cases_.empty()) return validation::all_cases();
  std::vector<validation::Case> chosen;
  for (const std::string& name : cases_) chosen.push_back(*validation::find_case(name));
  return chosen;
}

validation::Report ValidateCommand::run_cases() const {
  validation::Report report{
      .version = std::string(radiosity::kVersion),
      .machine = machine_text(),
      .date = time_text(),
      .n_threads = common_.n_threads > 0 ? common_.n_threads : std::thread::hardware_concurrency(),
      .seed = seed_};
  const validation::Context context{
      data_, scenes_, seed_, {.report = {}, .stop = interruption_.token()}};
  const std::vector<validation::Case> chosen = chosen_cases();
  for (const validation::Case& next : chosen) {
    context.progress.check();
    {
      TerminalProgress terminal(terminal_style(common_));
      terminal.report(next.name, static_cast<double>(report.outcomes.size()),
                      static_cast<double>(chosen.size()), "cases");
      report.outcomes.push_back(validation::run_case(next, context));
    }
    if (!common_.json) print(validation::outcome_line(report.outcomes.back()));
  }
  return report;
}

void ValidateCommand::write_report(const validation::Report& report) const {
  const fs::path folder = folder_;
  const auto lock = interruption_.hold();
  const std::string json = validation::report_json(report);
  write_text(folder / "report.html", validation::report_html(report));
  write_text(folder / "report.json", json + '\n');
  if (common_.json) print(json);
}

void ValidateCommand::run() const {
  if (list_) {
    print(list_text());
    return;
  }
  if (folder_.empty()) throw CLI::RequiredError("--output");
  check_folder(data_, "reference data, tests/data of the source", "--data");
  check_folder(scenes_, "scenes, scenes of the source", "--scenes");
  prepare_folder(folder_);
  const radiosity::ThreadLimit threads(common_.n_threads);
  const validation::Report report = run_cases();
  write_report(report);
  throw_if_failed(report, folder_);
}

}  // namespace apps
