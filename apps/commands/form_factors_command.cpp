#include "apps/commands/form_factors_command.h"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>

#include "apps/run/factor_outputs.h"
#include "apps/run/factor_part.h"
#include "apps/run/factor_table.h"
#include "apps/run/factors_from.h"
#include "apps/run/rank_memory.h"
#include "apps/run/rank_start.h"
#include "apps/run/scene_input.h"
#include "apps/run/shown_events.h"
#include "apps/run/work_file_check.h"
#include "apps/summary/json_summary.h"
#include "apps/summary/summary.h"
#include "apps/summary/text_summary.h"
#include "apps/terminal/memory_size.h"
#include "apps/terminal/number_list.h"
#include "apps/terminal/output_files.h"
#include "io/result/destinations_csv.h"
#include "io/result/form_factor_file.h"
#include "io/result/form_factor_reader.h"
#include "io/result/operator_file.h"
#include "io/result/row_csv.h"
#include "meshing/patches/patches.h"
#include "radiosity/assembly/dense_memory.h"
#include "radiosity/base/machine_memory.h"
#include "radiosity/base/parallel.h"
#include "radiosity/operator/surface_factors.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/stream/streaming_memory.h"
#include "study/known_factors.h"
#include "study/row_check.h"
#include "study/warnings.h"

