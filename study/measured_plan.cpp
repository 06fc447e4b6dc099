#include "study/measured_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "radiosity/base/error.h"
#include "radiosity/meter/luminaire_glare.h"
#include "radiosity/meter/luminance_meter.h"
#include "radiosity/picture/point_grid.h"
#include "radiosity/solve/surface_flux.h"

namespace study {
namespace {

using radiosity::Index;
using radiosity::Scene;
using radiosity::Vec3;

bool emits(const radiosity::Material& material) {
  return material.emission.kind != radiosity::Emission::Kind::none;
}

/// That of the material that emits; throws if both sides do, and age otherwise.
double maintenance_factor(const Scene& scene, const radiosity::Surface& surface) {
  const radiosity::Material& front = scene.materials[surface.material];
  if (!surface.two_sided || surface.back_material < 0) return front.maintenance_factor;
  const radiosity::Material& back = scene.materials[surface.back_material];
  if (!emits(back)) return front.maintenance_factor;
  if (emits(front) && front.maintenance_factor != back.maintenance_factor) {
    throw radiosity::SceneError(fmt::format(
        "surface '{}': its sides emit with the maintenance factors {} and {}, expected one",
        surface.name, front.maintenance_factor, back.maintenance_factor));
  }
  return back.maintenance_factor;
}

/// What is left of the light that each surface emits by itself.
std::vector<double> maintenance_factors(const Scene& scene, double factor) {
  std::vector<double> factors;
  for (const radiosity::Surface& surface : scene.surfaces) {
    factors.push_back(factor * maintenance_factor(scene, surface));
  }
  return factors;
}

/// The scene as it is then.
Scene maintained(Scene scene, const MeasuredPlan& plan) {
  for (std::size_t k = 0; k < scene.luminaires.size(); ++k) {
    scene.luminaires[k].dimming *= plan.luminaire_factors[k];
  }
  for (std::size_t k = 0; k < scene.surfaces.size(); ++k) {
    scene.surfaces[k].emission_factor *= plan.maintenance_factors[k];
  }
  return scene;
}

void check_light(const Scene& scene, const StudyEvents& events) {
  if (radiosity::is_thermal(scene)) {
    throw radiosity::SceneError(
        fmt::format("{}: the light is heat, which is not measured in lux", scene.source));
  }
  if (scene.environment.kind != radiosity::Emission::Kind::none) {
    events.warn(fmt::format("{}: points do not see the environment, whose direct light is missing",
                            scene.source));
  }
}

void warn_of_places(const MeasuredPlanGrid& grid, const StudyEvents& events) {
  const auto summary =
      radiosity::summary(grid.light.places, grid.light.quantities.front().total(0));
  const auto tell = [&](Index n, const char* what) {
    if (n == 0) return;
    events.warn(fmt::format("grid \"{}\": {} of {} points {} and count nothing", grid.plan.name, n,
                            grid.light.where.size(), what));
  };
  tell(summary.n_inside, "lie in solids");
  tell(summary.n_outside, "lie outside");
}

void warn_of_sources(const MeasuredObserver& observer, const StudyEvents& events) {
  const auto n = std::count_if(
      observer.glare.sources.begin(), observer.glare.sources.end(), [](const auto& source) {
        return source.position && (source.solid_angle < radiosity::kSmallestGlareSource ||
                                   source.solid_angle > radiosity::kLargestGlareSource);
      });
  if (n == 0) return;
  events.warn(
      fmt::format("observer \"{}\": {} of {} sources are smaller than {:g} or larger than "
                  "{:g} sr, for which UGR is not made",
                  observer.observer.name, n, observer.glare.sources.size(),
                  radiosity::kSmallestGlareSource, radiosity::kLargestGlareSource));
}

/// What eyes see of a grid, if there are any.
void add_luminances(const radiosity::GridPlan& plan, const LitScene& solved,
                    const std::vector<radiosity::Lighting>& lights, const Eigen::VectorXd& weights,
                    radiosity::GridLight& light, const StudyEvents& events) {
  if (plan.luminance_from.empty()) return;
  const radiosity::LuminanceMeter meter(solved.mesh, solved.visibility, lights, weights);
  for (auto& quantity : radiosity::measure_luminance(plan, light, meter, events.progress)) {
    light.quantities.push_back(std::move(quantity));
  }
}

/// Of new lamps.
std::vector<MeasuredObserver> measured_observers(const LitScene& solved,
                                                 const radiosity::LightPlan& plan,
                                                 const radiosity::Photometer& photometer,
                                                 const Eigen::VectorXd& weights,
                                                 const StudyEvents& events) {
  std::vector<MeasuredObserver> result;
  if (plan.observers.empty()) return result;
  const radiosity::LuminaireGlare luminaires(solved.scene, solved.mesh, weights);
  if (const Index n = luminaires.n_without_opening(); n > 0) {
    events.warn(fmt::format("{}: {} luminaires have no luminous opening, and UGR leaves them out",
                            solved.scene.source, n));
  }
  for (const radiosity::Observer& observer : plan.observers) {
    result.push_back({observer, radiosity::find_glare(observer, solved.mesh, photometer)});
    for (radiosity::GlareSource& source : luminaires.sources(observer)) {
      result.back().glare.sources.push_back(std::move(source));
    }
    warn_of_sources(result.back(), events);
  }
  return result;
}

}  // namespace

std::optional<Vec3> down_to_floor(const radiosity::GridPlan& grid, const Scene& scene,
                                  const radiosity::PatchMesh& mesh) {
  if (!grid.surface.empty() || (grid.is_list() && scene.sky)) return {};
  Vec3 up = grid.is_list() ? Vec3::UnitZ() : Vec3(grid.sides[0].cross(grid.sides[1]).normalized());
  if (scene.sky) up = scene.sky->up;
  if (grid.up) up = *grid.up;
  if (!radiosity::find_floor(mesh, up).is_found) return {};
  return -up;
}

std::optional<double> MeasuredPlan::largest_ugr() const {
  std::optional<double> largest;
  for (const MeasuredObserver& observer : observers) {
    const auto ugr = observer.glare.ugr();
    if (ugr && (!largest || *ugr > *largest)) largest = ugr;
  }
  return largest;
}

MeasuredPlan measure_plan(const Study& solved, const radiosity::LightPlan& plan,
                          const StudyOptions& options, double efficacy, const StudyEvents& events) {
  const LitScene lit = {solved.scene, solved.mesh, solved.visibility, *solved.transport,
                        solved.solution};
  return measure_plan(lit, plan, options, efficacy, events);
}

MeasuredPlan measure_plan(const LitScene& solved, const radiosity::LightPlan& plan,
                          const StudyOptions& options, double efficacy, const StudyEvents& events) {
  const Scene& scene = solved.scene;
  check_light(scene, events);
  MeasuredPlan result;
  result.maintenance_factor = plan.maintenance_factor;
  result.maintenance_factors = maintenance_factors(scene, plan.maintenance_factor);
  for (const radiosity::Luminaire& luminaire : scene.luminaires) {
    result.luminaire_factors.push_back(plan.maintenance_factor * luminaire.maintenance_factor);
  }
  const auto is_below_one = [](double factor) { return factor != 1; };
  result.has_maintenance =
      std::any_of(result.maintenance_factors.begin(), result.maintenance_factors.end(),
                  is_below_one) ||
      std::any_of(result.luminaire_factors.begin(), result.luminaire_factors.end(), is_below_one);
  const Scene later = maintained(scene, result);
  radiosity::Solution later_solution;
  std::vector<radiosity::Lighting> lights = {{scene, solved.solution}};
  if (result.has_maintenance) {
    later_solution = solve_light(later, solved.mesh, solved.transport, options, events).solution;
    lights.push_back({later, later_solution});
  }
  const Eigen::VectorXd weights = radiosity::luminous_weights(scene.bands, efficacy);
  const radiosity::Photometer photometer(solved.mesh, lights, weights);
  for (const radiosity::GridPlan& grid : plan.grids) {
    result.grids.push_back(
        {grid, radiosity::measure_grid(grid, solved.mesh, solved.visibility, photometer,
                                       down_to_floor(grid, scene, solved.mesh), events.progress)});
    add_luminances(grid, solved, lights, weights, result.grids.back().light, events);
    warn_of_places(result.grids.back(), events);
  }
  result.observers = measured_observers(solved, plan, photometer, weights, events);
  return result;
}

}  // namespace study
