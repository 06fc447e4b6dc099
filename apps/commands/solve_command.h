#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/options/common_options.h"
#include "apps/options/lightmap_options.h"
#include "apps/terminal/interruption.h"
#include "apps/terminal/terminal_progress.h"
#include "io/result/result_file.h"
#include "radiosity/base/ranks.h"
#include "radiosity/scene/scenario.h"
#include "radiosity/solve/linear_solver.h"
#include "study/study.h"

namespace CLI {
class App;
}  // namespace CLI

namespace apps {

/// `radiosity solve SCENE [-o FILE]... [--scenarios FILE]`: computes the radiosity, writes it, and
/// prints a summary.
/// Adds itself to the program and runs when that is parsed; must outlive the parsing.
/// Where there are ranks, all run it, and the first one writes and prints.
class SolveCommand {
 public:
  /// A solver from elsewhere, for the options of its own that were given.
  using MakeSolver = std::function<radiosity::LinearSolver(const std::string& options)>;

  SolveCommand(CLI::App& program, Interruption& interruption, radiosity::Ranks* ranks = nullptr,
               MakeSolver make_ksp = {});
  SolveCommand(const SolveCommand&) = delete;
  SolveCommand& operator=(const SolveCommand&) = delete;

 private:
  void run() const;
  /// What the ranks have of the options; throws SolveError for what they do not do.
  [[nodiscard]] study::StudyOptions shared_options() const;
  /// With the light and materials of each scenario.
  void solve_all(study::Study assembled, const std::vector<radiosity::Scenario>& scenarios,
                 const study::StudyEvents& events, const TerminalProgress& terminal) const;
  /// What is written; of several scenarios with their names before the extension.
  [[nodiscard]] std::vector<std::string> all_outputs(
      const std::vector<radiosity::Scenario>& scenarios) const;
  [[nodiscard]] std::vector<std::string> outputs_of(const radiosity::Scenario& scenario) const;
  [[nodiscard]] std::vector<radiosity::QuantityField> fields(
      const study::Study& solved, const std::vector<radiosity::Quantity>& quantities) const;
  /// Writes all but form factors; returns the scale of pictures in false colours.
  std::optional<ShownScale> write_results(const study::Study& solved,
                                          const std::vector<std::string>& outputs,
                                          const io::ResultOptions& options,
                                          const radiosity::Progress& progress) const;
  /// Finds out before the long work what would be in vain.
  void check_all(const radiosity::Scene& scene, const study::Patches& patches,
                 std::vector<radiosity::Quantity> quantities, TerminalProgress& terminal) const;

  Interruption& interruption_;
  radiosity::Ranks* ranks_;
  MakeSolver make_ksp_;  // for --ksp, where there is one
  std::optional<std::string> ksp_;
  CommonOptions common_;
  study::StudyOptions compute_;
  std::optional<std::string> operator_;
  std::optional<std::string> scenarios_;
  std::optional<std::string> table_;
  PictureOptions picture_;
  LightmapOptions lightmap_;
  QuantityOptions quantities_;
};

}  // namespace apps
