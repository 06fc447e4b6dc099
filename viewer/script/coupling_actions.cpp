#include "viewer/script/coupling_actions.h"

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "viewer/desk/couplings.h"
#include "viewer/script/report_values.h"

namespace viewer {

using nlohmann::json;

namespace {

void find_couplings(Stage& stage, ScriptArguments& arguments) {
  if (!stage.desk.session.is_thermal()) {
    throw std::invalid_argument("only surfaces of thermal scenes have couplings");
  }
  stage.desk.network.set_wanted(arguments.flag_or("on", true));
}

}  // namespace

std::map<std::string, ActionKind> coupling_actions() {
  return {{"couplings", {"on", at_once(find_couplings)}}};
}

json couplings_json(const Desk& desk) {
  const auto surface = asked_surface(desk.session);
  if (!surface || desk.network.network() == nullptr) return nullptr;
  const auto sunlight = absorbed_sunlight(desk.session.model().bands, desk.fluxes, *surface);
  json all = json::array();
  for (const Coupling& coupling :
       couplings(desk.network.network(), desk.session.model().mesh->surface_names, *surface)) {
    all.push_back({{"with", coupling.name},
                   {"area", number(coupling.area)},
                   {"gebhart", number(coupling.gebhart)}});
  }
  return {{"surface", desk.session.model().mesh->surface_names[*surface]},
          {"absorbed_sunlight", sunlight ? number(*sunlight) : json(nullptr)},
          {"with", all}};
}

}  // namespace viewer
