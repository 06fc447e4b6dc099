#pragma once

#include <string>
#include <vector>

#include "apps/options/common_options.h"
#include "apps/terminal/interruption.h"
#include "radiosity/base/progress.h"
#include "radiosity/scene/scene.h"

namespace CLI {
class App;
}  // namespace CLI

namespace apps {

/// `radiosity inspect SCENE`: counts and measures a scene, reports its flaws and may write
/// it in other formats.
/// Adds itself to the program and runs when that is parsed; must outlive the parsing.
class InspectCommand {
 public:
  InspectCommand(CLI::App& program, Interruption& interruption);
  InspectCommand(const InspectCommand&) = delete;
  InspectCommand& operator=(const InspectCommand&) = delete;

 private:
  void run() const;
  /// Writes the scene to the outputs; returns all files that this made.
  std::vector<std::string> write(const radiosity::Scene& scene,
                                 const radiosity::Progress& progress) const;

  Interruption& interruption_;
  CommonOptions common_;
  bool has_ugr_table_ = false;
};

}  // namespace apps
