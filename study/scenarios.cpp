#include "study/scenarios.h"

#include <algorithm>
#include <map>
#include <utility>

#include "radiosity/base/error.h"
#include "radiosity/compressed/light_polygons.h"
#include "radiosity/scene/emissivity_table.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/solve/conditions.h"
#include "radiosity/visibility/incident_light.h"

namespace study {
namespace {

using namespace radiosity;

/// Columns that are solved together, more or less: enough for products to be cheap, few enough for
/// the memory of a million patches.
constexpr Index kMostColumns = 24;

/// The reflectance of each surface, which tells whether scenarios can share a solve.
std::vector<double> surface_reflectances(const Scene& scene) {
  std::vector<double> values;
  for (const Surface& surface : scene.surfaces) {
    for (const int material : {surface.material, surface.back_material}) {
      if (material < 0) continue;
      const Eigen::VectorXd& reflectance = scene.materials[material].reflectance;
      values.insert(values.end(), reflectance.begin(), reflectance.end());
    }
  }
  return values;
}

/// Light from without for scenarios one after the other, made anew where luminaires are dimmed
/// otherwise than for the one before.
class IncidentLights {
 public:
  IncidentLights(const PatchMesh& mesh, const Progress& progress)
      : mesh_(mesh), progress_(progress) {}

  const IncidentIrradiance& of(const Scene& scene) {
    std::vector<double> dimming;
    for (const Luminaire& luminaire : scene.luminaires) dimming.push_back(luminaire.dimming);
    if (!is_made_ || dimming != dimming_) {
      incident_ = incident_on_patches(scene, mesh_, progress_);
    }
    is_made_ = true;
    dimming_ = std::move(dimming);
    return incident_;
  }

 private:
  const PatchMesh& mesh_;
  const Progress& progress_;
  bool is_made_ = false;
  std::vector<double> dimming_;
  IncidentIrradiance incident_;
};

/// Indices of scenarios that share a solve.
using Group = std::vector<std::size_t>;

/// Emissivities that depend on the temperature, which other light makes another, are settled for
/// each by itself.
std::vector<Group> make_groups(const Scene& scene, const std::vector<Scenario>& scenarios) {
  std::map<std::vector<double>, Group> by_reflectance;
  std::vector<Group> groups;
  for (std::size_t k = 0; k < scenarios.size(); ++k) {
    const Scene painted = scene_of(scene, scenarios[k]);
    if (has_emissivity_tables(painted)) {
      groups.push_back({k});
    } else {
      by_reflectance[surface_reflectances(painted)].push_back(k);
    }
  }
  const auto most =
      static_cast<std::size_t>(std::max<Index>(1, kMostColumns / scene.bands.count()));
  for (const auto& [reflectance, all] : by_reflectance) {
    for (std::size_t first = 0; first < all.size(); first += most) {
      const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first);
      groups.emplace_back(begin,
                          begin + static_cast<std::ptrdiff_t>(std::min(most, all.size() - first)));
    }
  }
  std::sort(groups.begin(), groups.end());
  return groups;
}

/// All polygons that emit in some scenario.
Eigen::MatrixXd total_exitance(const Study& study, const std::vector<Scenario>& scenarios) {
  Eigen::MatrixXd total = Eigen::MatrixXd::Zero(study.mesh.size(), study.scene.bands.count());
  for (const Scenario& scenario : scenarios) {
    total += exitance(scene_of(study.scene, scenario), study.mesh).cwiseAbs();
  }
  return total;
}

/// Columns first to first + n - 1 as a solution by themselves.
Solution columns_of(const Solution& all, Index first, Index n) {
  Solution part = all;
  for (Eigen::MatrixXd Solution::*field :
       {&Solution::radiosity, &Solution::irradiance, &Solution::exitance, &Solution::reflectance,
        &Solution::radiosity_error}) {
    part.*field = (all.*field).middleCols(first, n);
  }
  if (all.incident.size() > 0) part.incident = all.incident.middleCols(first, n);
  for (Eigen::VectorXd EnergyBalance::*field :
       {&EnergyBalance::emitted, &EnergyBalance::incident, &EnergyBalance::absorbed,
        &EnergyBalance::escaped}) {
    part.energy.*field = (all.energy.*field).segment(first, n);
  }
  return part;
}

}  // namespace

Study solve_scenarios(Study study, const std::vector<Scenario>& scenarios,
                      const StudyOptions& options, const StudyEvents& events,
                      const ScenarioVisitor& visit) {
  const Scene scene = study.scene;
  const std::vector<Group> groups = make_groups(scene, scenarios);
  add_missing_light(
      *study.transport, study.mesh, study.visibility,
      {.tolerance = study.factor_tolerance, .seed = options.seed, .progress = events.progress},
      total_exitance(study, scenarios));
  const Index n_bands = scene.bands.count();
  IncidentLights incident(study.mesh, events.progress);
  for (const Group& group : groups) {
    study.scene = scene_of(scene, scenarios[group.front()]);
    if (has_emissivity_tables(study.scene)) {
      Light light = solve_light(study.scene, study.mesh, *study.transport, incident.of(study.scene),
                                options, events);
      study.solution = std::move(light.solution);
      study.discretisation = std::move(light.discretisation);
      study.emissivity = light.emissivity;
      visit(group.front(), study);
      study.emissivity = {};
      continue;
    }
    Eigen::MatrixXd emitted(study.mesh.size(), n_bands * static_cast<Index>(group.size()));
    Eigen::MatrixXd from_without;  // in columns like those
    Eigen::MatrixXd incident_error;
    for (std::size_t k = 0; k < group.size(); ++k) {
      study.scene = scene_of(scene, scenarios[group[k]]);
      emitted.middleCols(static_cast<Index>(k) * n_bands, n_bands) =
          exitance(study.scene, study.mesh);
      const IncidentIrradiance& beside = incident.of(study.scene);
      const Eigen::MatrixXd here =
          make_conditions(study.scene, study.mesh, *study.transport, beside.irradiance).incident;
      if (here.size() == 0) continue;
      if (beside.error.size() > 0) {
        if (incident_error.size() == 0) {
          incident_error = Eigen::MatrixXd::Zero(emitted.rows(), emitted.cols());
        }
        incident_error.middleCols(static_cast<Index>(k) * n_bands, n_bands) =
            beside.error.replicate(1, n_bands);
      }
      from_without.conservativeResize(emitted.rows(), emitted.cols());
      from_without.middleCols(static_cast<Index>(k) * n_bands, n_bands) = here;
    }
    Conditions conditions = make_conditions(study.scene, study.mesh, *study.transport);
    conditions.exitance = std::move(emitted);
    conditions.incident = std::move(from_without);
    conditions.incident_error = std::move(incident_error);
    const Light light = solve_light(study.mesh, *study.transport, conditions, options, events);
    study.discretisation = light.discretisation;
    for (std::size_t k = 0; k < group.size(); ++k) {
      study.scene = scene_of(scene, scenarios[group[k]]);
      study.solution = columns_of(light.solution, static_cast<Index>(k) * n_bands, n_bands);
      if (conditions.emissivity.size() > 0) {
        study.solution.temperature =
            temperatures(study.mesh, study.solution, conditions.emissivity);
      }
      visit(group[k], study);
    }
  }
  study.scene = scene;
  study.solution = {};
  study.discretisation = {};
  return study;
}

}  // namespace study
