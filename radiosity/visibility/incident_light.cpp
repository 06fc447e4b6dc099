#include "radiosity/visibility/incident_light.h"

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "radiosity/base/error.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/visibility/luminaire_light.h"
#include "radiosity/visibility/sky_light.h"
#include "radiosity/visibility/sun_shadows.h"

namespace radiosity {

namespace {

/// Adds what patches get of one source to that of the others.
void add_source(const IncidentIrradiance& of_source, IncidentIrradiance& sum) {
  if (sum.irradiance.size() == 0) {
    sum = of_source;
  } else {
    sum.irradiance += of_source.irradiance;
    sum.error += of_source.error;
  }
}

/// What a scene's panes let through of a beam, by their kind.
SunShadows::PaneFactor pane_factor(const Scene& scene) {
  std::vector<Glazing> glazings;
  for (const Material& material : scene.materials) {
    glazings.push_back(material.glazing.value_or(Glazing{}));
  }
  return [glazings](int kind, double cosine) {
    return glazings[static_cast<std::size_t>(kind)].at(cosine);
  };
}

Eigen::MatrixXd sun_irradiance(const Scene& scene, const PatchMesh& mesh,
                               const Progress& progress) {
  const Sun& sun = *scene.sun;
  const SunShadows shadows(mesh, sun.direction, panes_of(scene, mesh));
  Eigen::MatrixXd result =
      shadows.shares_through_panes(sun.irradiance.size(), pane_factor(scene), progress);
  for (Index i = 0; i < mesh.size(); ++i) {
    const double section = shadows.cosine(mesh.normal[i]);
    result.row(i).array() *= section * sun.irradiance.transpose().array();
  }
  return result;
}

}  // namespace

struct IncidentLight::Sources {
  struct OfSun {
    Sun sun;
    SunShadows shadows;
    SunShadows::PaneFactor panes;
  };
  std::optional<OfSun> sun;
  std::optional<SkyLight> sky;
  std::optional<LuminaireLight> luminaires;
};

bool has_incident_light(const Scene& scene) {
  return scene.sun.has_value() || scene.sky.has_value() || !scene.luminaires.empty();
}

IncidentLight::IncidentLight(const Scene& scene, const PatchMesh& mesh) {
  if (!has_incident_light(scene)) return;
  auto sources = std::make_shared<Sources>();
  if (scene.sun) {
    sources->sun.emplace(
        Sources::OfSun{*scene.sun, SunShadows(mesh, scene.sun->direction, panes_of(scene, mesh)),
                       pane_factor(scene)});
  }
  if (scene.sky) sources->sky.emplace(scene, mesh);
  if (!scene.luminaires.empty()) sources->luminaires.emplace(scene, mesh);
  sources_ = std::move(sources);
}

double IncidentLight::add(const Vec3& point, const Vec3& normal,
                          Eigen::Ref<Eigen::VectorXd> irradiance) const {
  if (!sources_) return 0;
  double error = 0;
  if (sources_->sun && sources_->sun->shadows.is_lit(point, normal)) {
    const auto& [sun, shadows, panes] = *sources_->sun;
    const Eigen::VectorXd through = shadows.factor_at(point, normal, sun.irradiance.size(), panes);
    irradiance += shadows.cosine(normal) * sun.irradiance.cwiseProduct(through);
  }
  if (sources_->sky) {
    const SkyIrradiance of_sky = sources_->sky->at(point, normal);
    irradiance += of_sky.sum();
    error += of_sky.error;
  }
  if (sources_->luminaires) error += sources_->luminaires->add(point, normal, irradiance);
  return error;
}

Eigen::VectorXd lit_shares(const PatchMesh& mesh, const Vec3& direction, const Progress& progress) {
  return SunShadows(mesh, direction).lit_shares(progress);
}

Eigen::MatrixXd incident_irradiance(const Scene& scene, const PatchMesh& mesh,
                                    const Progress& progress) {
  return incident_on_patches(scene, mesh, progress).irradiance;
}

IncidentIrradiance incident_on_patches(const Scene& scene, const PatchMesh& mesh,
                                       const Progress& progress) {
  if (!has_incident_light(scene)) return {};
  if (!scene.symmetry.is_none()) {
    throw SolveError("a sun, a sky or a luminaire does not shine on all images of a part");
  }
  IncidentIrradiance result;
  if (scene.sun) {
    add_source({sun_irradiance(scene, mesh, progress), Eigen::VectorXd::Zero(mesh.size())}, result);
  }
  if (scene.sky) {
    PatchSkyIrradiance of_sky = SkyLight(scene, mesh).on_patches(progress);
    add_source({std::move(of_sky.irradiance), std::move(of_sky.error)}, result);
  }
  if (!scene.luminaires.empty()) {
    add_source(LuminaireLight(scene, mesh).irradiance(progress), result);
  }
  return result;
}

Eigen::MatrixXd initial_radiosity(const Scene& scene, const PatchMesh& mesh,
                                  const Progress& progress) {
  return initial_radiosity(exitance(scene, mesh).cwiseAbs(), reflectance(scene, mesh),
                           incident_irradiance(scene, mesh, progress));
}

}  // namespace radiosity
