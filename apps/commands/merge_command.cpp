#include "apps/commands/merge_command.h"

#include <fmt/format.h>

#include <CLI/App.hpp>

#include "apps/run/shown_events.h"
#include "apps/summary/json_summary.h"
#include "apps/summary/summary.h"
#include "apps/summary/text_summary.h"
#include "apps/terminal/memory_size.h"
#include "apps/terminal/output_files.h"
#include "io/base/output_check.h"
#include "io/result/form_factor_file.h"
#include "io/result/operator_file.h"
#include "radiosity/base/error.h"
#include "radiosity/base/parallel.h"
#include "radiosity/compressed/block_store.h"
#include "radiosity/compressed/make_compressed_transport.h"
#include "radiosity/stream/streamed_factors.h"
#include "radiosity/stream/streaming_memory.h"
#include "radiosity/version.h"
#include "study/row_check.h"
#include "study/warnings.h"

namespace apps {
namespace {

/// Removes a file at its end, whatever happened.
class Removal {
 public:
  explicit Removal(std::filesystem::path path) : path_(std::move(path)) {}
  ~Removal() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  Removal(const Removal&) = delete;
  Removal& operator=(const Removal&) = delete;

 private:
  std::filesystem::path path_;
};

/// What was made by a program whose numbers are others than this one's.
void check_fingerprint(const PartSet& parts, const radiosity::Fingerprint& fingerprint) {
  if (fingerprint.text() == parts.common.fingerprint) return;
  throw radiosity::SceneError(fmt::format(
      "{}: was made by version {} of this program, which computes other numbers than this one ({})",
      parts.files.front().string(), parts.common.program, radiosity::kVersion));
}

}  // namespace

MergeCommand::MergeCommand(CLI::App& program, Interruption& interruption)
    : interruption_(interruption) {
  CLI::App* command = program.add_subcommand(
      "merge", "Put the parts together that 'form-factors --part' has written, to one file");
  command->add_option("PART", parts_, "All parts of one computation (.h5), in any order")
      ->required();
  command
      ->add_option("-o,--output", common_.outputs,
                   "Result file, .h5 (HDF5): the same as without parts, byte by byte")
      ->check([](const std::string& path) { return check_extension(path, {".h5"}); })
      ->type_name("FILE")
      ->expected(1)
      ->allow_extra_args(false)
      ->required();
  command
      ->add_option("--memory", memory_,
                   "Memory to use, such as 2GB or 500MiB; default: half of what there is")
      ->check(check_memory_size)
      ->type_name("SIZE");
  add_run_options(*command, common_);
  command->callback([this] { run(); });
}

void MergeCommand::run() const {
  const std::string& output = common_.outputs.front();
  const std::filesystem::path work_file = output + ".merging";
  for (const std::string& part : parts_) {
    if (!io::is_same_file(output, part)) continue;
    throw radiosity::OutputError(
        fmt::format("{}: cannot be written: it is one of the parts", output));
  }
  io::check_writable(output);
  io::check_writable(work_file);
  TerminalProgress terminal(terminal_style(common_));
  const radiosity::ThreadLimit threads(common_.n_threads);
  const study::StudyEvents events = shown_events(terminal, interruption_);
  const PartSet parts = find_parts(parts_, events.progress);
  const radiosity::PatchMesh mesh = io::PartReader(parts.files.front()).read_mesh();
  const Merged merged = parts.common.is_compressed
                            ? merge_compressed(parts, mesh, work_file, events)
                            : merge_streamed(parts, mesh, work_file, events);
  radiosity::Scene scene;
  scene.source = parts.common.scene;
  const FactorSummary summary{.scene = scene,
                              .mesh = mesh,
                              .report = &merged.report,
                              .bytes = merged.bytes,
                              .min_factor = parts.common.min_factor,
                              .dropped = merged.dropped,
                              .n_merged = parts.files.size(),
                              .outputs = common_.outputs};
  print(common_.json ? form_factors_json(summary, terminal.warnings())
                     : form_factors_text(summary));
}

MergeCommand::Merged MergeCommand::merge_streamed(const PartSet& parts,
                                                  const radiosity::PatchMesh& mesh,
                                                  const std::filesystem::path& work_file,
                                                  const study::StudyEvents& events) const {
  const io::FactorPart& common = parts.common;
  const std::size_t memory =
      parse_memory_size(memory_).value_or(radiosity::default_streaming_memory());
  radiosity::check_streaming_memory(mesh.size(), memory);
  const radiosity::StreamOptions options{
      .tolerance = common.tolerance,
      .closed = common.closed,
      .seed = common.seed,
      .min_factor = common.min_factor,
      .buffers = memory - radiosity::streaming_memory(mesh.size()),
      .progress = events.progress};
  const radiosity::Fingerprint fingerprint = stream_fingerprint(mesh, options);
  check_fingerprint(parts, fingerprint);
  (void)radiosity::work_file_state(work_file, fingerprint.value());
  const auto open = [&](radiosity::WorkStart start) {
    return radiosity::TileStore(work_file, fingerprint.value(), start, mesh.area, events.progress);
  };
  (void)open(radiosity::WorkStart::anew);  // throws where another merge is at work
  const Removal removal(work_file);
  gather_records(parts, work_file, events.progress);
  radiosity::TileStore store = open(radiosity::WorkStart::resumed);
  const radiosity::Visibility visibility(mesh);
  const radiosity::StreamedFactors factors(mesh, visibility, options, store);
  radiosity::Scene scene;
  scene.source = common.scene;
  study::refuse_excess(scene, mesh, factors.report(), common.tolerance,
                       [&](radiosity::Index row) { return row_error_of(factors, row); });
  study::warn_of_open_rows(factors.report(), events);
  const auto lock = interruption_.hold();
  io::write_form_factors(
      common_.outputs.front(), mesh,
      {factors.report(), [&](const radiosity::RowVisitor& visit) { factors.for_each_row(visit); }},
      {.tolerance = common.tolerance,
       .min_factor = common.min_factor,
       .fingerprint = fingerprint.text(),
       .geometry = common.geometry});
  return {factors.report(), factors.bytes(), factors.dropped()};
}

MergeCommand::Merged MergeCommand::merge_compressed(const PartSet& parts,
                                                    const radiosity::PatchMesh& mesh,
                                                    const std::filesystem::path& work_file,
                                                    const study::StudyEvents& events) const {
  const io::FactorPart& common = parts.common;
  const radiosity::ExpectedLight light = io::PartReader(parts.files.front()).read_light();
  const radiosity::TransportOptions options{.tolerance = common.tolerance,
                                            .closed = common.closed,
                                            .seed = common.seed,
                                            .memory = parse_memory_size(memory_).value_or(0),
                                            .progress = events.progress,
                                            .work_file = work_file,
                                            .work_start = radiosity::WorkStart::resumed};
  const radiosity::Fingerprint fingerprint = compressed_fingerprint(mesh, options, light);
  check_fingerprint(parts, fingerprint);
  (void)radiosity::block_file_state(work_file, fingerprint.value());
  (void)radiosity::BlockStore(work_file, fingerprint.value(), radiosity::WorkStart::anew);
  const Removal removal(work_file);
  gather_records(parts, work_file, events.progress);
  const radiosity::Visibility visibility(mesh);
  const auto transport = make_compressed_transport(mesh, visibility, options, light);
  study::warn_of_unverified(transport->report(), common.tolerance, events);
  radiosity::Scene scene;
  scene.source = common.scene;
  study::refuse_excess(scene, mesh, transport->report(), common.tolerance,
                       [&](radiosity::Index row) { return rows_of(*transport).row_error(row); });
  study::warn_of_open_rows(transport->report(), events);
  io::write_operator(common_.outputs.front(), mesh, *transport,
                     {.tolerance = common.tolerance,
                      .geometry = common.geometry,
                      .fingerprint = fingerprint.text()},
                     events.progress);
  return {transport->report(), transport->bytes()};
}

}  // namespace apps
