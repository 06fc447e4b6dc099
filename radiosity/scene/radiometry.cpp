#include "radiosity/scene/radiometry.h"

#include <cassert>
#include <cmath>
#include <vector>

#include "radiosity/scene/black_body.h"

namespace radiosity {
namespace {

/// Emitting area of each surface, both sides if two-sided, m².
std::vector<double> surface_areas(const Scene& scene, const PatchMesh& mesh) {
  std::vector<double> areas(scene.surfaces.size(), 0.0);
  for (Index i = 0; i < mesh.size(); ++i) areas[mesh.surface[i]] += mesh.area[i];
  return areas;
}

/// M_e of a surface of the given material and total area, per band.
Eigen::VectorXd surface_exitance(const Material& material, double area, const Bands& bands) {
  const Emission& emission = material.emission;
  switch (emission.kind) {
    case Emission::Kind::none:
      return Eigen::VectorXd::Zero(bands.count());
    case Emission::Kind::radiance:
      return kPi * emission.value;
    case Emission::Kind::exitance:
      return emission.value;
    case Emission::Kind::power:
      return emission.value / area;
    case Emission::Kind::temperature:
      return kStefanBoltzmann * std::pow(emission.value[0], 4) *
             (1 - material.reflectance.array())
                 .matrix()
                 .cwiseProduct(thermal_fractions(bands, emission.value[0]));
  }
  return Eigen::VectorXd::Zero(bands.count());
}

const Surface& surface_of(const Scene& scene, const PatchMesh& mesh, Index patch) {
  return scene.surfaces[mesh.surface[patch]];
}

}  // namespace

Eigen::MatrixXd exitance(const Scene& scene, const PatchMesh& mesh) {
  const std::vector<double> areas = surface_areas(scene, mesh);
  std::vector<Eigen::VectorXd> values;
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
    const Surface& surface = scene.surfaces[s];
    values.push_back(surface.emission_factor *
                     surface_exitance(scene.materials[surface.material], areas[s], scene.bands));
  }
  Eigen::MatrixXd result(mesh.size(), scene.bands.count());
  for (Index i = 0; i < mesh.size(); ++i) {
    const Eigen::VectorXd& value = values[mesh.surface[i]];
    assert(value.size() == result.cols());
    result.row(i) = value.transpose();
  }
  return result;
}

Eigen::MatrixXd initial_radiosity(const Eigen::MatrixXd& exitance,
                                  const Eigen::MatrixXd& reflectance,
                                  const Eigen::MatrixXd& incident) {
  if (incident.size() == 0) return exitance;
  const Index n = exitance.cols() / incident.cols();
  return exitance + reflectance.cwiseProduct(incident).replicate(1, n);
}

Eigen::MatrixXd reflectance(const Scene& scene, const PatchMesh& mesh) {
  Eigen::MatrixXd result(mesh.size(), scene.bands.count());
  for (Index i = 0; i < mesh.size(); ++i) {
    const Eigen::VectorXd& value = scene.materials[surface_of(scene, mesh, i).material].reflectance;
    assert(value.size() == result.cols());
    result.row(i) = value.transpose();
  }
  return result;
}

}  // namespace radiosity
