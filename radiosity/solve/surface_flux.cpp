#include "radiosity/solve/surface_flux.h"

#include <algorithm>

namespace radiosity {

bool is_thermal(const Scene& scene) {
  if (scene.bands.hold_heat() && scene.bands.kind != Bands::Kind::grey) return true;
  if (!scene.given_heat.empty()) return true;
  const auto is_hot = [](const Emission& emission) {
    return emission.kind == Emission::Kind::temperature ||
           emission.kind == Emission::Kind::heat_flux ||
           emission.kind == Emission::Kind::heat_power;
  };
  return is_hot(scene.environment) ||
         std::any_of(scene.surfaces.begin(), scene.surfaces.end(), [&](const auto& surface) {
           return surface.is_shield || is_hot(scene.materials[surface.material].emission) ||
                  (surface.back_material >= 0 &&
                   is_hot(scene.materials[surface.back_material].emission));
         });
}

std::vector<SurfaceFlux> surface_fluxes(const PatchMesh& mesh, const Solution& solution) {
  std::vector<SurfaceFlux> fluxes(mesh.surface_names.size());
  const Eigen::MatrixXd net_flux = solution.net_flux();
  for (std::size_t s = 0; s < fluxes.size(); ++s) {
    fluxes[s].surface = mesh.surface_names[s];
    fluxes[s].band_heat = Eigen::VectorXd::Zero(net_flux.cols());
  }
  for (Index i = 0; i < mesh.size(); ++i) {
    SurfaceFlux& flux = fluxes[mesh.surface[i]];
    flux.area += mesh.area[i];
    flux.band_heat += mesh.area[i] * net_flux.row(i).transpose();
  }
  for (SurfaceFlux& flux : fluxes) {
    flux.heat = flux.band_heat.sum();
    if (flux.area > 0) flux.flux = flux.heat / flux.area;
    if (flux.area > 0 && solution.temperature.size() > 0) flux.temperature = 0;
  }
  if (solution.temperature.size() > 0) {
    for (Index i = 0; i < mesh.size(); ++i) {
      SurfaceFlux& flux = fluxes[mesh.surface[i]];
      *flux.temperature += mesh.area[i] / flux.area * solution.temperature[i];
    }
  }
  return fluxes;
}

}  // namespace radiosity
