#include "apps/summary/json_summary.h"

#include <nlohmann/json.hpp>

#include "apps/summary/scene_text.h"
#include "io/base/printable.h"
#include "radiosity/operator/surface_factors.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/solve/solution.h"
#include "radiosity/solve/solve.h"
#include "radiosity/solve/surface_flux.h"

namespace apps {
namespace {

using Json = nlohmann::ordered_json;  // writes NaN and infinity as null

Json array(const Eigen::VectorXd& values) {
  return std::vector<double>(values.data(), values.data() + values.size());
}

/// File names may hold any bytes; what is not UTF-8 is replaced, and nothing steers a terminal.
std::string text(const Json& json) {
  return io::printable_json(json.dump(2, ' ', false, Json::error_handler_t::replace));
}

Json compression(const radiosity::CompressionReport& report) {
  return {{"verified_error", report.verified_error},
          {"estimated_error", report.estimated_error},
          {"rows", report.n_rows},
          {"rounds", report.n_rounds},
          {"numbers_per_patch", report.coefficients},
          {"entries_per_patch", report.entries}};
}

Json form_factors(const radiosity::AssemblyReport& report, std::size_t bytes) {
  Json result = {{"kind", report.compression ? "compressed" : "dense"},
                 {"seconds", report.seconds},
                 {"pairs",
                  {{"facing", report.facing},
                   {"visible", report.visible},
                   {"hidden", report.hidden},
                   {"undecided", report.undecided},
                   {"partial", report.partial},
                   {"kept", report.known}}},
                 {"rays", report.rays},
                 {"closed", report.closed},
                 {"open_rows", report.open_rows},
                 {"closure_mean", report.closure_mean},
                 {"closure_max", report.closure_max},
                 {"bytes", bytes}};
  if (report.compression) result["compressed"] = compression(*report.compression);
  return result;
}

Json dropped(double min_factor, const radiosity::DroppedFactors& dropped) {
  return {{"min_factor", min_factor},
          {"entries", dropped.entries},
          {"share", dropped.share},
          {"largest_row_share", dropped.largest_row_share},
          {"unbalanced_rows", dropped.unbalanced_rows}};
}

Json solve(const radiosity::Solution& solution) {
  return {{"method", radiosity::method_name(solution.method)},
          {"iterations", solution.iterations},
          {"products", solution.products},
          {"residual", solution.residual},
          {"error_bound", solution.error_bound},
          {"transport_error_bound", solution.transport_error_bound},
          {"converged", solution.converged},
          {"seconds", solution.seconds}};
}

Json discretisation(const radiosity::DiscretisationError& error) {
  return {{"error", error.relative}, {"order", error.order}, {"lone_patches", error.n_unknown}};
}

Json energy(const radiosity::EnergyBalance& energy) {
  return {{"emitted", array(energy.emitted)},
          {"incident", array(energy.incident)},
          {"absorbed", array(energy.absorbed)},
          {"escaped", array(energy.escaped)}};
}

Json refinement(const meshing::Refinement& refinement) {
  return {{"rounds", refinement.n_rounds},
          {"error", refinement.error},
          {"accurate", refinement.is_accurate},
          {"seconds", refinement.seconds}};
}

Json surfaces(const std::vector<radiosity::SurfaceFlux>& fluxes, const radiosity::Bands& bands) {
  Json list = Json::array();
  for (const radiosity::SurfaceFlux& flux : fluxes) {
    list.push_back({{"name", flux.surface},
                    {"area", flux.area},
                    {"net_flux", flux.flux},
                    {"net_heat", flux.heat}});
    if (flux.temperature) list.back()["temperature"] = *flux.temperature;
    if (bands.count() > 1) list.back()["net_heat_by_band"] = array(flux.band_heat);
    if (bands.kind == radiosity::Bands::Kind::solar_infrared) {
      list.back()["solar_absorbed"] = 0 - flux.band_heat[0];
      list.back()["infrared_net_heat"] = flux.band_heat[1];
    }
  }
  return list;
}

/// A photometric quantity has one value, any other a list of one per band.
Json values(const Eigen::VectorXd& values, const radiosity::QuantityInfo& info) {
  return info.is_photometric ? Json(values[0]) : array(values);
}

Json share(const radiosity::QuantityShare& share, const radiosity::QuantityInfo& info) {
  Json json = {{"name", share.surface}, {"area", share.area}};
  if (info.is_additive) {
    json["sum"] = values(share.sum, info);
  } else {
    json["mean"] = values(share.mean, info);
    json["min"] = values(share.least, info);
    json["max"] = values(share.greatest, info);
  }
  return json;
}

Json by_surface(const radiosity::QuantitySummary& quantity) {
  Json list = Json::array();
  for (const radiosity::QuantityShare& surface : quantity.surfaces) {
    list.push_back(share(surface, quantity.info));
  }
  Json total = share(quantity.total, quantity.info);
  total.erase("name");
  return {{"unit", quantity.unit}, {"surfaces", list}, {"total", total}};
}

Json surfaces(const radiosity::Scene& scene, const meshing::Inspection& inspection) {
  Json list = Json::array();
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
    const radiosity::Surface& surface = scene.surfaces[s];
    const radiosity::Material& material = scene.materials[surface.material];
    list.push_back({{"name", surface.name},
                    {"polygons", inspection.surface_polygons[s]},
                    {"area", inspection.surface_area[s]},
                    {"two_sided", surface.two_sided},
                    {"material", material.name},
                    {"reflectance", array(material.reflectance)},
                    {"emission",
                     {{"kind", emission_name(material.emission.kind)},
                      {"value", array(material.emission.value)},
                      {"factor", surface.emission_factor}}}});
  }
  return list;
}

Json surfaces(const radiosity::PatchMesh& mesh, const Eigen::MatrixXd& factors) {
  const Eigen::VectorXd areas = radiosity::surface_areas(mesh);
  Json list = Json::array();
  for (Eigen::Index s = 0; s < factors.rows(); ++s) {
    list.push_back({{"name", mesh.surface_names[s]},
                    {"area", areas[s]},
                    {"form_factors", array(factors.row(s))},
                    {"unseen", 1 - factors.row(s).sum()}});
  }
  return list;
}

Json factor_list(const std::vector<std::string>& surfaces, const Eigen::VectorXd& factors,
                 const Eigen::VectorXd& errors) {
  Json list = Json::array();
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    const auto k = static_cast<Eigen::Index>(s);
    list.push_back({{"surface", surfaces[s]}, {"factor", factors[k]}, {"error", errors[k]}});
  }
  return list;
}

