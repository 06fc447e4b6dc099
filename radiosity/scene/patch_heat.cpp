#include "radiosity/scene/patch_heat.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "radiosity/base/error.h"
#include "radiosity/scene/patch_material.h"

namespace radiosity {
namespace {

constexpr double kNotGiven = std::numeric_limits<double>::quiet_NaN();

[[noreturn]] void refuse(const GivenHeat& given, const std::string& what) {
  throw SceneError(given.source + ": " + what);
}

std::string what_is_given(const GivenHeat& given) {
  return given.kind == GivenHeat::Kind::temperature ? "temperature" : "heat flux";
}

void check_bands(const GivenHeat& given, const Bands& bands) {
  if (given.kind == GivenHeat::Kind::heat_flux && bands.kind != Bands::Kind::grey) {
    refuse(given, "heat fluxes need a scene with \"bands\": \"grey\"");
  }
  if (!bands.hold_heat()) {
    refuse(given, "temperatures need a scene with \"bands\": \"grey\", or bands of heat");
  }
}

/// What its numbers count, cells being one or the other.
GivenHeat::Of counted(const GivenHeat& given, Index n_patches, Index n_polygons) {
  if (given.of != GivenHeat::Of::cells) return given.of;
  const auto n = static_cast<Index>(given.values.size());
  if (n == n_patches) return GivenHeat::Of::patches;
  if (n == n_polygons) return GivenHeat::Of::polygons;
  refuse(given, "has " + std::to_string(n) + " cells, expected one for each of the " +
                    std::to_string(n_patches) + " patches or the " + std::to_string(n_polygons) +
                    " polygons");
}

/// Sets the values on patches, and refuses what they cannot have.
class Giver {
 public:
  Giver(const Scene& scene, const PatchMesh& mesh) : scene_(scene), mesh_(mesh) {
    result_.temperature.setConstant(mesh.size(), kNotGiven);
    result_.heat_flux.setConstant(mesh.size(), kNotGiven);
  }

  void give(const GivenHeat& given) {
    check_bands(given, scene_.bands);
    const bool by_patch =
        counted(given, mesh_.size(), scene_.n_polygons()) == GivenHeat::Of::patches;
    const Index n = by_patch ? mesh_.size() : scene_.n_polygons();
    Eigen::VectorXd values = Eigen::VectorXd::Constant(n, kNotGiven);
    for (const auto& [number, value] : given.values) {
      const std::string name = (by_patch ? "patch " : "polygon ") + std::to_string(number);
      if (number < 0 || number >= n) {
        refuse(given, "has a value for " + name + ", but there are " + std::to_string(n));
      }
      if (std::isnan(value)) continue;  // this one is not given
      if (!std::isnan(values[number])) refuse(given, "has two values for " + name);
      check(given, name, value);
      values[number] = value;
    }
    for (Index i = 0; i < mesh_.size(); ++i) {
      const double value = values[by_patch ? i : mesh_.polygon[i]];
      if (!std::isnan(value)) give(given, i, value);
    }
  }

  PatchHeat result() && { return std::move(result_); }

 private:
  static void check(const GivenHeat& given, const std::string& name, double value) {
    const bool is_temperature = given.kind == GivenHeat::Kind::temperature;
    if (std::isfinite(value) && !(is_temperature && value < 0)) return;
    refuse(given, name + " has the " + what_is_given(given) + " " + std::to_string(value) +
                      (is_temperature ? ", expected kelvin, at least 0" : ", expected a number"));
  }

  void give(const GivenHeat& given, Index i, double value) {
    const Surface& surface = scene_.surfaces[mesh_.surface[i]];
    const std::string name = "patch " + std::to_string(i) + " of surface '" + surface.name + "'";
    if (surface.is_shield) {
      refuse(given, name + " is a shield's, whose temperature follows from the heat");
    }
    const Material& material = scene_.materials[material_of(scene_, mesh_, i)];
    if (value != 0 && material.reflectance.minCoeff() == 1) {
      refuse(given, name + " has the emissivity 0 and cannot give off heat");
    }
    if (!std::isnan(result_.temperature[i]) || !std::isnan(result_.heat_flux[i])) {
      refuse(given, name + " has a temperature or heat flux already, from another file");
    }
    (given.kind == GivenHeat::Kind::temperature ? result_.temperature : result_.heat_flux)[i] =
        value;
  }

  const Scene& scene_;
  const PatchMesh& mesh_;
  PatchHeat result_;
};

}  // namespace

PatchHeat patch_heat(const Scene& scene, const PatchMesh& mesh) {
  if (scene.given_heat.empty()) return {};
  Giver giver(scene, mesh);
  for (const GivenHeat& given : scene.given_heat) giver.give(given);
  return std::move(giver).result();
}

}  // namespace radiosity
