#include "apps/run/shown_events.h"

#include <string>
#include <string_view>

namespace apps {

TerminalProgress::Style terminal_style(const CommonOptions& common) {
  return common.quiet ? TerminalProgress::Style::none : TerminalProgress::fitting_style();
}

study::StudyEvents shown_events(TerminalProgress& terminal, const Interruption& interruption) {
  const auto report = [&terminal](std::string_view stage, double done, double total,
                                  std::string_view unit) {
    terminal.report(stage, done, total, unit);
  };
  return {.warned = [&terminal](const std::string& message) { terminal.warn(message); },
          .progress = {.report = report, .stop = interruption.token()}};
}

}  // namespace apps
