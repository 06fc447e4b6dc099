#pragma once

#include "apps/options/common_options.h"
#include "apps/terminal/interruption.h"

namespace CLI {
class App;
}  // namespace CLI

namespace apps {

/// `radiosity inspect SCENE`: counts and measures a scene and reports its flaws.
/// Adds itself to the program and runs when that is parsed; must outlive the parsing.
class InspectCommand {
 public:
  InspectCommand(CLI::App& program, Interruption& interruption);
  InspectCommand(const InspectCommand&) = delete;
  InspectCommand& operator=(const InspectCommand&) = delete;

 private:
  void run() const;

  Interruption& interruption_;
  CommonOptions common_;
};

}  // namespace apps
