#include "apps/summary/text_summary.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "apps/summary/scene_text.h"
#include "apps/summary/text_table.h"
#include "apps/terminal/terminal_progress.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/solve/quantity.h"
#include "radiosity/solve/solution.h"
#include "radiosity/solve/surface_flux.h"

namespace apps {
namespace {

std::string bytes(std::size_t n) {
  return n < 1'000'000'000 ? fmt::format("{:.1f} MB", static_cast<double>(n) * 1e-6)
                           : fmt::format("{:.2f} GB", static_cast<double>(n) * 1e-9);
}

std::string seconds_text(double seconds) { return fmt::format("{:.3g} s", seconds); }

std::string scene_lines(const radiosity::Scene& scene, const radiosity::PatchMesh& mesh) {
  return line("scene", one_line(scene.source)) +
         line("patches", fmt::format("{} on {} surfaces", mesh.size(), mesh.surface_names.size()));
}

/// A share to six digits; rounding shows as 0 and never as -0.
std::string share(double value) {
  return fmt::format("{:.6f}", std::abs(value) < 5e-7 ? 0.0 : value);
}

/// One row per surface: how much of what leaves it reaches each other one, and no surface at all.
std::string surface_factor_table(const radiosity::PatchMesh& mesh, const Eigen::MatrixXd& factors) {
  Row head{"from \\ to"};
  for (const std::string& name : mesh.surface_names) head.push_back(one_line(name));
  head.emplace_back("unseen");
  std::vector<Row> rows{head};
  for (Eigen::Index s = 0; s < factors.rows(); ++s) {
    Row row{one_line(mesh.surface_names[s])};
    for (const double factor : factors.row(s)) row.push_back(share(factor));
    row.push_back(share(1 - factors.row(s).sum()));
    rows.push_back(row);
  }
  return table(rows);
}

/// `origin` tells where they come from.
std::string form_factor_lines(const radiosity::AssemblyReport& report, std::size_t size,
                              const std::string& origin) {
  std::string text = line("form factors", fmt::format("{}, {}", origin, bytes(size)));
  if (report.compression) {
    const radiosity::CompressionReport& compression = *report.compression;
    text +=
        line("  compressed", fmt::format("{:.0f} numbers a patch, {:.0f} form factors evaluated",
                                         compression.coefficients, compression.entries));
    text += line("  verified", fmt::format("gathered light off by {:.2g} at most (95 %, {} rows)",
                                           compression.verified_error, compression.n_rows));
  }
  text += line("  pairs facing", fmt::format("{}", report.facing));
  text += line("    visible", fmt::format("{}", report.visible));
  text += line("    hidden", fmt::format("{}", report.hidden));
  text += line("    undecided",
               fmt::format("{}, of these {} partly hidden", report.undecided, report.partial));
  if (report.known > 0) text += line("    kept", fmt::format("{}", report.known));
  text += line("  rays", fmt::format("{}", report.rays));
  text += line("  closure",
               fmt::format("|1 - row sum| {:.2g} on average, at most {:.2g} ({})",
                           report.closure_mean, report.closure_max,
                           report.closed ? "closed scene, since corrected" : "open scene"));
  return text;
}

/// The scene and its form factors, which a file may have.
std::string study_lines(const study::Study& study,
                        const std::optional<std::string>& operator_file) {
  const radiosity::AssemblyReport& report = study.transport->report();
  const std::string origin =
      operator_file ? "from " + one_line(*operator_file) : seconds_text(report.seconds);
  std::string text = scene_lines(study.scene, study.mesh) +
                     form_factor_lines(report, study.transport->bytes(),
                                       origin + (report.compression ? ", compressed" : ", dense"));
  if (study.verified) {
    text += line("", fmt::format("for this light by {:.2g} at most (95 %, {} rows)",
                                 study.verified->error, study.verified->n_rows));
  } else if (operator_file && report.compression) {
    text += line("", "verified for the light of then");
  }
  return text;
}

std::string dropped_lines(double min_factor, const radiosity::DroppedFactors& dropped) {
  std::string text =
      line("  dropped",
           fmt::format("{} entries below {:g}, {:.2g} of all power, at most {:.2g} of "
                       "a row; row sums kept",
                       dropped.entries, min_factor, dropped.share, dropped.largest_row_share));
  if (dropped.unbalanced_rows > 0) {
    text += line("    but not in", fmt::format("{} rows", dropped.unbalanced_rows));
  }
  return text;
}

std::string solve_lines(const radiosity::Solution& solution) {
  return line("solve", fmt::format("{:.3g} s, {}, {} iterations{}", solution.seconds,
                                   radiosity::method_name(solution.method), solution.iterations,
                                   solution.converged ? "" : ", NOT CONVERGED")) +
         line("  residual", fmt::format("{:.2g}", solution.residual)) +
         line("  error bound",
              fmt::format("{:.2g} from the iteration, {:.2g} from the form factors",
                          solution.error_bound, solution.transport_error_bound));
}

std::string refinement_lines(const meshing::Refinement& refinement) {
  return line("refinement", fmt::format("{:.3g} s, {} rounds, error {:.2g}", refinement.seconds,
                                        refinement.n_rounds, refinement.error));
}

std::string discretisation_lines(const radiosity::DiscretisationError& discretisation) {
  return line("  patch size", fmt::format("{:.2g} of the reflected light off (order {:.2g})",
                                          discretisation.relative, discretisation.order));
}

/// What the light that does not come from patches is called; nothing if there is none.
std::string incoming_name(const radiosity::Scene& scene) {
  if (scene.environment.kind != radiosity::Emission::Kind::none || scene.sky) return "from without";
  if (!scene.luminaires.empty()) return scene.sun ? "from without" : "from luminaires";
  return scene.sun ? "from the sun" : "";
}

std::string energy_table(const radiosity::Bands& bands, const radiosity::EnergyBalance& energy,
                         const std::string& incoming) {
  const std::string unit = radiosity::band_unit("W", bands);
  std::vector<std::pair<std::string, const Eigen::VectorXd*>> columns = {
      {"emitted", &energy.emitted}, {"absorbed", &energy.absorbed}, {"escaped", &energy.escaped}};
  if (!incoming.empty()) columns.insert(columns.begin() + 1, {incoming, &energy.incident});
  std::vector<Row> rows = {{"energy"}};
  for (const auto& [name, values] : columns) rows.front().push_back(name + ", " + unit);
  const Row names = band_names(bands);
  for (std::size_t band = 0; band < names.size(); ++band) {
    Row row = {names[band]};
    for (const auto& [name, values] : columns) {
      row.push_back(fmt::format("{:.6g}", (*values)[static_cast<Eigen::Index>(band)]));
    }
    rows.push_back(row);
  }
  return table(rows);
}

/// Net heat by surface; with several bands that in each of them, too: of the sun's what is
/// absorbed. Temperatures where they are known.
std::string flux_table(const std::vector<radiosity::SurfaceFlux>& fluxes,
                       const radiosity::Bands& bands) {
  const bool is_solar = bands.kind == radiosity::Bands::Kind::solar_infrared;
  const bool has_temperatures = std::any_of(
      fluxes.begin(), fluxes.end(), [](const auto& flux) { return flux.temperature.has_value(); });
  std::vector<Row> rows = {{"net heat lost by", "area, m²", "W/m²", "W"}};
  if (bands.count() > 1) {
    for (const std::string& name : band_names(bands)) {
      rows[0].push_back(is_solar && name == "solar" ? "solar absorbed, W" : name + ", W");
    }
  }
  if (has_temperatures) rows[0].emplace_back("K");
  for (const radiosity::SurfaceFlux& flux : fluxes) {
    rows.push_back({one_line(flux.surface), fmt::format("{:.4g}", flux.area),
                    fmt::format("{:.6g}", flux.flux), fmt::format("{:.6g}", flux.heat)});
    for (Eigen::Index k = 0; bands.count() > 1 && k < bands.count(); ++k) {
      const double heat = is_solar && k == 0 ? 0 - flux.band_heat[k] : flux.band_heat[k];
      rows.back().push_back(fmt::format("{:.6g}", heat));
    }
    if (has_temperatures) {
      rows.back().push_back(flux.temperature ? fmt::format("{:.6g}", *flux.temperature) : "-");
    }
  }
  return table(rows);
}

std::string quantity_table(const radiosity::QuantitySummary& quantity) {
  const bool adds = quantity.info.is_additive;
  std::string head(quantity.info.name);
  if (!quantity.unit.empty()) head += ", " + quantity.unit;
  std::vector<Row> rows = {{head, "area, m²", "mean", "min", "max"}};
  if (adds) rows.front() = {head, "area, m²", "sum"};
  const auto add = [&](const radiosity::QuantityShare& share) {
    Row row = {one_line(share.surface), fmt::format("{:.4g}", share.area)};
    if (adds) {
      row.push_back(numbers(share.sum));
    } else {
      for (const auto* value : {&share.mean, &share.least, &share.greatest}) {
        row.push_back(numbers(*value));
      }
    }
    rows.push_back(row);
  };
  for (const radiosity::QuantityShare& share : quantity.surfaces) add(share);
  add(quantity.total);
  return table(rows);
}

std::string scale_text(const ShownScale& shown) {
  return fmt::format("{} from {:g} to {:g} {}{}", shown.quantity, shown.scale.low, shown.scale.high,
                     shown.unit, shown.scale.logarithmic ? ", logarithmic" : "");
}

Row destination_head() { return {"to", "factor", "one-sigma error"}; }

Row destination_row(const std::string& to, double share, double sigma) {
  // What is exact up to rounding has no error worth showing.
  return {to, fmt::format("{:.8f}", std::abs(share) < 5e-9 ? 0.0 : share),
          sigma < 1e-14 ? "-" : fmt::format("{:.1e}", sigma)};
}

}  // namespace

std::string scenarios_text(const ScenarioSummary& summary) {
  const radiosity::Bands& bands = summary.study.scene.bands;
  std::vector<Row> rows = {{"scenario", "emitted, " + radiosity::band_unit("W", bands)}};
  for (const radiosity::QuantitySummary& quantity : summary.scenarios.front().quantities) {
    rows.front().push_back((quantity.info.is_additive ? "sum of " : "mean ") +
                           std::string(quantity.info.name) + ", " + quantity.unit);
  }
  for (std::size_t k = 0; k < summary.scenarios.size(); ++k) {
    const io::ScenarioRow& scenario = summary.scenarios[k];
    Row row = {one_line(scenario.name), numbers(summary.energies[k].emitted)};
    for (const radiosity::QuantitySummary& quantity : scenario.quantities) {
      row.push_back(numbers(quantity.info.is_additive ? quantity.total.sum : quantity.total.mean));
    }
    rows.push_back(row);
  }
  std::string text = study_lines(summary.study, summary.operator_file) + table(rows);
  for (const std::string& output : summary.outputs) text += line("written", one_line(output));
  return text;
}

std::string form_factors_text(const FactorSummary& summary) {
  std::string text = scene_lines(summary.scene, summary.mesh);
  if (summary.report != nullptr) {
    text +=
        form_factor_lines(*summary.report, summary.bytes, seconds_text(summary.report->seconds));
    if (summary.min_factor > 0) text += dropped_lines(summary.min_factor, summary.dropped);
  }
  if (summary.part) text += part_line(*summary.part);
  if (summary.by_surface.size() > 0) {
    text += surface_factor_table(summary.mesh, summary.by_surface);
  }
  const std::string_view label = summary.report != nullptr || summary.part ? "written" : "complete";
  for (const std::string& output : summary.outputs) text += line(label, one_line(output));
  return text;
}

std::string solve_text(const SolveSummary& summary) {
  const study::Study& solved = summary.solved;
  std::string text = study_lines(solved, summary.operator_file);
  if (solved.refinement) text += refinement_lines(*solved.refinement);
  text += solve_lines(solved.solution);
  text += discretisation_lines(solved.discretisation);
  if (const auto& found = solved.emissivity) {
    text += line("  emissivity", fmt::format("by temperature, of {} solves; these change by {:.1e}",
                                             found->n_solves, found->change));
  }
  text += energy_table(solved.scene.bands, solved.solution.energy, incoming_name(solved.scene));
  if (radiosity::is_thermal(solved.scene))
    text += flux_table(radiosity::surface_fluxes(solved.mesh, solved.solution), solved.scene.bands);
  for (const radiosity::QuantitySummary& quantity : summary.quantities)
    text += quantity_table(quantity);
  if (summary.false_color) text += line("false colours", scale_text(*summary.false_color));
  for (const std::string& output : summary.outputs) text += line("written", one_line(output));
  return text;
}

std::string factor_row_text(const FactorRow& row, const std::vector<std::string>& outputs) {
  std::string text = line("row", one_line(row.row) + (row.is_evaluated ? ", evaluated" : ""));
  const std::string& surface = row.mesh.surface_names[row.mesh.surface[row.patches[0]]];
  text += line("of", row.patches.size() == 1
                         ? fmt::format("patch {} of {}", row.patches[0], one_line(surface))
                         : fmt::format("{} patches", row.patches.size()));
  const radiosity::JointRow shares = by_surface(row);
  std::vector<Row> rows = {destination_head()};
  for (std::size_t s = 0; s < row.mesh.surface_names.size(); ++s) {
    const auto k = static_cast<Eigen::Index>(s);
    rows.push_back(
        destination_row(one_line(row.mesh.surface_names[s]), shares.factor[k], shares.error[k]));
  }
  text += table(rows) + line("sum", fmt::format("{:.8f}", shares.factor.sum()));
  for (const std::string& output : outputs) text += line("written", one_line(output));
  return text;
}

std::string factors_from_text(const FactorsFrom& factors, const std::vector<std::string>& outputs) {
  const auto& [value, error] = factors.shares;
  std::vector<Row> rows = {destination_head()};
  const auto add = [&](const std::string& to, double share, double sigma) {
    rows.push_back(destination_row(to, share, sigma));
  };
  for (std::size_t s = 0; s < factors.surface_names.size(); ++s) {
    const auto k = static_cast<Eigen::Index>(s);
    add(one_line(factors.surface_names[s]), value.surfaces[k], error.surfaces[k]);
  }
  add("(backs of one-sided surfaces)", value.backs, error.backs);
  add("(sky)", value.sky, error.sky);
  std::string text = line("from", one_line(factors.from)) + table(rows);
  text += line("sum",
               fmt::format("1 {} {:.1e}", value.sum() < 1 ? '-' : '+', std::abs(value.sum() - 1)));
  for (const std::string& output : outputs) text += line("written", one_line(output));
  return text;
}

}  // namespace apps
