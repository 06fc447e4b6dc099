#include "radiosity/meter/luminaire_glare.h"

#include <algorithm>
#include <cmath>

#include "radiosity/scene/luminaire_flux.h"
#include "radiosity/scene/luminaire_points.h"
#include "radiosity/scene/photometric_web.h"

namespace radiosity {
namespace {

/// Points along each side of an opening that tell how much of it is seen.
constexpr int kGlarePoints = 5;

/// cd of a luminaire for each one of its file's.
double candela_factor(const Luminaire& luminaire, const Photometry& photometry,
                      const Eigen::VectorXd& weights) {
  return web_factor(luminaire, photometry) * weights.dot(luminaire.watts_per_lumen);
}

bool has_opening(const Photometry& photometry) {
  return photometry.along_c0 > 0 && photometry.along_c90 > 0;
}

}  // namespace

double projected_opening(const Photometry& photometry, const Vec3& direction) {
  const double a = photometry.along_c0;
  const double b = photometry.along_c90;
  const Vec3 u = direction.cwiseAbs();
  if (photometry.is_round) {
    return kPi / 4 * a * b * u.z() + photometry.height * std::hypot(a * u.y(), b * u.x());
  }
  return a * b * u.z() + photometry.height * (a * u.y() + b * u.x());
}

LuminaireGlare::LuminaireGlare(const Scene& scene, const PatchMesh& mesh,
                               const Eigen::VectorXd& weights)
    : scene_(scene), shadows_(mesh), weights_(weights) {}

std::vector<GlareSource> LuminaireGlare::sources(const Observer& observer) const {
  std::vector<GlareSource> result;
  for (const Luminaire& luminaire : scene_.luminaires) {
    const Photometry& photometry =
        scene_.photometries[static_cast<std::size_t>(luminaire.photometry)];
    const Vec3 way = luminaire.position - observer.position;
    const double distance = way.norm();
    if (!has_opening(photometry) || !(way.dot(observer.direction) > 0)) continue;
    const Vec3 to_eye = luminaire.axes.transpose() * -way / distance;
    const double area = projected_opening(photometry, to_eye);
    const double candela =
        candela_factor(luminaire, photometry, weights_) * intensity(photometry.web, to_eye);
    if (!(candela > 0 && area > 0)) continue;
    const std::vector<Vec3> points = luminaire_points(luminaire, photometry, kGlarePoints);
    const auto n_seen = std::count_if(points.begin(), points.end(), [&](const Vec3& point) {
      return shadows_.is_lit({point, -luminaire.axes.col(2)}, observer.position);
    });
    if (n_seen == 0) continue;
    const double share = static_cast<double>(n_seen) / static_cast<double>(points.size());
    result.push_back({.surface = luminaire.name,
                      .luminance = candela / area,
                      .solid_angle = share * area / square(distance),
                      .direction = way / distance,
                      .position = position_index(way, observer.direction, observer.up)});
  }
  return result;
}

Index LuminaireGlare::n_without_opening() const {
  return std::count_if(
      scene_.luminaires.begin(), scene_.luminaires.end(), [&](const Luminaire& luminaire) {
        return luminaire.dimming > 0 &&
               !has_opening(scene_.photometries[static_cast<std::size_t>(luminaire.photometry)]);
      });
}

}  // namespace radiosity
