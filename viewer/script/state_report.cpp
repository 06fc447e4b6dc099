#include "viewer/script/state_report.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "radiosity/scene/patch_mesh.h"
#include "radiosity/solve/quantity.h"
#include "radiosity/solve/solution.h"
#include "viewer/desk/measuring.h"
#include "viewer/desk/pinning.h"
#include "viewer/desk/show_info.h"
#include "viewer/script/coupling_actions.h"
#include "viewer/script/daylight_actions.h"
#include "viewer/script/grid_actions.h"
#include "viewer/script/lamp_report.h"
#include "viewer/script/report_values.h"
#include "viewer/work/standing.h"

namespace viewer {
namespace {

using nlohmann::json;

std::string kind_name(Light::Kind kind) {
  switch (kind) {
    case Light::Kind::preview:
      return "preview";
    case Light::Kind::quick:
      return "quick";
    case Light::Kind::solved:
      return "solved";
    case Light::Kind::complete:
      return "complete";
    case Light::Kind::stored:
      return "stored";
  }
  return "";
}

json light_json(const Session& session) {
  const Light* light = session.light();
  if (light == nullptr) return nullptr;
  const radiosity::Solution& solution = light->solution;
  const Eigen::Map<const Eigen::VectorXd> area(session.model().mesh->area.data(),
                                               session.model().mesh->size());
  const Standing now = standing(session);
  return {
      {"kind", kind_name(light->kind)},
      {"standing", now.text},
      {"is_result", now.is_result},
      {"relative_error", light->relative_error ? number(*light->relative_error) : json(nullptr)},
      {"factor_error", light->factor_error ? number(*light->factor_error) : json(nullptr)},
      {"residual", number(solution.residual)},
      {"accuracy", accuracy_text(session)},
      {"asked", asked_text(session)},
      {"iterations", solution.iterations},
      {"unshot_share", number(session.unshot_share())},
      {"seconds", number(session.seconds_to_solve())},
      {"mean_radiosity",
       list(Eigen::VectorXd(solution.radiosity.transpose() * area / area.sum()))}};
}

json patch_json(const Desk& desk) {
  if (!desk.facts) return nullptr;
  const PatchFacts& facts = *desk.facts;
  json result = {{"patch", facts.patch},        {"surface", facts.surface},
                 {"material", facts.material},  {"polygon", facts.polygon},
                 {"area", number(facts.area)},  {"centroid", list(facts.centroid)},
                 {"normal", list(facts.normal)}};
  if (facts.temperature) result["temperature"] = number(*facts.temperature);
  if (facts.has_light) {
    result["bands"] = radiosity::band_names(desk.session.model().bands);
    result["radiosity"] = list(facts.radiosity);
    result["irradiance"] = list(facts.irradiance);
    result["exitance"] = list(facts.exitance);
    result["reflectance"] = list(facts.reflectance);
    result["error"] = list(facts.error);
    result["direct"] = list(facts.direct);
    result["illuminance"] = number(facts.illuminance);
    result["luminance"] = number(facts.luminance);
  }
  if (const auto pinned = pinned_irradiance(desk)) result["pinned_irradiance"] = list(*pinned);
  if (const auto step = step_facts(desk.session, desk.look)) {
    result["step"] = {{"radiosity", list(step->radiosity)}, {"unshot", list(step->unshot)}};
  }
  result["arrivals"] = json::array();
  for (const Arrival& arrival : facts.arrivals) {
    result["arrivals"].push_back(
        {{"surface", desk.session.model().mesh->surface_names[arrival.surface]},
         {"share", number(arrival.share)},
         {"irradiance", list(arrival.irradiance)}});
  }
  if (facts.has_factors) {
    result["row_sum"] = number(facts.row_sum);
    result["partners"] = json::array();
    for (const Partner& partner : facts.partners) {
      result["partners"].push_back({{"patch", partner.patch},
                                    {"factor", number(partner.factor)},
                                    {"error", number(partner.error)}});
    }
  }
  if (!desk.emitter_shares.empty()) {
    result["emitters"] = json::array();
    for (const EmitterShare& share : desk.emitter_shares) {
      result["emitters"].push_back({{"emitter", desk.session.mix().emitters[share.emitter].name},
                                    {"share", number(share.share)},
                                    {"radiosity", list(share.radiosity)}});
    }
  }
  return result;
}

json look_json(const Desk& desk) {
  const ShowInfo& info = show_info(show_name(desk.look));
  json result = {{"quantity", std::string(info.name)},
                 {"caption", caption_with_unit(info, desk.session.model().bands)},
                 {"definition", std::string(info.definition)},
                 {"stops", number(desk.look.stops)},
                 {"exposure", number(desk.exposure * std::exp2(desk.look.stops))},
                 {"log", desk.look.logarithmic},
                 {"smooth", desk.look.smooth},
                 {"edges", desk.look.edges},
                 {"outlines", desk.look.outlines},
                 {"isolines", desk.look.isolines},
                 {"map", std::string(io::color_map_name(desk.look.map))},
                 {"hide_backs", desk.look.hide_backs},
                 {"back_outlines", desk.look.back_outlines},
                 {"axes", desk.look.axes},
                 {"luminaires", desk.look.luminaires},
                 {"polar_curves", desk.look.polar_curves},
                 {"panels", desk.shows_panels},
                 {"legend", nullptr}};
  if (desk.legend) {
    result["legend"] = {{"title", desk.legend->title},
                        {"low", number(desk.legend->scale.low)},
                        {"high", number(desk.legend->scale.high)},
                        {"ticks", desk.legend->ticks},
                        {"fit", desk.legend->fit},
                        {"least", number(desk.legend->least)},
                        {"greatest", number(desk.legend->greatest)},
                        {"iso_numbers", desk.iso_numbers.size()},
                        {"log", desk.legend->scale.logarithmic}};
  }
  return result;
}

json comparison_json(const Desk& desk) {
  json pinned = nullptr;
  if (desk.pinning.light) {
    pinned = {{"standing", desk.pinning.light->standing},
              {"patches", desk.pinning.light->known.model.mesh->size()},
              {"has_same_patches", desk.pinning.has_same_patches}};
  }
  return {{"mode", comparison_name(desk.look.comparison)},
          {"shown", comparison_name(shown_comparison(desk))},
          {"split", desk.pinning.split},
          {"pinned", pinned}};
}

json work_plane_json(const Desk& desk) {
  const auto& plane = desk.meter.plane();
  if (!plane) return nullptr;
  json result = {{"height", number(plane->height)},
                 {"border", number(plane->border)},
                 {"shown", desk.look.show == Show::work_plane},
                 {"note", readings_note(desk)},
                 {"unit", measured_unit(desk.session)}};
  const auto found = plane_summary(desk);
  if (!found) return result;
  const radiosity::PointGrid& grid = desk.meter.readings()->plane->grid;
  result["corner"] = list(grid.corner);
  result["column"] = list(grid.column);
  result["row"] = list(grid.row);
  result["columns"] = grid.n_columns;
  result["rows"] = grid.n_rows;
  result["points"] = found->n;
  result["inside"] = found->n_inside;
  result["outside"] = found->n_outside;
  result["mean"] = number(found->mean);
  result["least"] = number(found->least);
  result["greatest"] = number(found->greatest);
  result["least_to_mean"] = number(found->least_to_mean());
  result["least_to_greatest"] = number(found->least_to_greatest());
  return result;
}

json meters_json(const Desk& desk) {
  json points = json::array();
  for (std::size_t k = 0; k < desk.meter.points().size(); ++k) {
    const MeterPoint& point = desk.meter.points()[k];
    const auto value = meter_value(desk, k);
    points.push_back({{"position", list(point.position)},
                      {"normal", list(point.normal)},
                      {"surface", point.surface},
                      {"value", value ? number(*value) : json(nullptr)},
                      {"unit", measured_unit(desk.session)}});
  }
  return points;
}

json open_patches_json(const Session& session) {
  const Known known = session.known();
  const std::vector<std::int32_t>* patches = open_patches(known);
  return patches != nullptr ? json(*patches) : json(nullptr);
}

json examples_json(const Desk& desk) {
  json examples = json::array();
  for (const Example& example : desk.examples.list()) {
    examples.push_back({{"path", example.path},
                        {"name", example.name},
                        {"has_picture", example.picture != nullptr}});
  }
  return examples;
}

json size_json(const Session& session) {
  if (!session.is_open()) return nullptr;
  return list(radiosity::Vec3(session.model().bounds.sizes()));
}

json camera_json(const Desk& desk) {
  const radiosity::Camera& camera = desk.camera.camera();
  return {{"position", list(camera.position)},
          {"direction", list(camera.direction)},
          {"up", list(camera.up)},
          {"fov", number(camera.vertical_fov * 180 / radiosity::kPi)}};
}

json views_json(const Desk& desk) {
  json names = json::array();
  for (const SavedView& view : desk.views) names.push_back(view.name);
  return names;
}

json surfaces_json(const Desk& desk) {
  const auto optional = [](const std::optional<double>& value) {
    return value ? number(*value) : json(nullptr);
  };
  std::vector<SurfaceTotal> totals = surface_totals(desk.session);
  sort(totals, desk.surface_order);
  json list = json::array();
  for (const SurfaceTotal& total : totals) {
    list.push_back({{"name", total.name},
                    {"material", total.material},
                    {"patches", total.n_patches},
                    {"area", number(total.area)},
                    {"flux", optional(total.flux)},
                    {"irradiance", optional(total.irradiance)},
                    {"heat", optional(total.heat)},
                    {"temperature", optional(total.temperature)},
                    {"shown", !desk.look.hidden.contains(total.surface)},
                    {"marked", desk.marks.contains(total.surface)}});
  }
  return list;
}

json tape_json(const Desk& desk) {
  const auto difference = desk.tape.difference();
  if (!difference) return nullptr;
  return {{"from", list(*desk.tape.from)},
          {"to", list(*desk.tape.to)},
          {"difference", list(*difference)},
          {"distance", number(difference->norm())}};
}

json iteration_json(const Desk& desk) {
  const IterationRecord* record = desk.session.iteration();
  if (record == nullptr || record->frames.empty()) return nullptr;
  json frames = json::array();
  for (const auto& frame : record->frames) {
    frames.push_back({{"iteration", frame->iteration},
                      {"work", number(frame->work)},
                      {"unshot_share", number(frame->unshot_share)},
                      {"shooter", frame->shooter ? json(*frame->shooter) : json(nullptr)}});
  }
  json bounds = json::array();
  for (const double bound : record->bounds) bounds.push_back(number(bound));
  json compared = json::array();
  for (const auto& other : desk.session.compared()) {
    compared.push_back(std::string(radiosity::method_name(other->method)));
  }
  return {{"method", std::string(radiosity::method_name(record->method))},
          {"text", watched_text(desk.session, desk.look)},
          {"stale", desk.session.is_iteration_stale()},
          {"compared", compared},
          {"playing", desk.watching.is_playing},
          {"speed", number(desk.watching.speed)},
          {"log", desk.watching.is_logarithmic},
          {"complete", record->is_complete},
          {"step", std::min(desk.look.step, record->frames.size() - 1)},
          {"frames", frames},
          {"bounds", bounds}};
}

/// Memory of this process, as Linux tells; null elsewhere.
json resident_bytes() {
  std::ifstream stream("/proc/self/statm");
  long pages = 0;
  long resident = 0;
  if (!(stream >> pages >> resident)) return nullptr;
  return resident * sysconf(_SC_PAGESIZE);
}

}  // namespace

json state_report(const Desk& desk) {
  const Session& session = desk.session;
  json messages = json::array();
  for (const Message& message : session.messages()) {
    messages.push_back(
        {{"error", message.is_error}, {"text", message.text}, {"past", message.is_past}});
  }
  return {{"path", session.model().path},
          {"changed_file",
           session.changed_file() ? json(session.changed_file()->string()) : json(nullptr)},
          {"patches", session.is_open() ? session.model().mesh->size() : 0},
          {"size", size_json(session)},
          {"unit", session.model().unit ? json(*session.model().unit) : json(nullptr)},
          {"up", up_name(desk.up)},
          {"scale", number(desk.scale)},
          {"resident_bytes", resident_bytes()},
          {"progress", {{"text", session.job().text()}, {"done", session.job().fraction()}}},
          {"settled", session.is_settled()},
          {"paused", session.is_paused()},
          {"light", light_json(session)},
          {"selected", patch_json(desk)},
          {"mix", mix_json(session)},
          {"luminaires", luminaires_json(desk)},
          {"look", look_json(desk)},
          {"comparison", comparison_json(desk)},
          {"open_patches", open_patches_json(session)},
          {"camera", camera_json(desk)},
          {"views", views_json(desk)},
          {"tape", tape_json(desk)},
          {"work_plane", work_plane_json(desk)},
          {"grids", grids_json(desk)},
          {"daylight", daylight_json(desk)},
          {"couplings", couplings_json(desk)},
          {"meters", meters_json(desk)},
          {"surfaces", surfaces_json(desk)},
          {"region",
           {{"left", desk.region.left},
            {"top", desk.region.top},
            {"width", desk.region.width},
            {"height", desk.region.height}}},
          {"iteration", iteration_json(desk)},
          {"console_lines", desk.console_lines},
          {"tour", desk.tour_step ? json(*desk.tour_step + 1) : json(nullptr)},
          {"examples", examples_json(desk)},
          {"messages", messages}};
}

}  // namespace viewer
