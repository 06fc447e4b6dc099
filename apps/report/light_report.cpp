#include "apps/report/light_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>

#include "io/base/printable.h"
#include "io/base/xml_escaped.h"
#include "io/light/polar_curve.h"
#include "radiosity/scene/luminaire_flux.h"
#include "radiosity/solve/quantity.h"

namespace apps {
namespace {

using radiosity::Index;

constexpr const char* kStyle = R"(
:root { color-scheme: light; }
body { font: 15px/1.45 system-ui, -apple-system, "Segoe UI", Helvetica, Arial, sans-serif;
  color: #222; background: #fff; max-width: 62rem; margin: 0 auto; padding: 1rem 1rem 4rem; }
h1 { font-size: 1.6rem; line-height: 1.2; margin: 1rem 0 .3rem; }
h2 { font-size: 1.2rem; margin: 2.2rem 0 .4rem; padding-top: .8rem; border-top: 1px solid #ccc; }
h3 { font-size: 1rem; margin: 1.4rem 0 .3rem; }
p, ul { max-width: 48rem; margin: .4rem 0; }
.facts { color: #555; font-size: .9rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: .86rem; margin: .6rem 0; min-width: 50%; }
th { text-align: left; font-weight: 600; border-bottom: 2px solid #888; }
th, td { padding: .25rem .8rem .25rem 0; vertical-align: top; }
td { border-bottom: 1px solid #e2e2e2; }
.number { text-align: right; white-space: nowrap; font-variant-numeric: tabular-nums; }
.name { white-space: nowrap; }
.met { color: #146c2e; white-space: nowrap; } .missed { color: #b3261e; font-weight: 700;
  white-space: nowrap; }
.note { background: #fff8e1; border-left: 3px solid #d9a400; padding: .4rem .8rem .4rem 2rem; }
figure { margin: .8rem 0; break-inside: avoid; }
svg { max-width: 100%; height: auto; display: block; }
@media print { body { font-size: 10pt; max-width: none; padding: 0; }
  h2, h3 { break-after: avoid; } tr { break-inside: avoid; }
  table { font-size: 8pt; } th, td { padding-right: .5rem; } .wide { overflow: visible; }
  * { -webkit-print-color-adjust: exact; print-color-adjust: exact; } }
)";

std::string escaped(std::string_view text) { return io::xml_escaped(io::printable(text)); }

/// Text put together piece by piece.
struct Html {
  std::string text;

  template <typename... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text), format, std::forward<Args>(args)...);
  }

  /// The first `n_words` columns are words, the others numbers; cells are HTML.
  void table(const std::vector<std::vector<std::string>>& rows, std::size_t n_words = 1) {
    add("<div class=\"wide\"><table>\n");
    for (std::size_t r = 0; r < rows.size(); ++r) {
      add("<tr>");
      for (std::size_t c = 0; c < rows[r].size(); ++c) {
        add("<{0}{1}>{2}</{0}>", r == 0 ? "th" : "td", c < n_words ? "" : " class=\"number\"",
            rows[r][c]);
      }
      add("</tr>\n");
    }
    add("</table></div>\n");
  }
};

std::string mark(bool is_met) {
  return is_met ? "<span class=\"met\">✓ met</span>" : "<span class=\"missed\">✗ not met</span>";
}

/// 0..1 by the eye's weights; of bands that it does not see the mean.
double luminous_reflectance(const Eigen::VectorXd& reflectance, const Eigen::VectorXd& weights) {
  const double sum = weights.sum();
  return sum > 0 ? weights.dot(reflectance) / sum : reflectance.mean();
}

std::vector<double> areas(const radiosity::PatchMesh& mesh) {
  std::vector<double> result(mesh.surface_names.size(), 0);
  for (Index i = 0; i < mesh.size(); ++i) {
    result[static_cast<std::size_t>(mesh.surface[i])] += mesh.area[i];
  }
  return result;
}

void add_verdict(Html& page, const LightSummary& summary) {
  if (summary.checks.empty()) {
    page.add("<p>Nothing was required.</p>\n");
    return;
  }
  const auto n_met = std::count_if(summary.checks.begin(), summary.checks.end(),
                                   [](const auto& check) { return check.is_met; });
  page.add("<p><strong>{} of {} requirements are met.</strong></p>\n", n_met,
           summary.checks.size());
  std::vector<std::vector<std::string>> rows = {{"For", "Required", "Asked", "Found", ""}};
  for (const study::RequirementCheck& check : summary.checks) {
    const bool is_glare = check.what == "UGR";
    const char* unit = check.what == "Em" ? " lx" : "";
    std::string found = "–";
    if (check.found) {
      found = is_glare ? fmt::format("{:.1f}", *check.found)
                       : fmt::format("{:.4g}{}", *check.found, unit);
    }
    if (check.error > 0) found += fmt::format(" ± {:.2g}", check.error);
    rows.push_back({escaped(check.grid), check.what,
                    fmt::format("{} {:g}{}", is_glare ? "≤" : "≥", check.asked, unit), found,
                    mark(check.is_met)});
  }
  page.table(rows, 2);
}

void add_room(Html& page, const LightSummary& summary) {
  const study::Study& study = summary.solved;
  const radiosity::Scene& scene = study.scene;
  const radiosity::Vec3 size = radiosity::bounds(study.mesh).sizes();
  page.add("<h2>Room</h2>\n<p>{:.4g} m × {:.4g} m × {:.4g} m over all.</p>\n", size[0], size[1],
           size[2]);
  const Eigen::VectorXd weights = radiosity::luminous_weights(scene.bands, summary.efficacy);
  const std::vector<double> area = areas(study.mesh);
  std::vector<std::vector<std::string>> rows = {{"Surface", "Material", "Area, m²", "Reflectance"}};
  for (std::size_t k = 0; k < scene.surfaces.size(); ++k) {
    const radiosity::Material& material = scene.materials[scene.surfaces[k].material];
    rows.push_back({escaped(scene.surfaces[k].name), escaped(material.name),
                    fmt::format("{:.4g}", area[k]),
                    fmt::format("{:.2f}", luminous_reflectance(material.reflectance, weights))});
  }
  page.table(rows, 2);
}

/// Surfaces that emit.
void add_lamps(Html& page, const LightSummary& summary) {
  const study::Study& study = summary.solved;
  const Eigen::VectorXd weights = radiosity::luminous_weights(study.scene.bands, summary.efficacy);
  const Eigen::VectorXd exitance = study.solution.exitance * weights;
  std::vector<double> flux(study.scene.surfaces.size(), 0);
  for (Index i = 0; i < study.mesh.size(); ++i) {
    flux[static_cast<std::size_t>(study.mesh.surface[i])] += study.mesh.area[i] * exitance[i];
  }
  const std::vector<double> area = areas(study.mesh);
  std::vector<std::vector<std::string>> rows = {
      {"Surface", "Flux, lm", "Area, m²", "Luminance, cd/m²", "Maintenance factor"}};
  double sum = 0;
  for (std::size_t k = 0; k < flux.size(); ++k) {
    if (!(flux[k] > 0)) continue;
    sum += flux[k];
    rows.push_back({escaped(study.scene.surfaces[k].name), io::value_text(flux[k]),
                    fmt::format("{:.4g}", area[k]),
                    io::value_text(flux[k] / area[k] / radiosity::kPi),
                    fmt::format("{:g}", summary.measured.maintenance_factors[k])});
  }
  if (rows.size() == 1) return;
  page.add("<h2>Lamps</h2>\n");
  page.add("<p>{} lm of surfaces that emit, when new.</p>\n", io::value_text(sum));
  page.table(rows);
}

/// Of photometric files, with a polar curve of each file.
void add_luminaires(Html& page, const LightSummary& summary) {
  const radiosity::Scene& scene = summary.solved.scene;
  if (scene.luminaires.empty()) return;
  page.add("<h2>Luminaires</h2>\n");
  std::vector<std::vector<std::string>> rows = {
      {"Luminaire", "File", "At, m", "Flux, lm", "Dimming", "Maintenance factor"}};
  double sum = 0;
  for (std::size_t k = 0; k < scene.luminaires.size(); ++k) {
    const radiosity::Luminaire& luminaire = scene.luminaires[k];
    const radiosity::Photometry& photometry =
        scene.photometries[static_cast<std::size_t>(luminaire.photometry)];
    const double whole = undimmed_flux(luminaire, photometry);
    sum += luminaire.dimming * whole;
    const radiosity::Vec3& x = luminaire.position;
    rows.push_back({escaped(luminaire.name), escaped(photometry.file.filename().string()),
                    fmt::format("{:.4g}, {:.4g}, {:.4g}", x[0], x[1], x[2]), io::value_text(whole),
                    fmt::format("{:g}", luminaire.dimming),
                    fmt::format("{:g}", summary.measured.luminaire_factors[k])});
  }
  page.add("<p>{} lm, when new.</p>\n", io::value_text(sum));
  page.table(rows, 2);
  for (const radiosity::Photometry& photometry : scene.photometries) {
    page.add("<figure>{}</figure>\n", io::polar_curve_svg(photometry));
  }
}

std::string place(const study::MeasuredPlanGrid& grid, Index point) {
  if (point < 0) return "–";
  const radiosity::Vec3& x = grid.light.where.points[static_cast<std::size_t>(point)];
  return fmt::format("{:.4g}, {:.4g}, {:.4g}", x[0] + 0.0, x[1] + 0.0, x[2] + 0.0);
}

void add_grid_facts(Html& page, const study::MeasuredPlanGrid& grid) {
  const radiosity::MeasuringPoints& where = grid.light.where;
  const auto total = radiosity::summary(grid.light.places, grid.light.quantities.front().total(0));
  page.add("<p class=\"facts\">");
  if (where.grid) {
    page.add("{} × {} points, {:.3g} m × {:.3g} m apart, border {:.3g} m", where.grid->n_columns,
             where.grid->n_rows, where.grid->column.norm(), where.grid->row.norm(), where.border);
    if (!grid.plan.surface.empty()) {
      page.add(", {:g} m above {}", grid.plan.offset, escaped(grid.plan.surface));
    }
  } else {
    page.add("{} points", where.size());
  }
  if (total.n_inside > 0) page.add("; {} in solids left out", total.n_inside);
  if (total.n_outside > 0) page.add("; {} outside left out", total.n_outside);
  page.add("</p>\n");
}

void add_grids(Html& page, const LightSummary& summary) {
  if (summary.measured.grids.empty()) return;
  page.add("<h2>Illuminance</h2>\n");
  const std::vector<LightRow> all = light_rows(summary.measured);
  for (const study::MeasuredPlanGrid& grid : summary.measured.grids) {
    page.add("<h3>{}</h3>\n", escaped(grid.plan.name));
    add_grid_facts(page, grid);
    std::vector<std::vector<std::string>> rows = {
        {"Quantity", "Lamps", "E<sub>m</sub>", "of it direct", "error", "E<sub>min</sub>",
         "E<sub>max</sub>", "U<sub>0</sub>", "U<sub>d</sub>", "E<sub>min</sub> at, m"}};
    for (const LightRow& row : all) {
      if (&row.grid != &grid) continue;
      rows.push_back(
          {"<span class=\"name\">" + escaped(row.quantity.name_with_unit()) + "</span>",
           age_name(row.age), io::value_text(row.total.mean), io::value_text(row.direct),
           fmt::format("± {:.2g}", row.error), io::value_text(row.total.least),
           io::value_text(row.total.greatest), fmt::format("{:.2f}", row.total.least_to_mean()),
           fmt::format("{:.2f}", row.total.least_to_greatest()), place(grid, row.total.least_at)});
    }
    page.table(rows, 2);
    if (!grid.light.where.grid) continue;
    for (const radiosity::GridQuantity& quantity : grid.light.quantities) {
      page.add("<figure>{}</figure>\n", io::grid_svg(grid_chart(summary.measured, grid, quantity)));
    }
  }
}

void add_glare(Html& page, const LightSummary& summary) {
  if (summary.measured.observers.empty()) return;
  page.add("<h2>Glare</h2>\n");
  std::vector<std::vector<std::string>> rows = {{"Observer", "Eye at, m", "looks along", "UGR",
                                                 "background, cd/m²", "ahead, cd/m²",
                                                 "sources that count"}};
  for (const study::MeasuredObserver& seen : summary.measured.observers) {
    const auto& at = seen.observer.position;
    const auto& to = seen.observer.direction;
    const auto ugr = seen.glare.ugr();
    const auto n = std::count_if(seen.glare.sources.begin(), seen.glare.sources.end(),
                                 [](const auto& source) { return source.position.has_value(); });
    rows.push_back({escaped(seen.observer.name),
                    fmt::format("{:.4g}, {:.4g}, {:.4g}", at[0], at[1], at[2]),
                    fmt::format("{:.3g}, {:.3g}, {:.3g}", to[0] + 0.0, to[1] + 0.0, to[2] + 0.0),
                    ugr ? fmt::format("{:.1f}", *ugr) : "–", io::value_text(seen.glare.background),
                    io::value_text(seen.glare.luminance), fmt::format("{}", n)});
  }
  page.table(rows);
  page.add(
      "<p class=\"facts\">UGR = 8 lg (0.25 / L<sub>b</sub> Σ L² ω / p²) by CIE 117, of new lamps; "
      "solid angles of what is seen are exact, p is by Guth's formula, which may differ by 0.8 "
      "units from the table of CIE 117.</p>\n");
}

void add_energy(Html& page, const LightSummary& summary) {
  const radiosity::EnergyBalance& energy = summary.solved.solution.energy;
  const std::string unit = radiosity::band_unit("W", summary.solved.scene.bands);
  page.add("<h2>Energy balance</h2>\n");
  std::vector<std::vector<std::string>> rows = {{"Band", "emitted, " + unit,
                                                 "from without, " + unit, "absorbed, " + unit,
                                                 "escaped, " + unit}};
  const auto names = band_names(summary.solved.scene.bands);
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto i = static_cast<Index>(k);
    const double incident = energy.incident.size() > 0 ? energy.incident[i] : 0;
    rows.push_back({escaped(names[k]), fmt::format("{:.5g}", energy.emitted[i]),
                    fmt::format("{:.5g}", incident), fmt::format("{:.5g}", energy.absorbed[i]),
                    fmt::format("{:.5g}", energy.escaped[i])});
  }
  page.table(rows);
}

void add_accuracy(Html& page, const LightReport& report) {
  const study::Study& study = report.summary.solved;
  const radiosity::Solution& solution = study.solution;
  page.add("<h2>How right this is</h2>\n<ul>\n");
  page.add(
      "<li>{} patches; their size leaves the reflected light off by {:.2g} of it, one "
      "standard error.</li>\n",
      study.mesh.size(), study.discretisation.relative);
  page.add(
      "<li>Form factors leave it uncertain by {:.2g}, the iteration by {:.2g}, at most.</li>\n",
      solution.transport_error_bound, solution.error_bound);
  page.add(
      "<li>Shadows at points are exact. The errors behind illuminances are one standard "
      "error, with those of all patches to the same side.</li>\n");
  page.add("<li>All surfaces are diffuse. {:g} lm/W of white light, by convention.</li>\n</ul>\n",
           report.summary.efficacy);
  if (report.warnings.empty()) return;
  page.add("<ul class=\"note\">");
  for (const std::string& warning : report.warnings) page.add("<li>{}</li>\n", escaped(warning));
  page.add("</ul>\n");
}

}  // namespace

io::GridChart grid_chart(const study::MeasuredPlan& measured, const study::MeasuredPlanGrid& grid,
                         const radiosity::GridQuantity& quantity) {
  return {.grid = *grid.light.where.grid,
          .places = grid.light.places,
          .values = quantity.total(measured.light(study::LampAge::maintained)),
          .title = fmt::format("{}: {}{}", io::printable(grid.plan.name),
                               measured.has_maintenance ? "maintained " : "",
                               quantity.name_with_unit())};
}

std::string light_report_html(const LightReport& report) {
  const radiosity::Scene& scene = report.summary.solved.scene;
  const std::string title = scene.name.empty() ? scene.source : scene.name;
  Html page;
  page.add(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
      "<title>Lighting of {0}</title><style>{1}</style></head><body>\n<h1>Lighting of {0}</h1>\n",
      escaped(title), kStyle);
  if (!scene.description.empty()) page.add("<p>{}</p>\n", escaped(scene.description));
  page.add("<p class=\"facts\">{} · {} · radiosity {} · {}</p>\n", escaped(scene.source),
           escaped(report.date), escaped(report.version), escaped(report.machine));
  add_verdict(page, report.summary);
  add_grids(page, report.summary);
  add_glare(page, report.summary);
  add_room(page, report.summary);
  add_luminaires(page, report.summary);
  add_lamps(page, report.summary);
  add_energy(page, report.summary);
  add_accuracy(page, report);
  page.add("</body></html>\n");
  return page.text;
}

}  // namespace apps