namespace apps {

FormFactorsCommand::FormFactorsCommand(CLI::App& program, Interruption& interruption,
                                       radiosity::Ranks* ranks)
    : interruption_(interruption), ranks_(ranks) {
  compute_.tolerance = 1e-3;
  CLI::App* command = program.add_subcommand(
      "form-factors",
      "Compute the form factors (view factors) of a scene and write them to a file");
  add_common_options(*command, common_);
  command
      ->add_option(
          "-o,--output", common_.outputs,
          "Result file: .h5 (HDF5, every pair of patches), .csv or, as View3D writes it, .txt "
          "(between surfaces); for solvers .dat (Elmer), .idf or .epJSON (EnergyPlus), or F "
          "(OpenFOAM); may be repeated")
      ->check(check_factor_output)
      ->type_name("FILE")
      ->allow_extra_args(false);
  command
      ->add_option("--format", format_,
                   "Which solver's file an output is where its name leaves a choice: moose (.csv), "
                   "elmer-binary (.dat)...")
      ->check(CLI::IsMember(factor_format_names()))
      ->type_name("F");
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
          ->check(check_share)
          ->type_name("X");
  command
      ->add_option("--from", from_,
                   "Only the factors from one surface, by its name, or from the point x,y,z with "
                   "normal nx,ny,nz (metres); shown, and written to a .csv if there is -o")
      ->type_name("NAME|x,y,z,nx,ny,nz")
      ->excludes(by)
      ->excludes(resume)
      ->excludes(min_factor);
  auto* row =
      command
          ->add_option("--row", row_,
                       "Only the factors from one patch, by its number, or one surface, by its "
                       "name, to each patch; SCENE may be an .h5 file of form factors")
          ->type_name("I|NAME")
          ->excludes(by)
          ->excludes(resume)
          ->excludes(min_factor)
          ->excludes("--from");
  command->add_flag("--exact", exact_, "Evaluate that row anew instead of taking what a file has")
      ->needs(row);
  add_compute_options(*command, compute_);
  add_transport_option(*command, compute_);
  command->get_option("--transport")->excludes(min_factor);
  command
      ->add_option("--part", part_text_,
                   "Only the K-th of N parts, as F.K-of-N.h5: 'radiosity merge' makes one file of "
                   "them")
      ->check(check_part)
      ->type_name("K/N")
      ->excludes(by)
      ->excludes("--from")
      ->excludes(row);
  command->callback([this] {
    choose_part();
    run();
  });
}

void FormFactorsCommand::choose_part() {
  part_ = parse_part(part_text_);
  if (!part_ || common_.outputs.empty()) return;
  if (common_.outputs.size() != 1 || !is_factor_file(common_.outputs.front())) {
    throw CLI::ValidationError("--part", "its one output is an .h5 file");
  }
  common_.outputs.front() = part_path(common_.outputs.front(), *part_).string();
}

void FormFactorsCommand::check_shared() const {
  if (ranks_ == nullptr) return;
  if (from_ || row_ || part_) {
    throw CLI::ValidationError("form-factors",
                               "several ranks make all form factors: expected no --from, --row or "
                               "--part, which 'radiosity' knows");
  }
}

std::size_t FormFactorsCommand::memory_to_use() const {
  if (const auto given = parse_memory_size(memory_)) return *given;
  const std::size_t all = radiosity::default_streaming_memory();
  return ranks_ != nullptr ? all / static_cast<std::size_t>(ranks_->n_on_machine()) : all;
}

void FormFactorsCommand::run() const {
  check_shared();
  if (from_) return run_from(*from_);
  if (row_) return run_row({*row_, exact_});
  if (common_.outputs.empty()) throw CLI::RequiredError("--output");
  CommonOptions common = common_;
  common.outputs = all_factor_outputs(common_.outputs, format_);
  common.outputs.push_back(work_file_path(common_.outputs));
  RankStart others(ranks_);
  if (is_first(ranks_)) check_outputs(common.outputs, common_.scene);
  TerminalProgress terminal(terminal_style(common_));
  const radiosity::ThreadLimit threads(common_.n_threads);
  const study::StudyEvents events = shown_events(terminal, interruption_);
  study::StudyOptions options = compute_;
  options.memory = parse_memory_size(memory_).value_or(0);
  const radiosity::Scene scene = read_checked_scene(common, events);
  if (is_compressed(meshing::least_patches(
          scene, meshing::make_patch_options(options.patches, scene, events.progress)))) {
    options.transport = radiosity::TransportKind::compressed;
  } else {
    options.storage = study::Storage::disk;
    options.memory = memory_to_use();
  }
  const study::Patches patches = study::divide(scene, options, events);
  const auto& [mesh, visibility] = patches;
  check_factor_outputs(common_.outputs, format_, scene, mesh);
  if (is_compressed(mesh.size())) {
    return write_compressed(scene, patches, options, events, terminal, others);
  }
  const radiosity::StreamOptions streaming =
      stream_options(scene, options, mesh.size(), events.progress);
  if (!is_first(ranks_)) {
    if (is_started(*ranks_)) assist_streamed_factors(mesh, visibility, streaming);
    return;
  }
  const radiosity::Fingerprint fingerprint = stream_fingerprint(mesh, streaming);
  FactorSummary summary{
      .scene = scene, .mesh = mesh, .min_factor = min_factor_, .outputs = common_.outputs};
  if (is_complete(fingerprint)) return tell_complete(summary, terminal);
  radiosity::TileStore store = open_store(mesh, fingerprint, events.progress, terminal);
  if (part_) {
    io::FactorPart part = described_part(scene, options, fingerprint, *part_);
    part.min_factor = min_factor_;
    summary.part = write_streamed_part(common_.outputs.front(), patches, part, streaming, store,
                                       interruption_);
    store.remove();
    return print_factors(summary, terminal);
  }
  others.begin();
  const radiosity::StreamedFactors factors(mesh, visibility, streaming, store);
  study::refuse_excess(scene, mesh, factors.report(), compute_.tolerance,
                       [&](radiosity::Index row) { return row_error_of(factors, row); });
  study::warn_of_open_rows(factors.report(), events);
  summary.report = &factors.report();
  summary.bytes = factors.bytes();
  summary.dropped = factors.dropped();
  const Eigen::MatrixXd by_surface = write_outputs(scene, mesh, factors, fingerprint);
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
          .ranks = ranks_,
          .progress = progress};
}

radiosity::TileStore FormFactorsCommand::open_store(const radiosity::PatchMesh& mesh,
                                                    const radiosity::Fingerprint& fingerprint,
                                                    const radiosity::Progress& progress,
                                                    TerminalProgress& terminal) const {
  const std::filesystem::path path = work_file_path(common_.outputs);
  announce_work_file(radiosity::work_file_state(path, fingerprint.value()), terminal);
  return {path, fingerprint.value(), start(), mesh.area, progress};
}

radiosity::WorkStart FormFactorsCommand::start() const {
  return resume_ ? radiosity::WorkStart::resumed : radiosity::WorkStart::anew;
}

void FormFactorsCommand::announce_work_file(radiosity::WorkFileState state,
                                            TerminalProgress& terminal) const {
  const std::filesystem::path path = work_file_path(common_.outputs);
  check_work_file(path, state, start(), terminal);
  interruption_.advise(fmt::format(
      "{} keeps what is done; repeat the command with --resume to go on", one_line(path.string())));
}

