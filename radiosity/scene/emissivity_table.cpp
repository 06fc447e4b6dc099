#include "radiosity/scene/emissivity_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "radiosity/scene/patch_heat.h"
#include "radiosity/scene/patch_material.h"

namespace radiosity {

bool needs_emissivity(const Emission& emission) {
  const bool is_heat = emission.kind == Emission::Kind::temperature ||
                       emission.kind == Emission::Kind::heat_flux ||
                       emission.kind == Emission::Kind::heat_power;
  return is_heat && !emission.value.isZero(0);
}

double emissivity_at(const Material& material, double kelvin) {
  const auto& table = material.emissivity_table;
  const auto above = std::find_if(table.begin(), table.end(),
                                  [&](const auto& pair) { return pair.first >= kelvin; });
  if (above == table.begin()) return table.front().second;
  if (above == table.end()) return table.back().second;
  const auto& [t1, e1] = *(above - 1);
  const auto& [t2, e2] = *above;
  const double share = (kelvin - t1) / (t2 - t1);
  return (1 - share) * e1 + share * e2;
}

bool has_emissivity_tables(const Scene& scene) {
  const auto has_table = [&](int material) {
    return material >= 0 && !scene.materials[material].emissivity_table.empty();
  };
  return std::any_of(scene.surfaces.begin(), scene.surfaces.end(), [&](const Surface& surface) {
    return has_table(surface.material) || has_table(surface.back_material);
  });
}

Eigen::VectorXd emissivity_at(const Scene& scene, const PatchMesh& mesh,
                              const Eigen::VectorXd& temperature) {
  Eigen::VectorXd result(mesh.size());
  for (Index i = 0; i < mesh.size(); ++i) {
    const Material& material = scene.materials[material_of(scene, mesh, i)];
    result[i] = material.emissivity_table.empty() ? 1 - material.reflectance[0]
                                                  : emissivity_at(material, temperature[i]);
  }
  return result;
}

Eigen::VectorXd given_temperatures(const Scene& scene, const PatchMesh& mesh) {
  const PatchHeat single = patch_heat(scene, mesh);
  Eigen::VectorXd result =
      Eigen::VectorXd::Constant(mesh.size(), std::numeric_limits<double>::quiet_NaN());
  for (Index i = 0; i < mesh.size(); ++i) {
    const Emission& emission = scene.materials[material_of(scene, mesh, i)].emission;
    if (!single.empty() && !std::isnan(single.temperature[i])) {
      result[i] = single.temperature[i];
    } else if (!single.empty() && !std::isnan(single.heat_flux[i])) {
      continue;
    } else if (emission.kind == Emission::Kind::temperature) {
      result[i] = emission.value[0];
    }
  }
  return result;
}

}  // namespace radiosity
