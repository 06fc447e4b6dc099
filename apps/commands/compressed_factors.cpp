// `radiosity form-factors` where its form factors are compressed.
#include <CLI/App.hpp>
#include <algorithm>
#include <filesystem>

#include "apps/commands/form_factors_command.h"
#include "apps/run/factor_outputs.h"
#include "apps/run/factor_part.h"
#include "apps/run/factor_table.h"
#include "apps/run/rank_memory.h"
#include "apps/run/rank_start.h"
#include "apps/run/work_file_check.h"
#include "apps/summary/summary.h"
#include "apps/terminal/memory_size.h"
#include "apps/terminal/output_files.h"
#include "io/result/operator_file.h"
#include "radiosity/assembly/dense_memory.h"
#include "radiosity/base/machine_memory.h"
#include "radiosity/compressed/block_store.h"
#include "radiosity/operator/surface_factors.h"
#include "radiosity/scene/patch_mesh.h"
#include "study/known_factors.h"

namespace apps {

bool FormFactorsCommand::is_compressed(radiosity::Index n_patches) const {
  const auto& outputs = common_.outputs;
  const auto by_polygon = std::find_if(outputs.begin(), outputs.end(), [&](const auto& output) {
    return is_by_polygon(factor_format(output, format_));
  });
  if (by_polygon != outputs.end()) {
    if (compute_.transport != radiosity::TransportKind::compressed) return false;
    throw CLI::ValidationError("--transport", "compressed form factors have no rows, which " +
                                                  *by_polygon + " needs; expected dense");
  }
  if (compute_.transport != radiosity::TransportKind::automatic) {
    return compute_.transport == radiosity::TransportKind::compressed;
  }
  return min_factor_ == 0 &&
         radiosity::dense_transport_bytes(n_patches) > radiosity::memory_limit(0);
}

void FormFactorsCommand::write_compressed(const radiosity::Scene& scene,
                                          const study::Patches& patches,
                                          study::StudyOptions options,
                                          const study::StudyEvents& events,
                                          TerminalProgress& terminal, RankStart& others) const {
  options.transport = radiosity::TransportKind::compressed;
  options.storage = study::Storage::memory;
  options.memory = parse_memory_size(memory_).value_or(0);
  options.ranks = ranks_;
  if (ranks_ != nullptr) options.memory = memory_of_rank(*ranks_, options.memory);
  if (!is_first(ranks_)) {
    // What the first one writes, it makes together with the others.
    if (!is_started(*ranks_)) return;
    const study::FormFactors made =
        study::make_form_factors(scene, patches.mesh, patches.visibility, options, events);
    if (is_table_asked()) (void)surface_form_factors(patches.mesh, *made.transport);
    return;
  }
  options.work_file = work_file_path(common_.outputs);
  options.work_start = start();
  FactorSummary summary{.scene = scene, .mesh = patches.mesh, .outputs = common_.outputs};
  const radiosity::Fingerprint fingerprint =
      study::compressed_fingerprint(scene, patches.mesh, options);
  if (is_complete(fingerprint)) return tell_complete(summary, terminal);
  announce_work_file(radiosity::block_file_state(options.work_file, fingerprint.value()), terminal);
  if (part_) {
    summary.part = write_compressed_part(common_.outputs.front(), scene, patches,
                                         described_part(scene, options, fingerprint, *part_),
                                         options, events, interruption_);
    std::filesystem::remove(options.work_file);
    return print_factors(summary, terminal);
  }
  others.begin();
  const study::FormFactors made =
      study::make_form_factors(scene, patches.mesh, patches.visibility, options, events);
  summary.report = &made.transport->report();
  summary.bytes = made.transport->bytes();
  const Eigen::MatrixXd table =
      is_table_asked() ? surface_form_factors(patches.mesh, *made.transport) : Eigen::MatrixXd();
  write_compressed_outputs(summary, *made.transport, table, fingerprint.text(), events.progress);
  std::filesystem::remove(options.work_file);
  if (by_ == "surface") summary.by_surface = table;
  print_factors(summary, terminal);
}

void FormFactorsCommand::write_compressed_outputs(const FactorSummary& summary,
                                                  const radiosity::Transport& transport,
                                                  const Eigen::MatrixXd& table,
                                                  const std::string& fingerprint,
                                                  const radiosity::Progress& progress) const {
  for (const std::string& output : common_.outputs) {
    if (is_factor_file(output)) {
      io::write_operator(output, summary.mesh, transport,
                         {.tolerance = compute_.tolerance,
                          .geometry = study::geometry_fingerprint(summary.scene),
                          .fingerprint = fingerprint},
                         progress);
    } else {
      const auto lock = interruption_.hold();
      write_factor_table(output, factor_format(output, format_), summary.scene, summary.mesh,
                         {table, transport.report().closed});
    }
    progress.check();
  }
}

}  // namespace apps
