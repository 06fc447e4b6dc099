// In place of validate_command.cpp where the cases are not built.
#include <CLI/App.hpp>

#include "apps/commands/validate_command.h"
#include "radiosity/base/error.h"

namespace apps {

ValidateCommand::ValidateCommand(CLI::App& program, Interruption& interruption)
    : interruption_(interruption) {
  program.add_subcommand("validate", "Compare with known answers (not in this program)")
      ->allow_extras()
      ->callback([this] { run(); });
}

void ValidateCommand::run() const {
  throw radiosity::SolveError(
      "this program was built without its known answers (RADIOSITY_BUILD_VALIDATION)");
}

}  // namespace apps
