#pragma once

#include <string>
#include <vector>

#include "apps/solved_scene.h"
#include "radiosity/quantity.h"

namespace apps {

/// Prints the text on stdout. Throws OutputError if that fails (a full disk, say).
void print(const std::string& text);

/// Prints the summary of `solve` and `render`, with the quantities by surface: a table, or with
/// --json one JSON object.
void print_summary(const SolvedScene& solved, const std::vector<std::string>& outputs,
                   const CommonOptions& common, const TerminalProgress& terminal,
                   const std::vector<radiosity::QuantityField>& quantities = {});

}  // namespace apps
