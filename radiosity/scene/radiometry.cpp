#include "radiosity/scene/radiometry.h"

#include <cassert>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "radiosity/scene/black_body.h"
#include "radiosity/scene/patch_heat.h"
#include "radiosity/scene/patch_texture.h"

namespace radiosity {
namespace {

/// Area of each surface that has each material, both sides if they are alike, m².
using MaterialAreas = std::map<std::pair<std::int32_t, int>, double>;

MaterialAreas material_areas(const Scene& scene, const PatchMesh& mesh) {
  MaterialAreas areas;
  for (Index i = 0; i < mesh.size(); ++i) {
    areas[{mesh.surface[i], material_of(scene, mesh, i)}] += mesh.area[i];
  }
  return areas;
}

bool is_given_heat(const Material& material) {
  return material.emission.kind == Emission::Kind::heat_flux ||
         material.emission.kind == Emission::Kind::heat_power;
}

/// M_e of a black body in each band, W/m².
Eigen::VectorXd black_exitance(double kelvin, const Bands& bands) {
  return kStefanBoltzmann * std::pow(kelvin, 4) * thermal_fractions(bands, kelvin);
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
    case Emission::Kind::heat_power:
      return emission.value / area;
    case Emission::Kind::heat_flux:
      return emission.value;
    case Emission::Kind::temperature:
      return (1 - material.reflectance.array())
          .matrix()
          .cwiseProduct(black_exitance(emission.value[0], bands));
  }
  return Eigen::VectorXd::Zero(bands.count());
}

const Surface& surface_of(const Scene& scene, const PatchMesh& mesh, Index patch) {
  return scene.surfaces[mesh.surface[patch]];
}

/// Whether patch i is a side of a shield: it has another.
bool is_shield(const Scene& scene, const PatchMesh& mesh, Index i) {
  return surface_of(scene, mesh, i).is_shield && mesh.twin[i] >= 0;
}

/// 1 - ρ of a patch's material in each band, or what is told of the patch.
Eigen::VectorXd emissivity_of(const Scene& scene, const PatchMesh& mesh,
                              const Eigen::VectorXd& told, Index i) {
  if (told.size() > 0) return Eigen::VectorXd::Constant(1, told[i]);
  return 1 - scene.materials[material_of(scene, mesh, i)].reflectance.array();
}

double grey_emissivity(const Scene& scene, const PatchMesh& mesh, const Eigen::VectorXd& told,
                       Index i) {
  return emissivity_of(scene, mesh, told, i)[0];
}

/// ε ε' / (ε + ε'), the share that one side of a shield passes on to the other; 0 if both are
/// white.
double shield_share(const Scene& scene, const PatchMesh& mesh, const Eigen::VectorXd& told,
                    Index i) {
  const double front = grey_emissivity(scene, mesh, told, i);
  const double back = grey_emissivity(scene, mesh, told, mesh.twin[i]);
  return front + back > 0 ? front * back / (front + back) : 0;
}

}  // namespace

Eigen::MatrixXd exitance(const Scene& scene, const PatchMesh& mesh,
                         const Eigen::VectorXd& emissivity) {
  std::map<std::pair<std::int32_t, int>, Eigen::VectorXd> values;
  for (const auto& [key, area] : material_areas(scene, mesh)) {
    const auto& [surface, material] = key;
    values[key] = scene.surfaces[surface].emission_factor *
                  surface_exitance(scene.materials[material], area, scene.bands);
  }
  Eigen::MatrixXd result(mesh.size(), scene.bands.count());
  for (Index i = 0; i < mesh.size(); ++i) {
    const Eigen::VectorXd& value = values.at({mesh.surface[i], material_of(scene, mesh, i)});
    assert(value.size() == result.cols());
    result.row(i) = value.transpose();
  }
  // The temperature of a shield carries the heat given to either side, ε q / (ε + ε') of it.
  const Eigen::MatrixXd given = result;
  for (Index i = 0; i < mesh.size(); ++i) {
    if (!is_shield(scene, mesh, i)) continue;
    const Index twin = mesh.twin[i];
    const double own = grey_emissivity(scene, mesh, emissivity, i);
    const double both = own + grey_emissivity(scene, mesh, emissivity, twin);
    result.row(i) = (both > 0 ? own / both : 0.) * (given.row(i) + given.row(twin));
  }
  const PatchHeat heat = patch_heat(scene, mesh);
  for (Index i = 0; i < mesh.size() && !heat.empty(); ++i) {
    if (!std::isnan(heat.heat_flux[i])) result(i, 0) = heat.heat_flux[i];
    if (std::isnan(heat.temperature[i])) continue;
    result.row(i) = emissivity_of(scene, mesh, emissivity, i)
                        .cwiseProduct(black_exitance(heat.temperature[i], scene.bands));
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

Eigen::MatrixXd reflectance(const Scene& scene, const PatchMesh& mesh,
                            const Eigen::VectorXd& emissivity) {
  Eigen::MatrixXd result(mesh.size(), scene.bands.count());
  for (Index i = 0; i < mesh.size(); ++i) {
    const Material& material = scene.materials[material_of(scene, mesh, i)];
    assert(material.reflectance.size() == result.cols());
    result.row(i) = material.reflectance.transpose();
    if (material.texture) {
      result.row(i) = patch_texture(scene, mesh, i, *material.texture).mean.matrix().transpose();
    }
    if (emissivity.size() > 0) result(i, 0) = 1 - emissivity[i];
    if (is_shield(scene, mesh, i)) {
      result.row(i).setConstant(1 - shield_share(scene, mesh, emissivity, i));
    } else if (is_given_heat(material)) {
      result.row(i).setOnes();
    }
  }
  const PatchHeat heat = patch_heat(scene, mesh);
  for (Index i = 0; i < mesh.size() && !heat.empty(); ++i) {
    if (!std::isnan(heat.heat_flux[i])) result.row(i).setOnes();
    if (std::isnan(heat.temperature[i])) continue;
    result.row(i) = scene.materials[material_of(scene, mesh, i)].reflectance.transpose();
    if (emissivity.size() > 0) result(i, 0) = 1 - emissivity[i];
  }
  return result;
}

Eigen::SparseMatrix<double> transmission(const Scene& scene, const PatchMesh& mesh,
                                         const Eigen::VectorXd& emissivity) {
  std::vector<Eigen::Triplet<double>> shares;
  for (Index i = 0; i < mesh.size(); ++i) {
    if (!is_shield(scene, mesh, i)) continue;
    shares.emplace_back(i, mesh.twin[i], shield_share(scene, mesh, emissivity, i));
  }
  if (shares.empty()) return {};
  Eigen::SparseMatrix<double> result(mesh.size(), mesh.size());
  result.setFromTriplets(shares.begin(), shares.end());
  return result;
}

Eigen::MatrixXd emissivity(const Scene& scene, const PatchMesh& mesh) {
  Eigen::MatrixXd result(mesh.size(), scene.bands.count());
  for (Index i = 0; i < mesh.size(); ++i) {
    result.row(i) =
        1 - scene.materials[material_of(scene, mesh, i)].reflectance.transpose().array();
  }
  return result;
}

Eigen::VectorXd environment_exitance(const Scene& scene) {
  if (scene.environment.kind == Emission::Kind::none) return {};
  const Material black{.name = {},
                       .reflectance = Eigen::VectorXd::Zero(scene.bands.count()),
                       .emission = scene.environment};
  return surface_exitance(black, 1, scene.bands);
}

}  // namespace radiosity
