#include "radiosity/visibility/luminaire_light.h"

#include <algorithm>
#include <utility>

#include "radiosity/base/parallel.h"
#include "radiosity/scene/luminaire_flux.h"
#include "radiosity/scene/luminaire_points.h"

namespace radiosity {
namespace {

ConvexPolygon turned(const ConvexPolygon& polygon, const Eigen::Matrix3d& rotation) {
  ConvexPolygon result;
  for (const Vec3& corner : polygon) result.push_back(rotation * corner);
  return result;
}

}  // namespace

LuminaireLight::LuminaireLight(const Scene& scene, const PatchMesh& mesh)
    : mesh_(mesh), shadows_(mesh), n_bands_(scene.bands.count()) {
  for (const Photometry& photometry : scene.photometries) {
    webs_.push_back(photometry.web);
    fluxes_.emplace_back(photometry.web);
  }
  for (std::size_t k = 0; k < scene.luminaires.size(); ++k) {
    const Luminaire& luminaire = scene.luminaires[k];
    if (luminaire.dimming == 0) continue;
    const Photometry& photometry = scene.photometries[luminaire.photometry];
    const std::vector<Vec3> points = luminaire_points(luminaire, photometry);
    const double factor = web_factor(luminaire, photometry) / static_cast<double>(points.size());
    for (const Vec3& point : points) {
      sources_.push_back({{point, -luminaire.axes.col(2)},
                          luminaire.axes,
                          luminaire.photometry,
                          factor * luminaire.watts_per_lumen,
                          k});
    }
  }
}

void LuminaireLight::add(const Vec3& point, const Vec3& normal,
                         Eigen::Ref<Eigen::VectorXd> irradiance) const {
  for (const Source& source : sources_) {
    const Vec3 way = point - source.light.position;
    const double distance = way.norm();
    const double cosine = -normal.dot(way) / distance;
    if (!(distance > shadows_.thickness()) || !(cosine > 0)) continue;
    const double candela = intensity(webs_[source.photometry], source.axes.transpose() * way);
    if (candela == 0 || !shadows_.is_lit(source.light, point)) continue;
    irradiance += candela * cosine / square(distance) * source.watts_per_lumen;
  }
}

Eigen::MatrixXd LuminaireLight::irradiance(const Progress& progress) const {
  const std::size_t n = sources_.empty() ? 0 : sources_.back().luminaire + 1;
  return std::move(irradiance_of_groups(std::vector<int>(n, 0), 1, progress).front());
}

std::vector<Eigen::MatrixXd> LuminaireLight::irradiance_of_groups(const std::vector<int>& group,
                                                                  Index n_groups,
                                                                  const Progress& progress) const {
  constexpr std::ptrdiff_t kGrain = 16;
  std::vector<Eigen::MatrixXd> result(static_cast<std::size_t>(n_groups),
                                      Eigen::MatrixXd::Zero(mesh_.size(), n_bands_));
  parallel_ranges(mesh_.size(), kGrain, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    ShadowCutter cutter;
    for (std::ptrdiff_t i = begin; i < end; ++i) {
      progress.check();
      for (const Source& source : sources_) {
        double flux = 0;
        for (const ConvexPolygon& part : shadows_.lit_parts(source.light, i, cutter)) {
          const ConvexPolygon seen = turned(part, source.axes.transpose());
          flux += fluxes_[source.photometry].through(seen.points());
        }
        flux = std::max(flux, 0.);  // rounding leaves what is dark just below
        result[static_cast<std::size_t>(group[source.luminaire])].row(i) +=
            flux / mesh_.area[i] * source.watts_per_lumen.transpose();
      }
    }
  });
  return result;
}

}  // namespace radiosity
