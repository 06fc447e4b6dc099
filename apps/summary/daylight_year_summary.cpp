#include "apps/summary/daylight_year_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/summary/text_table.h"
#include "apps/terminal/terminal_progress.h"
#include "io/base/printable.h"

namespace apps {
namespace {

/// Points are shown if they are no more.
constexpr std::size_t kMostYearsShown = 60;

std::vector<Row> year_rows(const DaylightYearSummary& summary) {
  std::vector<Row> rows = {
      {"at", summary.is_photometric ? "mean, lx" : "mean, W/m²", "autonomy, %", "useful, %"}};
  for (std::size_t k = 0; k < summary.points.size(); ++k) {
    const radiosity::Vec3& x = summary.points[k].position;
    const PointYear& year = summary.years[k];
    rows.push_back({fmt::format("{:.6g}, {:.6g}, {:.6g}", x[0], x[1], x[2]),
                    fmt::format("{:.1f}", year.mean), fmt::format("{:.1f}", 100 * year.autonomy),
                    fmt::format("{:.1f}", 100 * year.useful)});
  }
  return rows;
}

}  // namespace

std::string daylight_year_text(const DaylightYearSummary& summary) {
  const study::Study& study = summary.study;
  std::string result = line("scene", one_line(study.scene.source));
  result += line("patches", fmt::format("{} on {} surfaces", study.mesh.size(),
                                        study.mesh.surface_names.size()));
  result += line("hours", fmt::format("{}, {} with light; {} parts of the sky", summary.n_hours,
                                      summary.n_light, summary.n_parts));
  if (summary.points.size() <= kMostYearsShown) result += table(year_rows(summary));
  result +=
      line("autonomy", fmt::format("{:.1f} % of {} points have {:g} {} in half of the hours",
                                   100 * spatial_autonomy(summary.years), summary.points.size(),
                                   summary.threshold, summary.is_photometric ? "lx" : "W/m²"));
  for (const std::string& output : summary.outputs) result += line("written", one_line(output));
  return result;
}

std::string daylight_year_json(const DaylightYearSummary& summary,
                               const std::vector<std::string>& warnings) {
  nlohmann::ordered_json points = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < summary.points.size(); ++k) {
    const radiosity::Vec3& x = summary.points[k].position;
    const PointYear& year = summary.years[k];
    points.push_back({{"position", {x[0], x[1], x[2]}},
                      {"mean", year.mean},
                      {"autonomy", year.autonomy},
                      {"useful", year.useful}});
  }
  const nlohmann::ordered_json json = {{"patches", summary.study.mesh.size()},
                                       {"hours", summary.n_hours},
                                       {"hours_with_light", summary.n_light},
                                       {"sky_parts", summary.n_parts},
                                       {"threshold", summary.threshold},
                                       {"spatial_autonomy", spatial_autonomy(summary.years)},
                                       {"points", points},
                                       {"outputs", summary.outputs},
                                       {"warnings", warnings}};
  return io::printable_json(
      json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

}  // namespace apps