Json findings(const meshing::Inspection& inspection) {
  Json list = Json::array();
  for (const meshing::Finding& finding : inspection.findings) {
    list.push_back({{"kind", meshing::kind_name(finding.kind)},
                    {"severity", severity_name(finding.severity)},
                    {"surface", finding.surface},
                    {"polygon", finding.polygon < 0 ? Json() : Json(finding.polygon)},
                    {"count", finding.count},
                    {"message", finding.message}});
  }
  return list;
}

Json bounds(const radiosity::Box3& box) {
  if (box.isEmpty()) return nullptr;
  return {{"min", array(box.min())}, {"max", array(box.max())}};
}

}  // namespace

std::string solve_json(const SolveSummary& summary, const std::vector<std::string>& warnings) {
  const study::Study& solved = summary.solved;
  Json json = {
      {"patches", solved.mesh.size()},
      {"bands", solved.scene.bands.count()},
      {"form_factors", form_factors(solved.transport->report(), solved.transport->bytes())},
      {"solve", solve(solved.solution)},
      {"discretisation", discretisation(solved.discretisation)},
      {"energy", energy(solved.solution.energy)},
      {"outputs", summary.outputs},
      {"warnings", warnings}};
  if (summary.operator_file) json["form_factors"]["read_from"] = *summary.operator_file;
  if (const auto& verified = solved.verified) {
    json["form_factors"]["compressed"]["for_this_light"] = {{"verified_error", verified->error},
                                                            {"rows", verified->n_rows}};
  }
  if (const auto& emissivity = solved.emissivity) {
    json["emissivity"] = {{"solves", emissivity->n_solves},
                          {"temperature_change", emissivity->change},
                          {"settled", emissivity->settled}};
  }
  if (solved.refinement) json["refinement"] = refinement(*solved.refinement);
  if (radiosity::is_thermal(solved.scene)) {
    json["surfaces"] =
        surfaces(radiosity::surface_fluxes(solved.mesh, solved.solution), solved.scene.bands);
  }
  for (const radiosity::QuantitySummary& quantity : summary.quantities) {
    json["quantities"][std::string(quantity.info.name)] = by_surface(quantity);
  }
  if (const auto& shown = summary.false_color) {
    json["false_colour"] = {{"quantity", shown->quantity},
                            {"unit", shown->unit},
                            {"low", shown->scale.low},
                            {"high", shown->scale.high},
                            {"log", shown->scale.logarithmic}};
  }
  return text(json);
}

