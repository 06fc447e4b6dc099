#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/options/common_options.h"
#include "apps/summary/factor_summary.h"
#include "apps/terminal/interruption.h"
#include "radiosity/base/progress.h"
#include "radiosity/scene/patch_mesh.h"

namespace CLI {
class App;
}  // namespace CLI

namespace apps {

/// `radiosity form-factors SCENE -o F.h5 [--by surface] [--resume]`: computes the form factors by
/// way of a work file, writes them to a file and, by surface, to the terminal. With `--from`, only
/// those from one point or surface. Adds itself to the program and runs when that is parsed; must
/// outlive the parsing.
class FormFactorsCommand {
 public:
  FormFactorsCommand(CLI::App& program, Interruption& interruption);
  FormFactorsCommand(const FormFactorsCommand&) = delete;
  FormFactorsCommand& operator=(const FormFactorsCommand&) = delete;

 private:
  void run() const;
  void run_from(const std::string& from) const;
  [[nodiscard]] radiosity::StreamOptions stream_options(const radiosity::Scene& scene,
                                                        const study::StudyOptions& options,
                                                        radiosity::Index n_patches,
                                                        const radiosity::Progress& progress) const;
  [[nodiscard]] bool is_complete(const radiosity::Fingerprint& fingerprint) const;
  [[nodiscard]] radiosity::TileStore open_store(const radiosity::PatchMesh& mesh,
                                                const radiosity::Fingerprint& fingerprint,
                                                const radiosity::Progress& progress,
                                                TerminalProgress& terminal) const;
  [[nodiscard]] Eigen::MatrixXd write_outputs(const radiosity::PatchMesh& mesh,
                                              const radiosity::StreamedFactors& factors,
                                              const radiosity::Fingerprint& fingerprint) const;
  void print_factors(const FactorSummary& summary, const TerminalProgress& terminal) const;

  Interruption& interruption_;
  CommonOptions common_;
  study::StudyOptions compute_;
  std::string by_;
  std::optional<std::string> from_;
  bool resume_ = false;
  std::string memory_;
  double min_factor_ = 0;
};

}  // namespace apps
