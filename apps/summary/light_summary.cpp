#include "apps/summary/light_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/summary/text_table.h"
#include "apps/terminal/terminal_progress.h"
#include "io/base/printable.h"
#include "io/picture/grid_chart.h"

namespace apps {
namespace {

using Json = nlohmann::ordered_json;
using radiosity::Index;
using radiosity::LightPart;
using radiosity::Vec3;

std::string place_text(const LightRow& row) {
  if (row.total.least_at < 0) return "-";
  const Vec3& x = row.grid.light.where.points[static_cast<std::size_t>(row.total.least_at)];
  return fmt::format("{:.4g},{:.4g},{:.4g}", x[0] + 0.0, x[1] + 0.0, x[2] + 0.0);
}

std::string grid_table(const study::MeasuredPlan& measured) {
  std::vector<Row> rows = {{"grid", "quantity", "lamps", "Em", "direct", "error", "Emin", "Emax",
                            "U0", "Ud", "Emin at, m"}};
  for (const LightRow& row : light_rows(measured)) {
    const auto number = [](double value) { return io::value_text(value); };
    rows.push_back({one_line(row.grid.plan.name), row.quantity.name_with_unit(), age_name(row.age),
                    number(row.total.mean), number(row.direct), fmt::format("{:.1g}", row.error),
                    number(row.total.least), number(row.total.greatest),
                    fmt::format("{:.3f}", row.total.least_to_mean()),
                    fmt::format("{:.3f}", row.total.least_to_greatest()), place_text(row)});
  }
  return table(rows);
}

std::string points_table(const study::MeasuredPlan& measured) {
  std::vector<Row> rows = {
      {"grid", "points", "measured", "in solids", "outside", "spacing, m", "border, m"}};
  for (const study::MeasuredPlanGrid& grid : measured.grids) {
    const auto total =
        radiosity::summary(grid.light.places, grid.light.quantities.front().total(0));
    const radiosity::MeasuringPoints& where = grid.light.where;
    rows.push_back({one_line(grid.plan.name),
                    where.grid ? fmt::format("{} x {}", where.grid->n_columns, where.grid->n_rows)
                               : fmt::format("{}", where.size()),
                    fmt::format("{}", total.n), fmt::format("{}", total.n_inside),
                    fmt::format("{}", total.n_outside),
                    where.grid ? fmt::format("{:.4g} x {:.4g}", where.grid->column.norm(),
                                             where.grid->row.norm())
                               : "-",
                    where.grid ? fmt::format("{:.3g}", where.border) : "-"});
  }
  return table(rows);
}

std::string ugr_text(const std::optional<double>& ugr) {
  return ugr ? fmt::format("{:.1f}", *ugr) : "-";
}

std::string glare_table(const study::MeasuredPlan& measured) {
  std::vector<Row> rows = {{"observer", "UGR", "background, cd/m²", "ahead, cd/m²", "sources"}};
  for (const study::MeasuredObserver& seen : measured.observers) {
    rows.push_back({one_line(seen.observer.name), ugr_text(seen.glare.ugr()),
                    io::value_text(seen.glare.background), io::value_text(seen.glare.luminance),
                    fmt::format("{}", seen.glare.sources.size())});
  }
  return table(rows);
}

std::string check_table(const std::vector<study::RequirementCheck>& checks) {
  std::vector<Row> rows = {{"required", "what", "asked", "found", ""}};
  for (const study::RequirementCheck& check : checks) {
    const bool is_glare = check.what == "UGR";
    rows.push_back(
        {one_line(check.grid), check.what,
         fmt::format("{} {:g}", is_glare ? "<=" : ">=", check.asked),
         is_glare ? ugr_text(check.found) : fmt::format("{:.4g}", check.found.value_or(0)),
         check.is_met ? "met" : "NOT MET"});
  }
  return table(rows);
}

/// What is left of lamps and luminaires: of the one that ages most and of the one that ages least.
std::string maintenance_text(const LightSummary& summary) {
  const radiosity::Scene& scene = summary.solved.scene;
  std::vector<double> factors = summary.measured.luminaire_factors;
  for (std::size_t k = 0; k < scene.surfaces.size(); ++k) {
    const radiosity::Surface& surface = scene.surfaces[k];
    if (scene.materials[static_cast<std::size_t>(surface.material)].emission.kind !=
        radiosity::Emission::Kind::none) {
      factors.push_back(summary.measured.maintenance_factors[k]);
    }
  }
  if (factors.empty()) return "no lamps";
  const auto [least, most] = std::ranges::minmax(factors);
  const std::string share =
      least == most ? fmt::format("{:g}", least) : fmt::format("{:g} to {:g}", least, most);
  return share + " of what lamps give when new";
}

Json point_json(const Vec3& x) { return {x[0], x[1], x[2]}; }

Json row_json(const LightRow& row) {
  Json json = {{"Em", row.total.mean},
               {"Em_direct", row.direct},
               {"Em_indirect", row.indirect},
               {"Em_error", row.error},
               {"Emin", row.total.least},
               {"Emax", row.total.greatest},
               {"U0", row.total.least_to_mean()},
               {"Ud", row.total.least_to_greatest()}};
  const auto place = [&](Index k) {
    return k < 0 ? Json() : point_json(row.grid.light.where.points[static_cast<std::size_t>(k)]);
  };
  json["Emin_at"] = place(row.total.least_at);
  json["Emax_at"] = place(row.total.greatest_at);
  return json;
}

Json grid_json(const study::MeasuredPlanGrid& grid, const std::vector<LightRow>& rows) {
  const auto total = radiosity::summary(grid.light.places, grid.light.quantities.front().total(0));
  const radiosity::MeasuringPoints& where = grid.light.where;
  Json json = {{"name", grid.plan.name},
               {"points", where.size()},
               {"measured", total.n},
               {"inside", total.n_inside},
               {"outside", total.n_outside}};
  if (where.grid) {
    json["columns"] = where.grid->n_columns;
    json["rows"] = where.grid->n_rows;
    json["column_spacing"] = where.grid->column.norm();
    json["row_spacing"] = where.grid->row.norm();
    json["border"] = where.border;
  }
  json["quantities"] = Json::array();
  for (const LightRow& row : rows) {
    if (&row.grid != &grid) continue;
    Json& list = json["quantities"];
    if (list.empty() || list.back()["name"] != row.quantity.name) {
      list.push_back({{"name", row.quantity.name}, {"unit", row.quantity.unit}});
    }
    list.back()[age_name(row.age)] = row_json(row);
  }
  return json;
}

Json observer_json(const study::MeasuredObserver& seen) {
  const auto ugr = seen.glare.ugr();
  Json json = {{"name", seen.observer.name},
               {"UGR", ugr ? Json(*ugr) : Json()},
               {"background_luminance", seen.glare.background},
               {"luminance", seen.glare.luminance},
               {"sources", Json::array()}};
  for (const radiosity::GlareSource& source : seen.glare.sources) {
    json["sources"].push_back(
        {{"surface", source.surface},
         {"luminance", source.luminance},
         {"solid_angle", source.solid_angle},
         {"direction", point_json(source.direction)},
         {"position_index", source.position ? Json(*source.position) : Json()}});
  }
  return json;
}

}  // namespace

const char* age_name(study::LampAge age) {
  return age == study::LampAge::new_lamps ? "new" : "maintained";
}

std::vector<LightRow> light_rows(const study::MeasuredPlan& measured) {
  std::vector<LightRow> rows;
  for (const study::MeasuredPlanGrid& grid : measured.grids) {
    for (const radiosity::GridQuantity& quantity : grid.light.quantities) {
      for (const study::LampAge age : {study::LampAge::new_lamps, study::LampAge::maintained}) {
        if (age == study::LampAge::maintained && !measured.has_maintenance) continue;
        const Index light = measured.light(age);
        const auto mean = [&](LightPart part) {
          return radiosity::summary(grid.light.places, quantity.part(light, part)).mean;
        };
        rows.push_back(
            {grid, quantity, age, radiosity::summary(grid.light.places, quantity.total(light)),
             mean(LightPart::direct), mean(LightPart::indirect), mean(LightPart::error)});
      }
    }
  }
  return rows;
}

std::string light_text(const LightSummary& summary) {
  const study::Study& study = summary.solved;
  std::string text = line("scene", one_line(study.scene.source));
  text += line("patches", fmt::format("{} on {} surfaces", study.mesh.size(),
                                      study.mesh.surface_names.size()));
  if (summary.measured.has_maintenance) text += line("maintenance", maintenance_text(summary));
  if (!summary.measured.grids.empty()) {
    text += points_table(summary.measured) + grid_table(summary.measured);
  }
  if (!summary.measured.observers.empty()) text += glare_table(summary.measured);
  if (!summary.checks.empty()) text += check_table(summary.checks);
  for (const std::string& output : summary.outputs) text += line("written", one_line(output));
  return text;
}

std::string light_json(const LightSummary& summary, const std::vector<std::string>& warnings) {
  const study::Study& study = summary.solved;
  Json json = {{"patches", study.mesh.size()}, {"efficacy", summary.efficacy}};
  json["maintenance_factors"] = Json::object();
  for (std::size_t k = 0; k < summary.measured.maintenance_factors.size(); ++k) {
    json["maintenance_factors"][study.scene.surfaces[k].name] =
        summary.measured.maintenance_factors[k];
  }
  for (std::size_t k = 0; k < study.scene.luminaires.size(); ++k) {
    json["maintenance_factors"][study.scene.luminaires[k].name] =
        summary.measured.luminaire_factors[k];
  }
  const std::vector<LightRow> rows = light_rows(summary.measured);
  json["grids"] = Json::array();
  for (const auto& grid : summary.measured.grids) json["grids"].push_back(grid_json(grid, rows));
  json["observers"] = Json::array();
  for (const auto& seen : summary.measured.observers) {
    json["observers"].push_back(observer_json(seen));
  }
  json["required"] = Json::array();
  for (const study::RequirementCheck& check : summary.checks) {
    json["required"].push_back({{"of", check.grid},
                                {"what", check.what},
                                {"asked", check.asked},
                                {"found", check.found ? Json(*check.found) : Json()},
                                {"met", check.is_met}});
  }
  json["outputs"] = summary.outputs;
  json["warnings"] = warnings;
  return io::printable_json(json.dump(2, ' ', false, Json::error_handler_t::replace));
}

}  // namespace apps
