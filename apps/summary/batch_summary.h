#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/run/batch_run.h"

namespace apps {

/// How many entries there are of a status.
std::size_t count(const std::vector<BatchResult>& results, BatchStatus status);

/// A table for the terminal, with a line for each entry and one of totals.
std::string batch_text(const std::vector<BatchResult>& results);
/// One JSON object; each entry has the `summary` that its run printed.
std::string batch_json(const std::vector<BatchResult>& results);
/// A line for each entry.
std::string batch_csv(const std::vector<BatchResult>& results);

/// Writes the table as the extension says, .csv or .json. Throws OutputError.
void write_batch_table(const std::filesystem::path& path, const std::vector<BatchResult>& results);

}  // namespace apps
