#include "apps/validation/report/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <new>

namespace apps::validation {
namespace {

using Status = CaseOutcome::Status;

std::ptrdiff_t n_passed(const CaseResult& result) {
  return std::count_if(result.checks.begin(), result.checks.end(),
                       [](const Check& check) { return check.passed(); });
}

/// The case's result, or why there is none.
void run_into(CaseOutcome& outcome, const Case& validation_case, const Context& context) {
  try {
    outcome.result = validation_case.run(context);
    const auto n = static_cast<std::ptrdiff_t>(outcome.result.checks.size());
    const bool is_passed = n > 0 && n_passed(outcome.result) == n;
    outcome.status = is_passed ? Status::passed : Status::failed;
    if (n == 0) outcome.message = "the case checked nothing";
  } catch (const Skipped& reason) {
    outcome.status = Status::skipped;
    outcome.message = reason.what();
  } catch (const radiosity::Interrupted&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    outcome.message = error.what();
  }
}

}  // namespace

const char* status_name(Status status) {
  switch (status) {
    case Status::passed:
      return "passed";
    case Status::failed:
      return "failed";
    case Status::skipped:
      break;
  }
  return "skipped";
}

CaseOutcome run_case(const Case& validation_case, const Context& context) {
  CaseOutcome outcome{.name = validation_case.name, .title = validation_case.title};
  const auto start = std::chrono::steady_clock::now();
  run_into(outcome, validation_case, context);
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return outcome;
}

std::string outcome_line(const CaseOutcome& outcome) {
  std::string line = fmt::format("{:<20}  {:<7}  {:>3} of {:>3} checks  {:>6.1f} s", outcome.name,
                                 status_name(outcome.status), n_passed(outcome.result),
                                 outcome.result.checks.size(), outcome.seconds);
  if (!outcome.message.empty()) line += "  " + outcome.message;
  for (const Check& check : outcome.result.checks) {
    if (check.passed()) continue;
    const bool is_upper = check.relation == Check::Relation::at_most;
    line += fmt::format("\n  failed: {}: {:.3g}{}{}, expected {} {:.3g}", check.what, check.value,
                        check.unit.empty() ? "" : " ", check.unit,
                        is_upper ? "at most" : "at least", check.tolerance);
  }
  return line;
}

}  // namespace apps::validation
