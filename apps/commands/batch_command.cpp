#include "apps/commands/batch_command.h"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <filesystem>

#include "apps/run/shown_events.h"
#include "apps/summary/batch_summary.h"
#include "apps/summary/summary.h"
#include "apps/terminal/memory_size.h"
#include "apps/terminal/output_files.h"
#include "io/base/output_check.h"
#include "radiosity/base/error.h"

namespace apps {
namespace {

constexpr std::size_t kMostJobs = 1000;

/// Some of the entries failed; the table has told which and why.
struct BatchFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace

BatchCommand::BatchCommand(CLI::App& program, Interruption& interruption)
    : interruption_(interruption) {
  CLI::App* command = program.add_subcommand(
      "batch", "Run all entries of a list, some at a time, and make one table of the results");
  command->add_option("LIST", list_, "List of runs (.json)")->required();
  command
      ->add_option("-o,--output", common_.outputs,
                   "Table of the results, .csv or .json; may be repeated")
      ->check([](const std::string& path) {
        return check_extension(path, {".csv", ".json"});
      })
      ->type_name("FILE")
      ->allow_extra_args(false);
  command->add_option("--jobs", batch_.n_jobs, "Entries at a time")
      ->check(CLI::Range(std::size_t{1}, kMostJobs))
      ->capture_default_str()
      ->type_name("N");
  command
      ->add_option("--memory", memory_,
                   "Memory that those at a time share, such as 2GB; default: half of what there is")
      ->check(check_memory_size)
      ->type_name("SIZE");
  command->add_flag("--again", batch_.again, "Run what was done before, too");
  add_run_options(*command, common_);
  command->callback([this] { run(); });
}

void BatchCommand::check_tables(const std::vector<BatchEntry>& entries) const {
  std::vector<std::filesystem::path> files{list_};
  for (const BatchEntry& entry : entries) {
    files.push_back(batch_folder(list_) / entry.scene);
    for (const std::string& output : entry.outputs) files.push_back(batch_folder(list_) / output);
  }
  for (const std::string& output : common_.outputs) {
    for (const std::filesystem::path& file : files) {
      if (!io::is_same_file(output, file)) continue;
      throw radiosity::OutputError(
          fmt::format("{}: cannot be written: it is a file of the list", output));
    }
  }
  check_outputs(common_.outputs, {});
}

void BatchCommand::run() const {
  const std::vector<BatchEntry> entries = read_batch_list(list_);
  check_tables(entries);
  TerminalProgress terminal(terminal_style(common_));
  const study::StudyEvents events = shown_events(terminal, interruption_);
  BatchOptions options = batch_;
  options.memory = parse_memory_size(memory_).value_or(0);
  options.n_threads = common_.n_threads;
  // So that a signal leaves the time to end what runs and to write the table.
  const auto lock = interruption_.hold();
  interruption_.advise("the same command goes on with what is not done yet");
  BatchJournal journal(list_ + ".journal");
  const std::vector<BatchResult> results =
      run_batch(entries, batch_folder(list_), journal, options, events.progress);
  for (const std::string& output : common_.outputs) write_batch_table(output, results);
  print(common_.json ? batch_json(results) : batch_text(results));
  events.progress.check();
  const std::size_t n_failed = count(results, BatchStatus::failed);
  if (n_failed > 0) {
    throw BatchFailure(
        fmt::format("{} of {} entries failed, as the table tells", n_failed, results.size()));
  }
}

}  // namespace apps
