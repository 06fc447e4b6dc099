#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "apps/validation/plot/svg_plot.h"
#include "apps/validation/plot/svg_text.h"
#include "apps/validation/report/report.h"
#include "io/base/xml_escaped.h"

namespace apps::validation {
namespace {

using Status = CaseOutcome::Status;

constexpr const char* kStyle = R"(
:root { color-scheme: light; }
body { font: 16px/1.5 system-ui, -apple-system, "Segoe UI", Helvetica, Arial, sans-serif;
  color: #222; background: #fff; max-width: 60rem; margin: 0 auto; padding: 1rem 1rem 4rem; }
h1 { font-size: 1.6rem; line-height: 1.2; margin: 1rem 0 .3rem; }
h2 { font-size: 1.25rem; line-height: 1.3; margin: 3rem 0 .5rem; padding-top: 1rem;
  border-top: 1px solid #ccc; }
p, ul { max-width: 46rem; margin: .5rem 0; }
a { color: #0b5394; }
.facts { color: #555; font-size: .9rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-size: .92rem; margin: .8rem 0; }
caption { text-align: left; font-weight: 600; padding: .3rem 0; }
th { text-align: left; font-weight: 600; border-bottom: 2px solid #888; }
th, td { padding: .35rem .6rem .35rem 0; vertical-align: top; }
td { border-bottom: 1px solid #e2e2e2; }
.number { text-align: right; white-space: nowrap; font-variant-numeric: tabular-nums; }
.why { color: #555; font-size: .86rem; max-width: 38rem; }
.passed { color: #146c2e; } .failed { color: #b3261e; font-weight: 700; }
.skipped { color: #7a5c00; }
.passed, .failed, .skipped { white-space: nowrap; }
.note { background: #fff8e1; border-left: 3px solid #d9a400; padding: .4rem .8rem; }
ul.note { padding-left: 2rem; font-size: .92rem; }
.message { background: #fdecea; border-left: 3px solid #b3261e; padding: .4rem .8rem; }
figure { margin: 1.2rem 0; max-width: 38rem; break-inside: avoid; }
figcaption { font-weight: 600; font-size: .92rem; margin-bottom: .3rem; }
svg { width: 100%; height: auto; display: block; }
@media (max-width: 36rem) { .summary .minor { display: none; } }
@media print { body { font-size: 10pt; max-width: none; padding: 0; }
  h2 { break-after: avoid; } tr { break-inside: avoid; } a { color: inherit; } }
)";

/// Text put together piece by piece.
struct Page {
  std::string html;

  template <typename... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(html), format, std::forward<Args>(args)...);
  }
};

std::string mark(Status status) {
  const char* sign = status == Status::passed ? "✓" : status == Status::failed ? "✗" : "–";
  return fmt::format("<span class=\"{0}\">{1} {0}</span>", status_name(status), sign);
}

std::string mark(const Check& check) {
  return mark(check.passed() ? Status::passed : Status::failed);
}

std::string with_unit(double value, const std::string& unit) {
  return fmt::format("{:.3g}{}{}", value, unit.empty() ? "" : " ", io::xml_escaped(unit));
}

std::string asked(const Check& check) {
  const char* sign = check.relation == Check::Relation::at_most ? "≤" : "≥";
  return fmt::format("{} {}", sign, with_unit(check.tolerance, check.unit));
}

/// The check that comes nearest to failing, or has failed by most. None without checks.
const Check* tightest(const std::vector<Check>& checks) {
  const auto strain = [](const Check& check) {
    const bool is_upper = check.relation == Check::Relation::at_most;
    const double larger = is_upper ? check.value : check.tolerance;
    const double smaller = is_upper ? check.tolerance : check.value;
    if (larger <= smaller) return smaller > 0 ? larger / smaller : 1;
    return smaller > 0 ? larger / smaller : 1e300;
  };
  const auto found =
      std::max_element(checks.begin(), checks.end(),
                       [&](const Check& a, const Check& b) { return strain(a) < strain(b); });
  return found == checks.end() ? nullptr : &*found;
}

void add_summary(Page& page, const Report& report) {
  page.add(
      "<div class=\"wide\"><table class=\"summary\"><thead><tr><th>Case</th><th>Verdict</th>"
      "<th class=\"number minor\">Checks</th><th class=\"number minor\">Seconds</th>"
      "<th>The figure nearest to its limit</th></tr></thead><tbody>\n");
  for (const CaseOutcome& outcome : report.outcomes) {
    const std::vector<Check>& checks = outcome.result.checks;
    const auto n = std::count_if(checks.begin(), checks.end(),
                                 [](const Check& check) { return check.passed(); });
    std::string last = io::xml_escaped(outcome.message);
    if (const Check* check = tightest(checks)) {
      last = fmt::format("{}: {} ({})", io::xml_escaped(check->what),
                         with_unit(check->value, check->unit), asked(*check));
    }
    page.add(
        "<tr><td><a href=\"#{0}\">{0}</a></td><td>{1}</td><td class=\"number minor\">{2} / {3}</td>"
        "<td class=\"number minor\">{4:.1f}</td><td>{5}</td></tr>\n",
        io::xml_escaped(outcome.name), mark(outcome.status), n, checks.size(), outcome.seconds,
        last);
  }
  page.add("</tbody></table></div>\n");
}

void add_checks(Page& page, const std::vector<Check>& checks) {
  page.add(
      "<div class=\"wide\"><table><thead><tr><th>Figure</th><th class=\"number\">Measured</th>"
      "<th class=\"number\">Asked</th><th>Verdict</th></tr></thead><tbody>\n");
  std::string last;  // a derivation is told once for a run of checks that share it
  for (const Check& check : checks) {
    const std::string why =
        check.derivation == last ? "As above." : io::xml_escaped(check.derivation);
    last = check.derivation;
    page.add(
        "<tr><td>{}<div class=\"why\">{}</div></td><td class=\"number\">{}</td>"
        "<td class=\"number\">{}</td><td>{}</td></tr>\n",
        io::xml_escaped(check.what), why, with_unit(check.value, check.unit), asked(check),
        mark(check));
  }
  page.add("</tbody></table></div>\n");
}

void add_row(Page& page, const std::vector<std::string>& cells, const char* tag) {
  page.add("<tr>");
  for (std::size_t k = 0; k < cells.size(); ++k) {
    page.add("<{0}{1}>{2}</{0}>", tag, k > 0 ? " class=\"number\"" : "", io::xml_escaped(cells[k]));
  }
  page.add("</tr>\n");
}

struct FigureWriter {
  Page& page;

  void operator()(const Table& table) const {
    page.add("<div class=\"wide\"><table><caption>{}</caption><thead>",
             io::xml_escaped(table.title));
    add_row(page, table.header, "th");
    page.add("</thead><tbody>\n");
    for (const auto& row : table.rows) add_row(page, row, "td");
    page.add("</tbody></table></div>\n");
  }

  template <typename Drawing>
  void operator()(const Drawing& drawing) const {
    page.add("<figure><figcaption>{}</figcaption>{}</figure>\n", io::xml_escaped(drawing.title),
             svg(drawing));
  }
};

void add_notes(Page& page, const std::vector<std::string>& notes) {
  if (notes.empty()) return;
  page.add("<ul class=\"note\">");
  for (const std::string& note : notes) page.add("<li>{}</li>\n", io::xml_escaped(note));
  page.add("</ul>\n");
}

void add_case(Page& page, const CaseOutcome& outcome) {
  page.add(
      "<section><h2 id=\"{0}\">{1}</h2>\n<p class=\"facts\"><code>{0}</code> · {2} · {3:.1f} s"
      "</p>\n",
      io::xml_escaped(outcome.name), io::xml_escaped(outcome.title), mark(outcome.status),
      outcome.seconds);
  if (!outcome.message.empty()) {
    page.add("<p class=\"{}\">{}</p>\n", outcome.status == Status::skipped ? "note" : "message",
             io::xml_escaped(outcome.message));
  }
  const CaseResult& result = outcome.result;
  if (!result.compared.empty()) {
    page.add("<p><strong>Compared:</strong> {}</p>\n<p><strong>With:</strong> {}</p>\n",
             io::xml_escaped(result.compared), io::xml_escaped(result.reference));
  }
  if (!result.checks.empty()) add_checks(page, result.checks);
  add_notes(page, result.notes);
  for (const Figure& figure : result.figures) std::visit(FigureWriter{page}, figure);
  page.add("</section>\n");
}

std::string verdict(const std::vector<CaseOutcome>& outcomes) {
  const auto count = [&](Status status) {
    return std::count_if(outcomes.begin(), outcomes.end(),
                         [&](const CaseOutcome& outcome) { return outcome.status == status; });
  };
  std::string text = fmt::format("{} of {} cases passed", count(Status::passed), outcomes.size());
  if (count(Status::failed) > 0) text += fmt::format(", {} failed", count(Status::failed));
  if (count(Status::skipped) > 0) text += fmt::format(", {} skipped", count(Status::skipped));
  return text;
}

}  // namespace

std::string report_html(const Report& report) {
  double seconds = 0;
  for (const CaseOutcome& outcome : report.outcomes) seconds += outcome.seconds;
  Page page;
  page.add(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
      "<title>Validation of radiosity {}</title><style>{}</style></head><body>\n",
      io::xml_escaped(report.version), kStyle);
  page.add("<h1>Validation of radiosity {}</h1>\n<p><strong>{}.</strong></p>\n",
           io::xml_escaped(report.version), verdict(report.outcomes));
  page.add("<p class=\"facts\">{} · {} · threads: {} · seed {} · {:.0f} s in all</p>\n",
           io::xml_escaped(report.date), io::xml_escaped(report.machine), report.n_threads,
           report.seed, seconds);
  page.add(
      "<p>Every case compares what the program computes with something that is known without "
      "it. Under each figure stands what its limit is derived from.</p>\n");
  add_summary(page, report);
  for (const CaseOutcome& outcome : report.outcomes) add_case(page, outcome);
  page.add("</body></html>\n");
  return page.html;
}

}  // namespace apps::validation
