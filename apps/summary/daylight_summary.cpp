#include "apps/summary/daylight_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/summary/text_table.h"
#include "apps/terminal/terminal_progress.h"
#include "io/base/printable.h"

namespace apps {
namespace {

using study::DaylightFactor;

/// Points are shown if they are no more.
constexpr std::size_t kMostPointsShown = 60;

/// The places that are measured, and what is told of them.
struct Totals {
  std::size_t n = 0;
  DaylightFactor mean;
  double least = 0;
  double greatest = 0;
};

Totals totals(const DaylightSummary& summary) {
  Totals result;
  for (std::size_t k = 0; k < summary.factors.size(); ++k) {
    if (summary.places[k] != radiosity::PointPlace::open) continue;
    const DaylightFactor& there = summary.factors[k];
    result.least = result.n == 0 ? there.total() : std::min(result.least, there.total());
    result.greatest = std::max(result.greatest, there.total());
    result.mean.sky += there.sky;
    result.mean.external += there.external;
    result.mean.internal += there.internal;
    result.mean.error = std::max(result.mean.error, there.error);
    ++result.n;
  }
  const double n = std::max<double>(1, static_cast<double>(result.n));
  result.mean.sky /= n;
  result.mean.external /= n;
  result.mean.internal /= n;
  return result;
}

std::string percent(double share) { return fmt::format("{:.4f}", 100 * share); }

std::vector<Row> point_rows(const DaylightSummary& summary) {
  std::vector<Row> rows = {{"at", "daylight factor, %", "sky", "external", "internal"}};
  for (std::size_t k = 0; k < summary.points.size(); ++k) {
    const radiosity::Vec3& x = summary.points[k].position;
    Row row = {fmt::format("{:.6g}, {:.6g}, {:.6g}", x[0], x[1], x[2])};
    if (summary.places[k] == radiosity::PointPlace::open) {
      const DaylightFactor& there = summary.factors[k];
      for (const double share : {there.total(), there.sky, there.external, there.internal}) {
        row.push_back(percent(share));
      }
    } else {
      row.insert(row.end(), {"(in a solid)", "-", "-", "-"});
    }
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

std::string daylight_text(const DaylightSummary& summary) {
  const study::Study& study = summary.study;
  const Totals all = totals(summary);
  std::string result = line("scene", one_line(study.scene.source));
  result += line("patches", fmt::format("{} on {} surfaces", study.mesh.size(),
                                        study.mesh.surface_names.size()));
  result += line("sky", fmt::format("{:.6g} {} on an open horizontal surface", summary.horizontal,
                                    summary.is_photometric ? "lx" : "W/m²"));
  result += line("points",
                 fmt::format("{} measured, {} in solids", all.n, summary.points.size() - all.n));
  if (summary.points.size() <= kMostPointsShown) result += table(point_rows(summary));
  result += line("mean", fmt::format("{} %: {} from the sky, {} external, {} internal",
                                     percent(all.mean.total()), percent(all.mean.sky),
                                     percent(all.mean.external), percent(all.mean.internal)));
  result +=
      line("least", fmt::format("{} %, greatest {} %", percent(all.least), percent(all.greatest)));
  for (const std::string& output : summary.outputs) result += line("written", one_line(output));
  return result;
}

std::string daylight_json(const DaylightSummary& summary,
                          const std::vector<std::string>& warnings) {
  const Totals all = totals(summary);
  nlohmann::ordered_json points = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < summary.points.size(); ++k) {
    const radiosity::Vec3& x = summary.points[k].position;
    nlohmann::ordered_json point = {{"position", {x[0], x[1], x[2]}}};
    if (summary.places[k] == radiosity::PointPlace::open) {
      const DaylightFactor& there = summary.factors[k];
      point["daylight_factor"] = there.total();
      point["sky"] = there.sky;
      point["external"] = there.external;
      point["internal"] = there.internal;
      point["error"] = there.error;
    }
    points.push_back(point);
  }
  const nlohmann::ordered_json json = {
      {"patches", summary.study.mesh.size()},
      {summary.is_photometric ? "horizontal_illuminance" : "horizontal_irradiance",
       summary.horizontal},
      {"measured", all.n},
      {"mean", all.mean.total()},
      {"least", all.least},
      {"greatest", all.greatest},
      {"points", points},
      {"outputs", summary.outputs},
      {"warnings", warnings}};
  return io::printable_json(
      json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

}  // namespace apps
