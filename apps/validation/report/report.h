#pragma once

#include <string>
#include <vector>

#include "apps/validation/cases/case.h"

namespace apps::validation {

/// How a case ended.
struct CaseOutcome {
  enum class Status { passed, failed, skipped };
  std::string name;
  std::string title;
  Status status = Status::failed;
  std::string message{};  ///< why it was skipped or broke off; else empty
  CaseResult result{};
  double seconds = 0;  ///< wall time
};

/// "passed", "failed" or "skipped".
const char* status_name(CaseOutcome::Status status);

/// Runs the case. What it throws becomes a failure with that message, but for Interrupted and
/// std::bad_alloc. A case without checks fails.
CaseOutcome run_case(const Case& validation_case, const Context& context);

/// All that a page tells.
struct Report {
  std::string version;
  std::string machine;
  std::string date;  ///< ISO 8601, UTC
  std::size_t n_threads = 0;
  std::uint64_t seed = 0;
  std::vector<CaseOutcome> outcomes{};
};

/// The report as a page that needs no other file and no scripts.
std::string report_html(const Report& report);

/// The report as a JSON object (docs/command-line.md). What is not a finite number is null.
std::string report_json(const Report& report);

/// A line per case: name, status, checks passed, seconds, and what is wrong.
std::string outcome_line(const CaseOutcome& outcome);

}  // namespace apps::validation
