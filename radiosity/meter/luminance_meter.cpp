#include "radiosity/meter/luminance_meter.h"

#include <mutex>

#include "radiosity/base/error.h"
#include "radiosity/base/parallel.h"

namespace radiosity {
namespace {

/// W/m², n_patches x (kLightParts x n_bands for each light).
Eigen::MatrixXd light_by_bands(const PatchMesh& mesh, std::span<const Lighting> lights) {
  const Index n_bands = lights.front().solution.radiosity.cols();
  Eigen::MatrixXd result =
      Eigen::MatrixXd::Zero(mesh.size(), kLightParts * n_bands * static_cast<Index>(lights.size()));
  Index first = 0;
  for (const Lighting& light : lights) {
    const Solution& solution = light.solution;
    result.middleCols(first, n_bands) = solution.exitance;
    result.middleCols(first + n_bands, n_bands) = solution.radiosity - solution.exitance;
    if (solution.radiosity_error.size() > 0) {
      result.middleCols(first + 2 * n_bands, n_bands) = solution.radiosity_error;
    }
    first += kLightParts * n_bands;
  }
  return result;
}

}  // namespace

LuminanceMeter::LuminanceMeter(const PatchMesh& mesh, const Visibility& visibility,
                               std::span<const Lighting> lights, const Eigen::VectorXd& weights)
    : mesh_(mesh),
      visibility_(visibility),
      weights_(weights),
      gather_(mesh, light_by_bands(mesh, lights)) {
  for (const Lighting& light : lights) {
    lights_.push_back({light.solution.exitance * weights.asDiagonal(),
                       light.solution.reflectance * weights.asDiagonal(),
                       IncidentLight(light.scene, mesh)});
  }
}

Eigen::RowVectorXd LuminanceMeter::seen(const Vec3& eye, const Vec3& point) const {
  Eigen::RowVectorXd result =
      Eigen::RowVectorXd::Zero(kLightParts * static_cast<Index>(lights_.size()));
  const Vec3 way = (point - eye).normalized();
  const auto hit = visibility_.first_hit(eye, way);
  if (!hit || !hit->front) return result;
  const SurfacePoint place = gather_.settled({hit->patch, eye + hit->distance * way});
  const Index patch = hit->patch % mesh_.size();
  const Eigen::RowVectorXd gathered = gather_.irradiance(std::span(&place, 1));
  const Index n_bands = weights_.size();
  for (std::size_t k = 0; k < lights_.size(); ++k) {
    const Light& light = lights_[k];
    const Eigen::RowVectorXd reflected = light.reflectance.row(patch) / kPi;
    const auto parts =
        gathered.segment(kLightParts * n_bands * static_cast<Index>(k), kLightParts * n_bands);
    Eigen::VectorXd incident = Eigen::VectorXd::Zero(n_bands);
    const double error = light.incident.add(place.position, mesh_.normal[patch], incident);
    const Eigen::VectorXd direct = parts.head(n_bands).transpose() + incident;
    auto sum = result.segment<kLightParts>(kLightParts * static_cast<Index>(k));
    sum[0] = light.exitance.row(patch).sum() / kPi + reflected.dot(direct);
    sum[1] = reflected.dot(parts.segment(n_bands, n_bands));
    sum[2] = reflected.dot(parts.tail(n_bands)) + error * reflected.sum();
  }
  return result;
}

std::vector<GridQuantity> measure_luminance(const GridPlan& plan, const GridLight& light,
                                            const LuminanceMeter& meter, const Progress& progress) {
  std::vector<GridQuantity> result;
  std::mutex mutex;
  const auto n_all = static_cast<double>(plan.luminance_from.size() * light.where.points.size());
  double n_done = 0;
  for (const Vec3& eye : plan.luminance_from) {
    for (const Vec3& point : light.where.points) {
      if (point != eye) continue;
      throw SceneError("grid \"" + plan.name + "\": the eye of a luminance is one of its points");
    }
    GridQuantity& quantity = result.emplace_back();
    quantity.name = quantity_name("luminance", eye);
    quantity.unit = "cd/m²";
    quantity.values =
        Eigen::MatrixXd::Zero(light.where.size(), light.quantities.front().values.cols());
    parallel_for(light.where.size(), [&](Index k) {
      progress.check();
      const auto i = static_cast<std::size_t>(k);
      if (light.places[i] == PointPlace::open) {
        quantity.values.row(k) = meter.seen(eye, light.where.points[i]);
      }
      const std::scoped_lock lock(mutex);
      ++n_done;
      if (progress.report) progress.report("luminances", n_done, n_all, "points");
    });
  }
  return result;
}

}  // namespace radiosity
