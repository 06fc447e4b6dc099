#include <fmt/format.h>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <optional>
#include <string>

#include "apps/cluster/mpi_ranks.h"
#include "apps/cluster/petsc_solver.h"
#include "apps/cluster/quiet_rank.h"
#include "apps/commands/form_factors_command.h"
#include "apps/commands/solve_command.h"
#include "apps/terminal/interruption.h"
#include "apps/terminal/terminal_progress.h"
#include "apps/terminal/usage_error.h"
#include "radiosity/base/error.h"
#include "radiosity/version.h"

namespace {

constexpr int kFailureExit = 1;
constexpr int kUsageExit = 2;
/// How long a rank that has failed waits for the others to fail alike, as all do of a bad scene.
constexpr std::chrono::seconds kFailingTogether(5);

using Seconds = std::chrono::duration<double>;
/// How long a rank may be silent. Longer than a machine that is short of memory takes breath.
constexpr Seconds kPatience(300);
constexpr double kLeastPatience = 2;
constexpr double kMostPatience = 1e9;

/// How a rank has ended, and what it has to tell of that.
struct End {
  int exit_code = 0;
  std::string message;
};

End failed(int exit_code, std::string_view message) {
  return {exit_code, "radiosity-mpi: error: " + apps::one_line(message)};
}

/// Parses the command line and runs the command.
End run(CLI::App& program, apps::Interruption& interruption, int argc, char** argv) {
  try {
    program.parse(argc, argv);
    return {};
  } catch (const CLI::Success& help_or_version) {
    return {program.exit(help_or_version), ""};
  } catch (const CLI::ParseError& error) {
    return failed(kUsageExit, apps::usage_message(program, error));
  } catch (const radiosity::FirstRankFailed&) {
    return {};  // which tells
  } catch (const radiosity::Interrupted&) {
    interruption.tell();
    return {apps::kInterruptedExit, ""};
  } catch (const std::bad_alloc&) {
    return failed(kFailureExit, "out of memory; fewer patches or more ranks need less");
  } catch (const std::exception& error) {
    return failed(kFailureExit, error.what());
  }
}

/// Tells what has been used, on the first rank, unless that has failed. All ranks must have come to
/// their end together, and call this.
void tell_use(apps::MpiRanks& ranks, bool has_failed) {
  rusage use{};
  getrusage(RUSAGE_SELF, &use);
  const auto [most, moved] =
      ranks.most_of_all(static_cast<std::uint64_t>(use.ru_maxrss) * 1024, ranks.bytes_moved());
  const auto traffic = ranks.product_traffic();
  const auto [n_products, by_products] = ranks.most_of_all(traffic.products, traffic.bytes);
  if (ranks.rank() > 0 || has_failed) return;
  const std::string products =
      by_products == 0
          ? ""
          : fmt::format("; {:.1f} MB of these in {} products, {:.3g} MB each",
                        static_cast<double>(by_products) * 1e-6, n_products,
                        static_cast<double>(by_products) * 1e-6 / static_cast<double>(n_products));
  fmt::print(
      stderr,
      "radiosity-mpi: {} ranks, each took {:.1f} MB at most, sent and received {:.1f} MB{}\n",
      ranks.size(), static_cast<double>(most) * 1e-6, static_cast<double>(moved) * 1e-6, products);
}

/// mpirun may bind ranks to so few cores that others idle, which nothing else tells.
void warn_of_idle_cores(const apps::MpiRanks& ranks) {
  cpu_set_t own;
  const long n_cores = ::sysconf(_SC_NPROCESSORS_ONLN);
  if (ranks.rank() > 0 || ::sched_getaffinity(0, sizeof own, &own) != 0) return;
  const int n_own = CPU_COUNT(&own);
  if (static_cast<long>(n_own) * ranks.n_on_machine() >= n_cores) return;
  fmt::print(stderr,
             "radiosity-mpi: warning: mpirun has bound each rank to {} of {} cores, more threads "
             "cannot use others; 'mpirun --bind-to none' lets them\n",
             n_own, n_cores);
}

bool is_quiet(const CLI::App& program) {
  const auto commands = program.get_subcommands();
  if (commands.empty()) return true;
  const CLI::Option* quiet = commands.front()->get_option_no_throw("--quiet");
  return quiet == nullptr || quiet->count() > 0;
}

/// --timeout, of all commands.
void add_timeout(CLI::App& program, apps::MpiRanks& ranks) {
  for (CLI::App* command : program.get_subcommands({})) {
    command
        ->add_option_function<double>(
            "--timeout", [&ranks](double seconds) { ranks.set_patience(Seconds(seconds)); },
            "End all ranks if nothing is heard of one, or none gets on, for so many seconds; 0: "
            "wait for ever")
        ->check(CLI::Range(0., kMostPatience))
        ->check([](const std::string& text) {
          const double seconds = std::strtod(text.c_str(), nullptr);
          return seconds == 0 || seconds >= kLeastPatience ? std::string()
                                                           : "expected 0 or at least 2 seconds";
        })
        ->default_str(fmt::format("{:.0f}", kPatience.count()))
        ->type_name("SECONDS");
  }
}

}  // namespace

int main(int argc, char** argv) {
  apps::Interruption interruption;
  apps::MpiRanks ranks(argc, argv);
  const apps::QuietRank output(ranks.rank());
  ranks.watch(kPatience, [&](const std::string& line) {
    output.tell("radiosity-mpi: error: " + line);
    ranks.abort(kFailureExit);
  });
  CLI::App program(
      "Radiosity by several processes together, on one machine or many: start it by mpirun.",
      "radiosity-mpi");
  program.set_version_flag("--version", fmt::format("radiosity-mpi {}", radiosity::kVersion));
  program.require_subcommand(1);
  std::optional<apps::PetscSolver> petsc;
  const apps::SolveCommand solve(program, interruption, &ranks, [&](const std::string& options) {
    if (!petsc) petsc.emplace(ranks, options);
    return petsc->solver();
  });
  const apps::FormFactorsCommand form_factors(program, interruption, &ranks);
  add_timeout(program, ranks);
  warn_of_idle_cores(ranks);
  const End end = run(program, interruption, argc, argv);
  std::fflush(stdout);
  if (ranks.rank() == 0 && !end.message.empty()) output.tell(end.message);
  const bool has_failed = end.exit_code != 0;
  if (!ranks.end_together(has_failed ? kFailingTogether : std::chrono::seconds::max())) {
    if (ranks.rank() > 0 && !end.message.empty()) {
      output.tell(fmt::format("{} (rank {})", end.message, ranks.rank()));
    }
    ranks.abort(end.exit_code);
  }
  if (!is_quiet(program)) tell_use(ranks, has_failed);
  return end.exit_code;
}
