#pragma once

#include <string>

#include "apps/options/common_options.h"
#include "apps/summary/solve_summary.h"
#include "apps/terminal/terminal_progress.h"

namespace apps {

/// Prints the text on stdout. Throws OutputError if that fails (a full disk, say).
void print(const std::string& text);

/// Prints the summary of `solve` and `render`: a table, or with --json one JSON object.
void print_summary(const SolveSummary& summary, const CommonOptions& common,
                   const TerminalProgress& terminal);

}  // namespace apps
