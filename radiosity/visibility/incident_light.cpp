#include "radiosity/visibility/incident_light.h"

#include "radiosity/base/error.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/visibility/sun_shadows.h"

namespace radiosity {

struct IncidentLight::Sources {
  Sources(const Sun& given, const PatchMesh& mesh) : sun(given), shadows(mesh, given.direction) {}
  Sun sun;
  SunShadows shadows;
};

IncidentLight::IncidentLight(const Scene& scene, const PatchMesh& mesh) {
  if (scene.sun) sources_ = std::make_shared<Sources>(*scene.sun, mesh);
}

void IncidentLight::add(const Vec3& point, const Vec3& normal,
                        Eigen::Ref<Eigen::VectorXd> irradiance) const {
  if (!sources_ || !sources_->shadows.is_lit(point, normal)) return;
  irradiance += sources_->shadows.cosine(normal) * sources_->sun.irradiance;
}

Eigen::VectorXd lit_shares(const PatchMesh& mesh, const Vec3& direction, const Progress& progress) {
  return SunShadows(mesh, direction).lit_shares(progress);
}

Eigen::MatrixXd incident_irradiance(const Scene& scene, const PatchMesh& mesh,
                                    const Progress& progress) {
  if (!scene.sun) return {};
  if (!scene.symmetry.is_none()) throw SolveError("a sun does not shine on all images of a part");
  const SunShadows shadows(mesh, scene.sun->direction);
  const Eigen::VectorXd shares = shadows.lit_shares(progress);
  Eigen::MatrixXd result(mesh.size(), scene.bands.count());
  for (Index i = 0; i < mesh.size(); ++i) {
    const double section = shadows.cosine(mesh.normal[i]) * shares[i];
    result.row(i) = section * scene.sun->irradiance.transpose();
  }
  return result;
}

Eigen::MatrixXd initial_radiosity(const Scene& scene, const PatchMesh& mesh,
                                  const Progress& progress) {
  return initial_radiosity(exitance(scene, mesh).cwiseAbs(), reflectance(scene, mesh),
                           incident_irradiance(scene, mesh, progress));
}

}  // namespace radiosity
