#include "radiosity/visibility/incident_light.h"

#include <memory>
#include <optional>
#include <utility>

#include "radiosity/base/error.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/visibility/luminaire_light.h"
#include "radiosity/visibility/sun_shadows.h"

namespace radiosity {

namespace {

/// The sun with its shadows.
struct SunLight {
  SunLight(const Sun& given, const PatchMesh& mesh) : sun(given), shadows(mesh, given.direction) {}

  void add(const Vec3& point, const Vec3& normal, Eigen::Ref<Eigen::VectorXd> irradiance) const {
    if (!shadows.is_lit(point, normal)) return;
    irradiance += shadows.cosine(normal) * sun.irradiance;
  }
  [[nodiscard]] Eigen::MatrixXd irradiance(const PatchMesh& mesh, const Progress& progress) const {
    const Eigen::VectorXd shares = shadows.lit_shares(progress);
    Eigen::MatrixXd result(mesh.size(), sun.irradiance.size());
    for (Index i = 0; i < mesh.size(); ++i) {
      const double section = shadows.cosine(mesh.normal[i]) * shares[i];
      result.row(i) = section * sun.irradiance.transpose();
    }
    return result;
  }

  Sun sun;
  SunShadows shadows;
};

}  // namespace

/// Each is there if the scene has it.
struct IncidentLight::Sources {
  std::optional<SunLight> sun;
  std::optional<LuminaireLight> luminaires;
};

bool has_incident_light(const Scene& scene) {
  return scene.sun.has_value() || !scene.luminaires.empty();
}

IncidentLight::IncidentLight(const Scene& scene, const PatchMesh& mesh) {
  if (!has_incident_light(scene)) return;
  auto sources = std::make_shared<Sources>();
  if (scene.sun) sources->sun.emplace(*scene.sun, mesh);
  if (!scene.luminaires.empty()) sources->luminaires.emplace(scene, mesh);
  sources_ = std::move(sources);
}

void IncidentLight::add(const Vec3& point, const Vec3& normal,
                        Eigen::Ref<Eigen::VectorXd> irradiance) const {
  if (!sources_) return;
  if (sources_->sun) sources_->sun->add(point, normal, irradiance);
  if (sources_->luminaires) sources_->luminaires->add(point, normal, irradiance);
}

Eigen::VectorXd lit_shares(const PatchMesh& mesh, const Vec3& direction, const Progress& progress) {
  return SunShadows(mesh, direction).lit_shares(progress);
}

Eigen::MatrixXd incident_irradiance(const Scene& scene, const PatchMesh& mesh,
                                    const Progress& progress) {
  if (!has_incident_light(scene)) return {};
  if (!scene.symmetry.is_none()) {
    throw SolveError("a sun or a luminaire does not shine on all images of a part");
  }
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(mesh.size(), scene.bands.count());
  if (scene.sun) result += SunLight(*scene.sun, mesh).irradiance(mesh, progress);
  if (!scene.luminaires.empty()) result += LuminaireLight(scene, mesh).irradiance(progress);
  return result;
}

Eigen::MatrixXd initial_radiosity(const Scene& scene, const PatchMesh& mesh,
                                  const Progress& progress) {
  return initial_radiosity(exitance(scene, mesh).cwiseAbs(), reflectance(scene, mesh),
                           incident_irradiance(scene, mesh, progress));
}

}  // namespace radiosity
