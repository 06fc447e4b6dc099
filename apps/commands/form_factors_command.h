#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/options/common_options.h"
#include "apps/run/factor_row.h"
#include "apps/run/rank_start.h"
#include "apps/summary/factor_summary.h"
#include "apps/terminal/interruption.h"
#include "radiosity/base/progress.h"
#include "radiosity/base/ranks.h"
#include "radiosity/base/work_part.h"
#include "radiosity/scene/patch_mesh.h"

namespace CLI {
class App;
}  // namespace CLI

namespace apps {

/// `radiosity form-factors SCENE -o F.h5 [--by surface] [--resume]`: computes the form factors by
/// way of a work file, writes them to a file and, by surface, to the terminal. With `--from`, only
/// those from one point or surface. Adds itself to the program and runs when that is parsed; must
/// outlive the parsing. Where there are ranks, all run it, and the first one keeps the work file,
/// writes and prints.
class FormFactorsCommand {
 public:
  FormFactorsCommand(CLI::App& program, Interruption& interruption,
                     radiosity::Ranks* ranks = nullptr);
  FormFactorsCommand(const FormFactorsCommand&) = delete;
  FormFactorsCommand& operator=(const FormFactorsCommand&) = delete;

 private:
  /// Lets the output be that of --part, if there is one.
  void choose_part();
  void run() const;
  /// Whether form factors of so many patches are written compressed: if it is said, or if nothing
  /// is and all of them would not fit into memory for who uses them.
  [[nodiscard]] bool is_compressed(radiosity::Index n_patches) const;
  void write_compressed(const radiosity::Scene& scene, const study::Patches& patches,
                        study::StudyOptions options, const study::StudyEvents& events,
                        TerminalProgress& terminal, RankStart& others) const;
  void write_compressed_outputs(const FactorSummary& summary, const radiosity::Transport& transport,
                                const Eigen::MatrixXd& table, const std::string& fingerprint,
                                const radiosity::Progress& progress) const;
  void run_from(const std::string& from) const;
  void run_row(const RowRequest& request) const;
  [[nodiscard]] bool is_table_asked() const;
  /// With that option outputs are tables.
  void check_tables_only(const std::string& option) const;
  [[nodiscard]] radiosity::StreamOptions stream_options(const radiosity::Scene& scene,
                                                        const study::StudyOptions& options,
                                                        radiosity::Index n_patches,
                                                        const radiosity::Progress& progress) const;
  [[nodiscard]] bool is_complete(const radiosity::Fingerprint& fingerprint) const;
  void tell_complete(const FactorSummary& summary, TerminalProgress& terminal) const;
  /// Checks the work file, which is in that state, and lets who interrupts know of it.
  void announce_work_file(radiosity::WorkFileState state, TerminalProgress& terminal) const;
  [[nodiscard]] radiosity::WorkStart start() const;
  [[nodiscard]] radiosity::TileStore open_store(const radiosity::PatchMesh& mesh,
                                                const radiosity::Fingerprint& fingerprint,
                                                const radiosity::Progress& progress,
                                                TerminalProgress& terminal) const;
  [[nodiscard]] Eigen::MatrixXd write_outputs(const radiosity::Scene& scene,
                                              const radiosity::PatchMesh& mesh,
                                              const radiosity::StreamedFactors& factors,
                                              const radiosity::Fingerprint& fingerprint) const;
  void print_factors(const FactorSummary& summary, const TerminalProgress& terminal) const;

  /// Throws SolveError for what several ranks do not do.
  void check_shared() const;
  /// Bytes for a computation by way of the disk: of each rank, if there are ranks.
  [[nodiscard]] std::size_t memory_to_use() const;

  Interruption& interruption_;
  radiosity::Ranks* ranks_;
  CommonOptions common_;
  study::StudyOptions compute_;
  std::string by_;
  std::string format_;
  std::optional<std::string> from_;
  std::optional<std::string> row_;
  bool exact_ = false;
  std::string part_text_;
  std::optional<radiosity::WorkPart> part_;
  bool resume_ = false;
  std::string memory_;
  double min_factor_ = 0;
};

}  // namespace apps
