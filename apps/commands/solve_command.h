#pragma once

#include <string>
#include <vector>

#include "apps/options/common_options.h"
#include "apps/terminal/interruption.h"
#include "apps/terminal/terminal_progress.h"
#include "study/study.h"

namespace CLI {
class App;
}  // namespace CLI

namespace apps {

/// `radiosity solve SCENE [-o FILE]...`: computes the radiosity, writes it, and prints a summary.
/// Adds itself to the program and runs when that is parsed; must outlive the parsing.
class SolveCommand {
 public:
  SolveCommand(CLI::App& program, Interruption& interruption);
  SolveCommand(const SolveCommand&) = delete;
  SolveCommand& operator=(const SolveCommand&) = delete;

 private:
  void run() const;
  /// Finds out before the long work what would be in vain.
  void check_all(const radiosity::Scene& scene, const study::Patches& patches,
                 std::vector<radiosity::Quantity> quantities, TerminalProgress& terminal) const;

  Interruption& interruption_;
  CommonOptions common_;
  study::StudyOptions compute_;
  PictureOptions picture_;
  QuantityOptions quantities_;
};

}  // namespace apps
