#pragma once

#include <string>
#include <vector>

#include "apps/options/common_options.h"
#include "apps/run/solved_scene.h"
#include "apps/terminal/interruption.h"

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
  void check_all(const PatchedScene& patched, std::vector<radiosity::Quantity> quantities,
                 TerminalProgress& terminal) const;

  Interruption& interruption_;
  CommonOptions common_;
  ComputeOptions compute_;
  PictureOptions picture_;
  QuantityOptions quantities_;
  std::string method_;
};

}  // namespace apps
