#include "radiosity/solve/conditions.h"

#include <cmath>
#include <string>
#include <utility>

#include "radiosity/base/error.h"
#include "radiosity/scene/patch_heat.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/solve/surface_flux.h"

namespace radiosity {
namespace {

/// σ T⁴ below 0 by less than this share of B and H is rounding, or what the iteration leaves.
constexpr double kColdRounding = 1e-6;

/// Shares of light that differ by no more are one, of which others are made.
constexpr double kSameShare = 1e-15;

/// Whether patch i emits what it does whatever it receives, so that this is known without the
/// rounding of B and H; else its heat tells.
bool emits_by_itself(const Solution& solution, Index i, double emissivity) {
  const double reflectance = solution.reflectance(i, 0);
  const bool is_sheet =
      solution.transmission.size() > 0 && solution.transmission.innerVector(i).nonZeros() > 0;
  return !is_sheet && reflectance < 1 && std::abs(reflectance - (1 - emissivity)) <= kSameShare;
}

/// Of patch i that takes up `net` of the irradiance h, W/m².
[[noreturn]] void refuse_cold(const PatchMesh& mesh, Index i, double net, double h) {
  const std::string received = h >= 0 ? "; it receives " + std::to_string(h) +
                                            " W/m² and can take up no more than it absorbs"
                                      : ", more than all others can give it";
  throw SolveError("surface '" + mesh.surface_names[mesh.surface[i]] + "': patch " +
                   std::to_string(i) + " would have to be below absolute zero to take up " +
                   std::to_string(net) + " W/m²" + received);
}

/// `single` is what is given to patches by themselves.
bool is_given_heat(const Scene& scene, const PatchMesh& mesh, const PatchHeat& single,
                   Index patch) {
  if (scene.surfaces[mesh.surface[patch]].is_shield) return true;
  if (!single.empty() && !std::isnan(single.heat_flux[patch])) return true;
  if (!single.empty() && !std::isnan(single.temperature[patch])) return false;
  const Emission::Kind kind = scene.materials[material_of(scene, mesh, patch)].emission.kind;
  return kind == Emission::Kind::heat_flux || kind == Emission::Kind::heat_power;
}

/// The heat added to patches whose net heat is given; to shields as much of that of both sides as
/// each emits.
void add_heat(const Scene& scene, const PatchMesh& mesh, const Eigen::VectorXd& added,
              Conditions& conditions) {
  const PatchHeat single = patch_heat(scene, mesh);
  for (Index i = 0; i < mesh.size(); ++i) {
    if (!is_given_heat(scene, mesh, single, i)) continue;
    const Index twin = mesh.twin[i];
    if (!scene.surfaces[mesh.surface[i]].is_shield || twin < 0) {
      conditions.exitance(i, 0) += added[i];
      continue;
    }
    const double own = conditions.emissivity[i];
    const double both = own + conditions.emissivity[twin];
    if (both > 0) conditions.exitance(i, 0) += own / both * (added[i] + added[twin]);
  }
}

void require_grey_where_heat_is_given(const Scene& scene, const PatchMesh& mesh) {
  if (scene.bands.kind == Bands::Kind::grey) return;
  const PatchHeat single = patch_heat(scene, mesh);
  for (Index i = 0; i < mesh.size(); ++i) {
    if (!is_given_heat(scene, mesh, single, i)) continue;
    throw SceneError("surface '" + mesh.surface_names[mesh.surface[i]] +
                     "': heat or a shield in a scene whose bands are not grey; its temperature "
                     "would couple them");
  }
}

}  // namespace

Conditions make_conditions(const Scene& scene, const PatchMesh& mesh, const Transport& transport,
                           const Eigen::MatrixXd& sun, const Eigen::VectorXd& added,
                           const Eigen::VectorXd& given) {
  require_grey_where_heat_is_given(scene, mesh);
  Conditions conditions{.exitance = exitance(scene, mesh, given),
                        .reflectance = reflectance(scene, mesh, given),
                        .incident = sun,
                        .transmission = transmission(scene, mesh, given),
                        .emissivity = {}};
  const Eigen::VectorXd environment = environment_exitance(scene);
  if (environment.size() > 0 && !environment.isZero(0)) {
    const Eigen::MatrixXd entering = environment_irradiance(transport, environment);
    if (sun.size() > 0) {
      conditions.incident += entering;
    } else if (!entering.isZero(0)) {
      conditions.incident = entering;
    }
  }
  const bool is_grey_heat = scene.bands.kind == Bands::Kind::grey && is_thermal(scene);
  if (is_grey_heat) {
    conditions.emissivity = given.size() > 0 ? given : emissivity(scene, mesh).col(0).eval();
  }
  if (added.size() > 0) add_heat(scene, mesh, added, conditions);
  return conditions;
}

SolveOptions with_conditions(SolveOptions options, const Conditions& conditions, Index n_columns) {
  options.transmission = conditions.transmission;
  if (conditions.incident.size() > 0) {
    options.incident =
        conditions.incident.replicate(1, n_columns / conditions.incident.cols()).eval();
  }
  options.has_sinks = conditions.emissivity.size() > 0;
  return options;
}

Eigen::MatrixXd environment_irradiance(const Transport& transport,
                                       const Eigen::VectorXd& exitance) {
  const Index n = transport.size();
  Eigen::VectorXd open = 1 - transport.apply(Eigen::VectorXd::Ones(n)).array();
  const AssemblyReport& report = transport.report();
  for (const Eigen::VectorXd* shares : {&report.covered, &report.backs}) {
    if (shares->size() == n) open -= *shares;
  }
  return open.cwiseMax(0) * exitance.transpose();
}

Eigen::VectorXd temperatures(const PatchMesh& mesh, const Solution& solution,
                             const Eigen::VectorXd& emissivity) {
  Eigen::VectorXd result(solution.radiosity.rows());
  for (Index i = 0; i < result.size(); ++i) {
    const double b = solution.radiosity(i, 0);
    const double h = solution.irradiance(i, 0);
    const double e = emissivity[i];
    const double emitted = emits_by_itself(solution, i, e) ? solution.exitance(i, 0)
                           : e > 0                         ? b - (1 - e) * h
                                                           : b;
    if (!(emitted >= -kColdRounding * (std::abs(b) + std::abs(h)))) refuse_cold(mesh, i, h - b, h);
    result[i] = std::pow(std::max(emitted, 0.) / ((e > 0 ? e : 1) * kStefanBoltzmann), 0.25);
  }
  return result;
}

}  // namespace radiosity
