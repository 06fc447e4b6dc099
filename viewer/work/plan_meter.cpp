#include "viewer/work/plan_meter.h"

#include <utility>

#include "radiosity/scene/patch_mesh.h"
#include "viewer/work/daylight_factor.h"

namespace viewer {

bool has_light_plan(const Session& session) {
  if (!session.model().scene || session.is_thermal()) return false;
  const radiosity::LightPlan& plan = session.model().scene->light_plan;
  return !plan.grids.empty() || !plan.observers.empty();
}

bool has_grids(const Session& session) {
  return has_light_plan(session) && !session.model().scene->light_plan.grids.empty();
}

void PlanMeter::reset() {
  worker_.cancel();
  begun_.reset();
  measured_.reset();
  readings_.reset();
  warnings_.clear();
}

bool PlanMeter::is_current(const Session& session) const {
  return readings_ && !session.is_change_pending() && measured_ == session.known().light;
}

bool PlanMeter::update(Session& session) {
  bool has_changed = worker_.deliver();
  if (const auto error = worker_.take_error()) {
    session.tell_error(*error);
    has_changed = true;
  }
  for (const std::string& warning : std::exchange(warnings_, {})) session.tell_once(warning);
  const auto light = session.known().light;
  if (light == begun_) return has_changed;
  const bool is_ready = light && light->kind == Light::Kind::complete && light->mix &&
                        session.has_result() && session.model().transport;
  if (worker_.is_busy()) {  // of light that is no more
    worker_.cancel();
    begun_.reset();
  }
  if (!is_wanted_ || !is_ready || !has_light_plan(session)) return has_changed;
  begun_ = light;
  start(session);
  return true;
}

void PlanMeter::start(const Session& session) {
  worker_.start([this, model = session.model(), light = begun_,
                 options = session.options()](const Worker::Context& context) {
    const radiosity::Scene scene = mixed_scene(*model.scene, *light->mix);
    auto warnings = std::make_shared<std::vector<std::string>>();
    const study::StudyEvents events = {
        .warned = [warnings](const std::string& text) { warnings->push_back(text); },
        .progress = context.progress};
    const study::LitScene lit = {scene, *model.mesh, *model.visibility, *model.transport,
                                 light->solution};
    auto readings = std::make_shared<PlanReadings>();
    readings->measured =
        study::measure_plan(lit, scene.light_plan, options, radiosity::kWhiteEfficacy, events);
    readings->checks = study::requirement_checks(readings->measured);
    // By the sky as it is, however dim.
    radiosity::Scene below_sky = scene;
    below_sky.sky = light->mix->sky;
    const study::LitScene by_day = {below_sky, *model.mesh, *model.visibility, *model.transport,
                                    light->solution};
    add_daylight_factors(by_day, readings->measured, options, events);
    context.post([this, readings, light, warnings] {
      readings_ = readings;
      measured_ = light;
      warnings_ = *warnings;
    });
  });
}

}  // namespace viewer
