#include "apps/summary/summary.h"

#include <cstdio>

#include "apps/summary/json_summary.h"
#include "apps/summary/text_summary.h"
#include "radiosity/base/error.h"

namespace apps {

void print(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  if (text.empty() || text.back() != '\n') std::fputc('\n', stdout);
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    throw radiosity::OutputError("the summary cannot be written to standard output");
  }
}

void print_summary(const SolveSummary& summary, const CommonOptions& common,
                   const TerminalProgress& terminal) {
  print(common.json ? solve_json(summary, terminal.warnings()) : solve_text(summary));
}

}  // namespace apps
