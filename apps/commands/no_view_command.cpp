// In place of view_command.cpp where the window is not built.
#include <CLI/App.hpp>

#include "apps/commands/view_command.h"
#include "radiosity/base/error.h"

namespace apps {

ViewCommand::ViewCommand(CLI::App& program, Interruption& interruption)
    : interruption_(interruption) {
  program.add_subcommand("view", "Look at a scene in a desktop window (not in this program)")
      ->allow_extras()
      ->callback([this] { run(); });
}

void ViewCommand::run() const {
  throw radiosity::SceneError("this program was built without its window (RADIOSITY_BUILD_VIEWER)");
}

}  // namespace apps