void FormFactorsCommand::tell_complete(const FactorSummary& summary,
                                       TerminalProgress& terminal) const {
  terminal.warn(
      fmt::format("{} is complete already; nothing was computed", common_.outputs.front()));
  print_factors(summary, terminal);
}

bool FormFactorsCommand::is_complete(const radiosity::Fingerprint& fingerprint) const {
  const auto& outputs = common_.outputs;
  if (!resume_ || !by_.empty() || std::filesystem::exists(work_file_path(outputs))) return false;
  if (part_) return io::has_intact_part(outputs.front(), *part_, fingerprint.text());
  return std::all_of(outputs.begin(), outputs.end(), [&](const std::string& output) {
    return is_factor_file(output) && io::read_fingerprint(output) == fingerprint.text() &&
           (io::is_compressed_operator(output) || io::has_intact_form_factors(output));
  });
}

Eigen::MatrixXd FormFactorsCommand::write_outputs(const radiosity::Scene& scene,
                                                  const radiosity::PatchMesh& mesh,
                                                  const radiosity::StreamedFactors& factors,
                                                  const radiosity::Fingerprint& fingerprint) const {
  const auto& outputs = common_.outputs;
  std::optional<radiosity::SurfaceFactorSums> sums;
  const auto visit_rows = [&](const radiosity::RowVisitor& visit) {
    const bool is_counting = is_table_asked() && !sums;
    if (is_counting) sums.emplace(mesh);
    factors.for_each_row(
        [&](radiosity::Index i, const Eigen::VectorXd& row, const Eigen::VectorXd& error) {
          if (is_counting) sums->add_row(i, row);
          if (visit) visit(i, row, error);
        });
  };
  const auto lock = interruption_.hold();
  for (const std::string& output : outputs) {
    const FactorFormat format = factor_format(output, format_);
    if (is_by_polygon(format)) write_polygon_factors(output, format, mesh, visit_rows);
    if (format == FactorFormat::hdf5) {
      io::write_form_factors(output, mesh, {factors.report(), visit_rows},
                             {.tolerance = compute_.tolerance,
                              .min_factor = min_factor_,
                              .fingerprint = fingerprint.text(),
                              .geometry = study::geometry_fingerprint(scene)});
    }
  }
  if (!is_table_asked()) return {};
  if (!sums) visit_rows({});
  for (const std::string& output : outputs) {
    const FactorFormat format = factor_format(output, format_);
    if (!is_table(format)) continue;
    write_factor_table(output, format, scene, mesh, {sums->factors(), factors.report().closed});
  }
  return sums->factors();
}

void FormFactorsCommand::print_factors(const FactorSummary& summary,
                                       const TerminalProgress& terminal) const {
  print(common_.json ? form_factors_json(summary, terminal.warnings())
                     : form_factors_text(summary));
}

bool FormFactorsCommand::is_table_asked() const {
  const auto& outputs = common_.outputs;
  return !by_.empty() || std::any_of(outputs.begin(), outputs.end(), [&](const auto& output) {
    return is_table(factor_format(output, format_));
  });
}

void FormFactorsCommand::check_tables_only(const std::string& option) const {
  for (const std::string& output : common_.outputs) {
    const std::string refusal = check_extension(output, {".csv"});
    if (!refusal.empty()) throw CLI::ValidationError("--output with " + option, refusal);
  }
  check_outputs(common_.outputs, common_.scene);
}

void FormFactorsCommand::run_row(const RowRequest& request) const {
  check_tables_only("--row");
  TerminalProgress terminal(terminal_style(common_));
  const radiosity::ThreadLimit threads(common_.n_threads);
  const study::StudyEvents events = shown_events(terminal, interruption_);
  const FactorRow row = find_factor_row(request, common_, compute_, events);
  for (const std::string& output : common_.outputs) {
    const auto lock = interruption_.hold();
    io::write_row_csv(output, row.mesh, row.values);
  }
  events.progress.check();
  print(common_.json ? factor_row_json(row, common_.outputs, terminal.warnings())
                     : factor_row_text(row, common_.outputs));
}

void FormFactorsCommand::run_from(const std::string& from) const {
  check_tables_only("--from");
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
