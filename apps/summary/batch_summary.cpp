#include "apps/summary/batch_summary.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>

#include "apps/summary/text_table.h"
#include "apps/terminal/terminal_progress.h"
#include "io/base/atomic_file.h"
#include "io/base/csv_field.h"
#include "io/base/extension.h"
#include "io/base/json_item.h"
#include "io/base/printable.h"

namespace apps {
namespace {

using io::Json;

constexpr BatchStatus kAllStatuses[] = {BatchStatus::done, BatchStatus::kept, BatchStatus::failed,
                                        BatchStatus::stopped, BatchStatus::waiting};

/// What the run printed, or null.
Json summary_of(const BatchResult& result) {
  Json summary = Json::parse(result.record.summary, nullptr, false);
  return summary.is_object() ? summary : Json();
}

Json find(const Json& summary, const char* key) {
  return summary.is_object() && summary.contains(key) ? summary[key] : Json();
}

bool has_run(const BatchResult& result) { return result.status != BatchStatus::waiting; }

Json entry_json(const BatchResult& result) {
  const Json summary = summary_of(result);
  return {{"name", result.entry.name},
          {"scene", result.entry.scene},
          {"command", command_line(result.entry)},
          {"status", status_name(result.status)},
          {"exit_code", has_run(result) ? Json(result.exit_code) : Json()},
          {"seconds", has_run(result) ? Json(result.record.seconds) : Json()},
          {"memory", has_run(result) ? Json(result.record.peak_memory) : Json()},
          {"message", result.message},
          {"summary", summary}};
}

}  // namespace

std::size_t count(const std::vector<BatchResult>& results, BatchStatus status) {
  return static_cast<std::size_t>(
      std::count_if(results.begin(), results.end(),
                    [&](const BatchResult& result) { return result.status == status; }));
}

std::string batch_text(const std::vector<BatchResult>& results) {
  std::vector<Row> rows{{"entry", "status", "seconds", "memory", "patches"}};
  for (const BatchResult& result : results) {
    const Json patches = find(summary_of(result), "patches");
    rows.push_back(
        {one_line(result.entry.name), std::string(status_name(result.status)),
         has_run(result) ? fmt::format("{:.1f}", result.record.seconds) : "",
         has_run(result)
             ? fmt::format("{:.0f} MB", 1e-6 * static_cast<double>(result.record.peak_memory))
             : "",
         patches.is_number() ? patches.dump() : ""});
  }
  std::string text = table(rows);
  for (const BatchResult& result : results) {
    if (result.status == BatchStatus::failed) {
      text += fmt::format("{}: {}\n", one_line(result.entry.name), one_line(result.message));
    }
  }
  std::vector<std::string> counts;
  for (const BatchStatus status : kAllStatuses) {
    const std::size_t n = count(results, status);
    if (n > 0) counts.push_back(fmt::format("{} {}", n, status_name(status)));
  }
  return text + line("entries", fmt::format("{}", fmt::join(counts, ", ")));
}

std::string batch_json(const std::vector<BatchResult>& results) {
  Json json;
  for (const BatchStatus status : kAllStatuses) {
    json[std::string(status_name(status))] = count(results, status);
  }
  json["entries"] = Json::array();
  for (const BatchResult& result : results) json["entries"].push_back(entry_json(result));
  return io::printable_json(json.dump(2, ' ', false, Json::error_handler_t::replace));
}

std::string batch_csv(const std::vector<BatchResult>& results) {
  std::string text =
      "entry,scene,command,status,exit_code,seconds,memory,patches,warnings,outputs,message\n";
  for (const BatchResult& result : results) {
    const Json summary = summary_of(result);
    const Json patches = find(summary, "patches");
    text += fmt::format(
        "{},{},{},{},{},{},{},{},{},{},{}\n", io::csv_field(result.entry.name),
        io::csv_field(result.entry.scene), io::csv_field(result.entry.command),
        status_name(result.status), has_run(result) ? fmt::format("{}", result.exit_code) : "",
        has_run(result) ? fmt::format("{:.3f}", result.record.seconds) : "",
        has_run(result) ? fmt::format("{}", result.record.peak_memory) : "",
        patches.is_number() ? patches.dump() : "",
        summary.is_object() ? fmt::format("{}", find(summary, "warnings").size()) : "",
        io::csv_field(fmt::format("{}", fmt::join(result.entry.outputs, " "))),
        io::csv_field(result.message));
  }
  return text;
}

void write_batch_table(const std::filesystem::path& path, const std::vector<BatchResult>& results) {
  const bool is_csv = io::lower_case_extension(path) == ".csv";
  io::write_stream_atomically(path, [&](std::ofstream& file) {
    file << (is_csv ? batch_csv(results) : batch_json(results) + "\n");
  });
}

}  // namespace apps