std::string scenarios_json(const ScenarioSummary& summary,
                           const std::vector<std::string>& warnings) {
  const study::Study& study = summary.study;
  Json json = {{"patches", study.mesh.size()},
               {"bands", study.scene.bands.count()},
               {"form_factors", form_factors(study.transport->report(), study.transport->bytes())}};
  if (summary.operator_file) json["form_factors"]["read_from"] = *summary.operator_file;
  Json list = Json::array();
  for (std::size_t k = 0; k < summary.scenarios.size(); ++k) {
    Json quantities;
    for (const radiosity::QuantitySummary& quantity : summary.scenarios[k].quantities) {
      quantities[std::string(quantity.info.name)] = by_surface(quantity);
    }
    list.push_back({{"name", summary.scenarios[k].name},
                    {"energy", energy(summary.energies[k])},
                    {"quantities", quantities}});
  }
  json["scenarios"] = list;
  json["outputs"] = summary.outputs;
  json["warnings"] = warnings;
  return text(json);
}

std::string form_factors_json(const FactorSummary& summary,
                              const std::vector<std::string>& warnings) {
  const radiosity::PatchMesh& mesh = summary.mesh;
  Json json = {{"patches", mesh.size()}};
  if (summary.n_merged > 0) {
    json["parts"] = summary.n_merged;
  } else {
    json["bands"] = summary.scene.bands.count();
  }
  if (const auto& part = summary.part) {
    json["part"] = {{"number", part->part.number + 1},
                    {"parts", part->part.n_parts},
                    {"records", part->records},
                    {"bytes", part->bytes},
                    {"seconds", part->seconds}};
  }
  if (summary.report != nullptr) {
    json["form_factors"] = form_factors(*summary.report, summary.bytes);
    if (summary.min_factor > 0) json["dropped"] = dropped(summary.min_factor, summary.dropped);
  }
  if (summary.by_surface.size() > 0) json["surfaces"] = surfaces(mesh, summary.by_surface);
  json["outputs"] = summary.outputs;
  json["warnings"] = warnings;
  return text(json);
}

std::string factors_from_json(const FactorsFrom& factors, const std::vector<std::string>& outputs,
                              const std::vector<std::string>& warnings) {
  const auto& [value, error] = factors.shares;
  return text({{"from", factors.from},
               {"factors", factor_list(factors.surface_names, value.surfaces, error.surfaces)},
               {"backs", value.backs},
               {"backs_error", error.backs},
               {"sky", value.sky},
               {"sky_error", error.sky},
               {"sum", value.sum()},
               {"outputs", outputs},
               {"warnings", warnings}});
}

std::string factor_row_json(const FactorRow& row, const std::vector<std::string>& outputs,
                            const std::vector<std::string>& warnings) {
  const radiosity::JointRow shares = by_surface(row);
  return text({{"row", row.row},
               {"patches", row.mesh.size()},
               {"row_patches", row.patches},
               {"evaluated", row.is_evaluated},
               {"factors", factor_list(row.mesh.surface_names, shares.factor, shares.error)},
               {"sum", shares.factor.sum()},
               {"outputs", outputs},
               {"warnings", warnings}});
}

std::string inspect_json(const radiosity::Scene& scene, const meshing::Inspection& inspection,
                         const std::vector<std::string>& outputs,
                         const std::vector<std::string>& warnings) {
  return text({{"vertices", inspection.n_vertices},
               {"polygons", inspection.n_polygons},
               {"triangles", inspection.n_triangles},
               {"quads", inspection.n_quads},
               {"other", inspection.n_other},
               {"area", inspection.area},
               {"bounds", bounds(inspection.bounds)},
               {"precision", scene.precision},
               {"parts", n_parts(scene)},
               {"closed", inspection.closed},
               {"boundary_edges", inspection.n_boundary_edges},
               {"bands", scene.bands.count()},
               {"luminaires", scene.luminaires.size()},
               {"surfaces", surfaces(scene, inspection)},
               {"findings", findings(inspection)},
               {"outputs", outputs},
               {"warnings", warnings}});
}

}  // namespace apps
