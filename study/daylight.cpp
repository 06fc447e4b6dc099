#include "study/daylight.h"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>

#include "radiosity/base/error.h"
#include "radiosity/base/parallel.h"
#include "radiosity/picture/camera_view.h"
#include "radiosity/picture/final_gather.h"
#include "radiosity/scene/scenario.h"
#include "radiosity/visibility/sky_light.h"

namespace study {
namespace {

using radiosity::Index;
using radiosity::PatchMesh;
using radiosity::PointPlace;
using radiosity::Vec3;

/// Points look around from a little above their plane, of the scene's size: it may be a surface's.
constexpr double kAbovePlane = 1e-5;
/// Share of directions in which a point in a solid meets backs.
constexpr double kInSolid = 0.5;

/// Weighted radiosity of what stands outdoors, and of the rest, n x 2.
Eigen::MatrixXd split_radiosity(const Study& study, const std::vector<bool>& is_outdoors,
                                const Eigen::VectorXd& weights) {
  const Eigen::VectorXd weighted = study.solution.radiosity * weights;
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(weighted.size(), 2);
  for (Index i = 0; i < weighted.size(); ++i) {
    result(i, is_outdoors[static_cast<std::size_t>(study.mesh.surface[i])] ? 0 : 1) = weighted[i];
  }
  return result;
}

}  // namespace

radiosity::Scene daylight_scene(radiosity::Scene scene) {
  if (!scene.sky) {
    throw radiosity::SceneError(scene.source + ": there is no daylight without a \"sky\"");
  }
  if (scene.sky->zenith_radiance.isZero(0)) {
    throw radiosity::SceneError(scene.source + ": the sky is dark, so that it has no shares");
  }
  scene.sun.reset();
  scene.luminaires.clear();
  for (radiosity::Surface& surface : scene.surfaces) surface.emission_factor = 0;
  return scene;
}

std::vector<bool> outdoor_surfaces(const std::vector<std::string>& surface_names,
                                   const std::vector<std::string>& patterns) {
  std::vector<bool> result(surface_names.size(), false);
  for (const std::string& pattern : patterns) {
    bool any = false;
    for (std::size_t s = 0; s < result.size(); ++s) {
      if (!radiosity::matches(pattern, surface_names[s])) continue;
      result[s] = true;
      any = true;
    }
    if (!any) {
      throw radiosity::SceneError(fmt::format("'{}' is the name of no surface", pattern));
    }
  }
  return result;
}

std::vector<DaylightFactor> daylight_factors(const Study& study,
                                             std::span<const DaylightPoint> points,
                                             const std::vector<std::string>& outdoors,
                                             const Eigen::VectorXd& weights,
                                             const radiosity::Progress& progress) {
  const radiosity::SkyLight light(study.scene, study.mesh);
  const Eigen::VectorXd horizontal = radiosity::horizontal_irradiance(*study.scene.sky);
  const double whole = weights.dot(horizontal);
  const radiosity::FinalGather gather(
      study.mesh,
      split_radiosity(study, outdoor_surfaces(study.mesh.surface_names, outdoors), weights));
  std::vector<DaylightFactor> result(points.size());
  std::mutex mutex;
  double n_done = 0;
  radiosity::parallel_for(static_cast<std::ptrdiff_t>(points.size()), [&](std::ptrdiff_t k) {
    progress.check();
    const DaylightPoint& point = points[static_cast<std::size_t>(k)];
    const radiosity::SkyIrradiance straight = light.at(point.position, point.normal);
    const Eigen::MatrixXd reflected =
        gather.irradiance(std::span(&point.position, 1), point.normal);
    result[static_cast<std::size_t>(k)] = {
        .sky = weights.dot(straight.sky) / whole,
        .external = (weights.dot(straight.ground) + reflected(0, 0)) / whole,
        .internal = reflected(0, 1) / whole,
        .error = straight.error / horizontal.maxCoeff()};
    const std::scoped_lock lock(mutex);
    ++n_done;
    if (progress.report) {
      progress.report("points", n_done, static_cast<double>(points.size()), "");
    }
  });
  return result;
}

std::vector<PointPlace> daylight_places(const Study& study, std::span<const DaylightPoint> points) {
  const double size = radiosity::bounds(study.mesh).diagonal().norm();
  std::vector<PointPlace> result;
  for (const DaylightPoint& point : points) {
    const Vec3 above = point.position + kAbovePlane * size * point.normal;
    const bool is_inside = radiosity::surroundings(study.visibility, above).backs > kInSolid;
    result.push_back(is_inside ? PointPlace::inside : PointPlace::open);
  }
  return result;
}

}  // namespace study
