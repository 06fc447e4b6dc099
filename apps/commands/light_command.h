#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/options/common_options.h"
#include "apps/options/light_options.h"
#include "apps/summary/light_summary.h"
#include "apps/terminal/interruption.h"
#include "apps/terminal/terminal_progress.h"
#include "study/study.h"

namespace CLI {
class App;
}  // namespace CLI

namespace apps {

/// `radiosity light SCENE [--grid floor:0.75]... [-o DIR]`: illuminance on grids and at points,
/// glare, and a report. Adds itself to the program and runs when that is parsed; must outlive the
/// parsing.
class LightCommand {
 public:
  LightCommand(CLI::App& program, Interruption& interruption);
  LightCommand(const LightCommand&) = delete;
  LightCommand& operator=(const LightCommand&) = delete;

 private:
  void run() const;
  /// Files of each grid of the plan, and the report; none without a folder.
  [[nodiscard]] std::vector<std::string> outputs(const radiosity::LightPlan& plan) const;
  void write(const LightSummary& summary, const TerminalProgress& terminal) const;

  Interruption& interruption_;
  CommonOptions common_;
  study::StudyOptions compute_;
  std::optional<std::string> operator_;
  LightOptions light_;
  PhotometryOptions photometry_;
  std::string folder_;  // "": nothing is written
};

}  // namespace apps
