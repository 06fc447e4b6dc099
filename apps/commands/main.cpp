#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>
#include <string_view>

#include "apps/commands/batch_command.h"
#include "apps/commands/comfort_command.h"
#include "apps/commands/daylight_command.h"
#include "apps/commands/daylight_year_command.h"
#include "apps/commands/exchange_command.h"
#include "apps/commands/form_factors_command.h"
#include "apps/commands/inspect_command.h"
#include "apps/commands/light_command.h"
#include "apps/commands/merge_command.h"
#include "apps/commands/render_command.h"
#include "apps/commands/solve_command.h"
#include "apps/commands/validate_command.h"
#include "apps/commands/view_command.h"
#include "apps/terminal/interruption.h"
#include "apps/terminal/terminal_progress.h"
#include "apps/terminal/usage_error.h"
#include "radiosity/base/error.h"
#include "radiosity/solve/solve.h"
#include "radiosity/version.h"

namespace {

constexpr int kFailureExit = 1;
constexpr int kUsageExit = 2;

int fail(int exit_code, std::string_view message) {
  fmt::print(stderr, "radiosity: error: {}\n", apps::one_line(message));
  return exit_code;
}

/// Parses the command line and runs the command; returns the exit code.
int run(CLI::App& program, apps::Interruption& interruption, int argc, char** argv) {
  try {
    program.parse(argc, argv);
    return 0;
  } catch (const CLI::Success& help_or_version) {
    return program.exit(help_or_version);
  } catch (const CLI::ParseError& error) {
    return fail(kUsageExit, apps::usage_message(program, error));
  } catch (const radiosity::Interrupted&) {
    interruption.tell();
    return apps::kInterruptedExit;
  } catch (const std::bad_alloc&) {
    return fail(kFailureExit, "out of memory; fewer patches need less (--patches N)");
  } catch (const std::exception& error) {
    return fail(kFailureExit, error.what());
  }
}

/// How many processes mpirun has started of this program, which would all do the same. Not srun,
/// which is a way to start parts, too.
int n_started() {
  const char* size = std::getenv("OMPI_COMM_WORLD_SIZE");
  return size != nullptr ? std::atoi(size) : 1;  // NOLINT(cert-err34-c): mpirun's
}

std::string version_text() {
  return fmt::format(
      "radiosity {}{}\nbuilt with {}", radiosity::kVersion,
      radiosity::kCommit.empty() ? "" : fmt::format(" (commit {})", radiosity::kCommit),
      RADIOSITY_LIBRARIES);
}

}  // namespace

int main(int argc, char** argv) {
  if (const int n = n_started(); n > 1) {
    // One of them tells it.
    const char* rank = std::getenv("OMPI_COMM_WORLD_RANK");
    if (rank != nullptr && std::string_view(rank) != "0") return kUsageExit;
    return fail(kUsageExit,
                fmt::format("started {} times over by mpirun, but this program knows no ranks; "
                            "expected radiosity-mpi (CMake option RADIOSITY_BUILD_MPI)",
                            n));
  }
  apps::Interruption interruption;
  CLI::App program("Radiosity: how light spreads between diffuse surfaces.", "radiosity");
  program.set_version_flag("--version", version_text());
  program.require_subcommand(1);
  const apps::SolveCommand solve(program, interruption);
  const apps::FormFactorsCommand form_factors(program, interruption);
  const apps::MergeCommand merge(program, interruption);
  const apps::ExchangeCommand exchange(program, interruption);
  const apps::ComfortCommand comfort(program, interruption);
  const apps::DaylightCommand daylight_factors(program, interruption);
  const apps::DaylightYearCommand daylight_year(program, interruption);
  const apps::InspectCommand inspect(program, interruption);
  const apps::LightCommand light(program, interruption);
  const apps::RenderCommand render(program, interruption);
  const apps::BatchCommand batch(program, interruption);
  const apps::ValidateCommand validate(program, interruption);
  const apps::ViewCommand view(program, interruption);
  return run(program, interruption, argc, argv);
}
