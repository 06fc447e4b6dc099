#include "apps/commands/form_factors_command.h"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>

#include "apps/run/factors_from.h"
#include "apps/run/scene_input.h"
#include "apps/run/shown_events.h"
#include "apps/run/work_file_check.h"
#include "apps/summary/json_summary.h"
#include "apps/summary/summary.h"
#include "apps/summary/text_summary.h"
#include "apps/terminal/memory_size.h"
#include "apps/terminal/output_files.h"
#include "io/base/extension.h"
#include "io/result/destinations_csv.h"
#include "io/result/form_factor_file.h"
#include "io/result/form_factor_reader.h"
#include "io/result/surface_csv.h"
#include "radiosity/base/parallel.h"
#include "radiosity/operator/surface_factors.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/stream/streaming_memory.h"
#include "study/row_check.h"
#include "study/warnings.h"

namespace apps {
namespace {

bool is_h5(const std::string& output) { return io::lower_case_extension(output) == ".h5"; }

std::string check_memory_size(const std::string& text) {
  if (parse_memory_size(text)) return "";
  return fmt::format("found '{}', expected a size such as 2GB, 500MB or 750MiB", text);
}

std::string check_factor(const std::string& text) {
  double value = 0;
  if (CLI::detail::lexical_cast(text, value) && value > 0 && value < 1) return "";
  return fmt::format("found '{}', expected a number above 0 and below 1", text);
}

Eigen::VectorXd row_error(const radiosity::StreamedFactors& factors, radiosity::Index row) {
  Eigen::VectorXd result;
  factors.for_each_row(
      [&](radiosity::Index i, const Eigen::VectorXd& /*row*/, const Eigen::VectorXd& error) {
        if (i == row) result = error;
      });
  return result;
}

}  // namespace

FormFactorsCommand::FormFactorsCommand(CLI::App& program, Interruption& interruption)
    : interruption_(interruption) {
  compute_.tolerance = 1e-3;
  CLI::App* command = program.add_subcommand(
      "form-factors",
      "Compute the form factors (view factors) of a scene and write them to a file");
  add_common_options(*command, common_);
  command
      ->add_option("-o,--output", common_.outputs,
                   "Result file: .h5 (HDF5, every pair of patches) or .csv (between surfaces); may "
                   "be repeated")
      ->check(
          [](const std::string& path) { return check_extension(path, form_factor_extensions()); })
      ->type_name("FILE")
      ->allow_extra_args(false);
  auto* by = command->add_option("--by", by_, "Also print the table of factors between surfaces")
                 ->check(CLI::IsMember({"surface"}))
                 ->type_name("WHAT");
  auto* resume = command->add_flag(
      "--resume", resume_,
      "Continue where an earlier run with the same scene and options was stopped");
  command
      ->add_option("--memory", memory_,
                   "Memory to use, such as 2GB or 500MiB; default: half of what there is")
      ->check(check_memory_size)
      ->type_name("SIZE");
  auto* min_factor =
      command
          ->add_option("--min-factor", min_factor_,
                       "Drop the pairs whose form factors are both below X; row sums are kept")
          ->check(check_factor)
          ->type_name("X");
  command
      ->add_option("--from", from_,
                   "Only the factors from one surface, by its name, or from the point x,y,z with "
                   "normal nx,ny,nz (metres); shown, and written to a .csv if there is -o")
      ->type_name("NAME|x,y,z,nx,ny,nz")
      ->excludes(by)
      ->excludes(resume)
      ->excludes(min_factor);
  add_compute_options(*command, compute_);
  command->callback([this] { run(); });
}

void FormFactorsCommand::run() const {
  if (from_) return run_from(*from_);
  if (common_.outputs.empty()) throw CLI::RequiredError("--output");
  CommonOptions common = common_;
  common.outputs.push_back(work_file_path(common_.outputs));
  check_outputs(common.outputs, common_.scene);
  TerminalProgress terminal(terminal_style(common_));
  const radiosity::ThreadLimit threads(common_.n_threads);
  const study::StudyEvents events = shown_events(terminal, interruption_);
  study::StudyOptions options = compute_;
  options.storage = study::Storage::disk;
  options.memory = parse_memory_size(memory_).value_or(radiosity::default_streaming_memory());
  const radiosity::Scene scene = read_checked_scene(common, events);
  const auto [mesh, visibility] = study::divide(scene, options, events);
  const radiosity::StreamOptions streaming =
      stream_options(scene, options, mesh.size(), events.progress);
  const radiosity::Fingerprint fingerprint = stream_fingerprint(mesh, streaming);
  FactorSummary summary{
      .scene = scene, .mesh = mesh, .min_factor = min_factor_, .outputs = common_.outputs};
  if (is_complete(fingerprint)) {
    terminal.warn(
        fmt::format("{} is complete already; nothing was computed", common_.outputs.front()));
    print_factors(summary, terminal);
    return;
  }
  radiosity::TileStore store = open_store(mesh, fingerprint, events.progress, terminal);
  const radiosity::StreamedFactors factors(mesh, visibility, streaming, store);
  study::refuse_excess(scene, mesh, factors.report(), compute_.tolerance,
                       [&](radiosity::Index row) { return row_error(factors, row); });
  study::warn_of_open_rows(factors.report(), events);
  summary.factors = &factors;
  const Eigen::MatrixXd by_surface = write_outputs(mesh, factors, fingerprint);
  if (by_ == "surface") summary.by_surface = by_surface;
  events.progress.check();
  store.remove();
  print_factors(summary, terminal);
}

radiosity::StreamOptions FormFactorsCommand::stream_options(
    const radiosity::Scene& scene, const study::StudyOptions& options, radiosity::Index n_patches,
    const radiosity::Progress& progress) const {
  return {.tolerance = options.tolerance,
          .closed = study::closedness(scene, options.closed),
          .seed = options.seed,
          .min_factor = min_factor_,
          .buffers = options.memory - radiosity::streaming_memory(n_patches),
          .progress = progress};
}

radiosity::TileStore FormFactorsCommand::open_store(const radiosity::PatchMesh& mesh,
                                                    const radiosity::Fingerprint& fingerprint,
                                                    const radiosity::Progress& progress,
                                                    TerminalProgress& terminal) const {
  using Start = radiosity::TileStore::Start;
  const std::filesystem::path path = work_file_path(common_.outputs);
  const Start start = resume_ ? Start::resumed : Start::anew;
  check_work_file(path, fingerprint, start, terminal);
  interruption_.advise(fmt::format(
      "{} keeps what is done; repeat the command with --resume to go on", one_line(path.string())));
  return {path, fingerprint.value(), start, mesh.area, progress};
}

bool FormFactorsCommand::is_complete(const radiosity::Fingerprint& fingerprint) const {
  const auto& outputs = common_.outputs;
  if (!resume_ || !by_.empty() || std::filesystem::exists(work_file_path(outputs))) return false;
  return std::all_of(outputs.begin(), outputs.end(), [&](const std::string& output) {
    return is_h5(output) && io::read_fingerprint(output) == fingerprint.text() &&
           io::has_intact_form_factors(output);
  });
}

Eigen::MatrixXd FormFactorsCommand::write_outputs(const radiosity::PatchMesh& mesh,
                                                  const radiosity::StreamedFactors& factors,
                                                  const radiosity::Fingerprint& fingerprint) const {
  const auto& outputs = common_.outputs;
  const bool is_table_asked = !by_.empty() || !std::all_of(outputs.begin(), outputs.end(), is_h5);
  std::optional<radiosity::SurfaceFactorSums> sums;
  const auto visit_rows = [&](const radiosity::RowVisitor& visit) {
    const bool is_counting = is_table_asked && !sums;
    if (is_counting) sums.emplace(mesh);
    factors.for_each_row(
        [&](radiosity::Index i, const Eigen::VectorXd& row, const Eigen::VectorXd& error) {
          if (is_counting) sums->add_row(i, row);
          if (visit) visit(i, row, error);
        });
  };
  const auto lock = interruption_.hold();
  for (const std::string& output : outputs) {
    if (is_h5(output)) {
      io::write_form_factors(output, mesh, {factors.report(), visit_rows},
                             {.tolerance = compute_.tolerance,
                              .min_factor = min_factor_,
                              .fingerprint = fingerprint.text()});
    }
  }
  if (!is_table_asked) return {};
  if (!sums) visit_rows({});
  for (const std::string& output : outputs) {
    if (!is_h5(output)) io::write_surface_csv(output, mesh, sums->factors());
  }
  return sums->factors();
}

void FormFactorsCommand::print_factors(const FactorSummary& summary,
                                       const TerminalProgress& terminal) const {
  print(common_.json ? form_factors_json(summary, terminal.warnings())
                     : form_factors_text(summary));
}

void FormFactorsCommand::run_from(const std::string& from) const {
  for (const std::string& output : common_.outputs) {
    const std::string refusal = check_extension(output, {".csv"});
    if (!refusal.empty()) throw CLI::ValidationError("--output with --from", refusal);
  }
  check_outputs(common_.outputs, common_.scene);
  TerminalProgress terminal(terminal_style(common_));
  const radiosity::ThreadLimit threads(common_.n_threads);
  const study::StudyEvents events = shown_events(terminal, interruption_);
  const FactorsFrom factors = compute_factors_from(from, common_, compute_, events);
  for (const std::string& output : common_.outputs) {
    const auto lock = interruption_.hold();
    io::write_destinations_csv(output, factors.surface_names, factors.shares);
  }
  events.progress.check();
  print(common_.json ? factors_from_json(factors, common_.outputs, terminal.warnings())
                     : factors_from_text(factors, common_.outputs));
}

}  // namespace apps
