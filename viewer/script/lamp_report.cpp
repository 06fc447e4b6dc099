#include "viewer/script/lamp_report.h"

#include <nlohmann/json.hpp>

#include "viewer/desk/luminaires.h"
#include "viewer/script/report_values.h"

namespace viewer {

using nlohmann::json;

namespace {

const char* kind_name(Emitter::Kind kind) {
  switch (kind) {
    case Emitter::Kind::luminaires:
      return "luminaires";
    case Emitter::Kind::sun:
      return "sun";
    case Emitter::Kind::sky:
      return "sky";
    case Emitter::Kind::surfaces:
      break;
  }
  return "surfaces";
}

}  // namespace

json luminaires_json(const Desk& desk) {
  json luminaires = json::array();
  for (std::size_t k = 0; k < desk.luminaires.size(); ++k) {
    const LuminaireFacts& facts = desk.luminaires[k];
    const auto place = picture_place(desk, desk.session.model().scene->luminaires[k].position);
    luminaires.push_back({{"name", facts.name},
                          {"file", facts.file},
                          {"lumens", number(facts.lumens)},
                          {"text", luminaire_text(facts, desk.session.mix())},
                          {"place", place ? json{place->x(), place->y()} : json(nullptr)},
                          {"seen", is_luminaire_seen(desk, k)},
                          {"hovered", desk.hovered_luminaire == k},
                          {"chosen", desk.chosen_luminaire == k}});
  }
  return luminaires;
}

json mix_json(const Session& session) {
  json emitters = json::array();
  for (const Emitter& emitter : session.mix().emitters) {
    emitters.push_back({{"name", emitter.name},
                        {"scale", emitter.scale},
                        {"on", emitter.is_on},
                        {"kind", kind_name(emitter.kind)}});
  }
  json materials = json::array();
  for (std::size_t m = 0; m < session.mix().reflectance.size(); ++m) {
    materials.push_back({{"name", session.model().scene->materials[m].name},
                         {"reflectance", list(session.mix().reflectance[m])}});
  }
  return {{"emitters", emitters},
          {"materials", materials},
          {"can_undo", session.mix_history().can_undo()},
          {"can_redo", session.mix_history().can_redo()},
          {"change_seconds", number(session.change_seconds())},
          {"superposed", session.can_superpose()}};
}

}  // namespace viewer
