#include "apps/summary/comfort_summary.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "apps/summary/text_table.h"
#include "apps/terminal/terminal_progress.h"
#include "io/base/printable.h"

namespace apps {
namespace {

constexpr std::size_t kMostPersonsShown = 50;
constexpr double kZeroCelsius = 273.15;  // K

using Document = nlohmann::ordered_json;

}  // namespace

std::string comfort_text(const ComfortSummary& summary) {
  const study::Study& study = summary.study;
  std::string result = line("scene", one_line(study.scene.source));
  result += line("patches", fmt::format("{} on {} surfaces", study.mesh.size(),
                                        study.mesh.surface_names.size()));
  result += line("person", summary.posture + ", " + summary.body);
  std::vector<Row> rows = {
      {"at, m", "mean radiant, K", "°C", "up", "down", "front", "back", "left", "right"}};
  for (const study::ComfortPoint& point : summary.points) {
    if (rows.size() > kMostPersonsShown) break;
    Row row = {
        fmt::format("{:g},{:g},{:g}", point.position.x(), point.position.y(), point.position.z()),
        fmt::format("{:.3f}", point.mean_radiant_temperature),
        fmt::format("{:.3f}", point.mean_radiant_temperature - kZeroCelsius)};
    for (const double kelvin : point.plane_temperatures)
      row.push_back(fmt::format("{:.2f}", kelvin));
    rows.push_back(std::move(row));
  }
  result += table(rows);
  if (summary.points.size() > kMostPersonsShown) {
    result +=
        line("  and", fmt::format("{} points more", summary.points.size() - kMostPersonsShown));
  }
  for (const std::string& output : summary.outputs) result += line("written", one_line(output));
  return result;
}

std::string comfort_json(const ComfortSummary& summary, const std::vector<std::string>& warnings) {
  Document points = Document::array();
  for (const study::ComfortPoint& point : summary.points) {
    Document factors = Document::object();
    for (radiosity::Index s = 0; s < point.surfaces.size(); ++s) {
      factors[summary.study.mesh.surface_names[static_cast<std::size_t>(s)]] = point.surfaces[s];
    }
    points.push_back({{"position", {point.position.x(), point.position.y(), point.position.z()}},
                      {"mean_radiant_temperature", point.mean_radiant_temperature},
                      {"plane_radiant_temperatures", point.plane_temperatures},
                      {"factors", std::move(factors)},
                      {"backs", point.backs},
                      {"sky", point.sky}});
  }
  const Document json = {
      {"patches", summary.study.mesh.size()}, {"posture", summary.posture}, {"body", summary.body},
      {"points", std::move(points)},          {"outputs", summary.outputs}, {"warnings", warnings}};
  return io::printable_json(json.dump(2, ' ', false, Document::error_handler_t::replace));
}

}  // namespace apps
