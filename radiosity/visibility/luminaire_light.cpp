#include "radiosity/visibility/luminaire_light.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "radiosity/base/parallel.h"
#include "radiosity/scene/luminaire_flux.h"
#include "radiosity/scene/luminaire_points.h"
#include "radiosity/visibility/coverage.h"

namespace radiosity {
namespace {

/// What integrals over openings may leave: at points and on patches, of the mean, ...
constexpr double kOfMeanAtPoint = 1e-5;
constexpr double kOfMeanOnPatch = 2e-3;
/// ... and on patches of all luminaires' flux spread evenly over all of them.
constexpr double kOfEvenLight = 5e-4;
/// Patches are near within so many half diagonals of an opening.
constexpr double kNear = 5;
/// Within that of an opening's border a surface may touch it.
constexpr double kInner = 1 - 1e-6;

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
    const Photometry& photometry = scene.photometries[luminaire.photometry];
    // Undimmed, so that light stays linear in what luminaires are dimmed to.
    const double most_watts = luminaire.watts_per_lumen.maxCoeff();
    even_light_ += undimmed_flux(luminaire, photometry) * most_watts;
    if (luminaire.dimming == 0) continue;
    auto opening = luminous_opening(luminaire, photometry);
    if (opening && is_cut(*opening)) {
      cut_openings_.push_back(k);
      opening.reset();
    }
    const std::vector<Vec3> points = luminaire_points(luminaire, photometry);
    const double factor = web_factor(luminaire, photometry) / static_cast<double>(points.size());
    for (const Vec3& point : points) {
      sources_.push_back({{point, -luminaire.axes.col(2)},
                          luminaire.axes,
                          luminaire.photometry,
                          factor * luminaire.watts_per_lumen,
                          k,
                          opening,
                          factor / luminaire.dimming * most_watts});
    }
  }
  even_light_ *= kOfEvenLight / std::accumulate(mesh.area.begin(), mesh.area.end(), 0.);
}

bool LuminaireLight::is_cut(const LuminousOpening& opening) const {
  const LuminousOpening inner = [&] {
    LuminousOpening result = opening;
    result.half_u *= kInner;
    result.half_v *= kInner;
    return result;
  }();
  const double corner = opening.is_round ? std::sqrt(0.5) : 1;
  const auto is_hidden = [&](double u, double v) {
    return !shadows_.is_lit({opening.center, opening.axis}, inner.at(u, v));
  };
  for (const int sign : {-1, 1}) {
    if (is_hidden(sign, 0) || is_hidden(0, sign)) return true;
    if (is_hidden(sign * corner, corner) || is_hidden(sign * corner, -corner)) return true;
  }
  return false;
}

OpeningMean LuminaireLight::at_point(const Source& source, const Vec3& point,
                                     const Vec3& normal) const {
  const LuminousOpening opening = seen_from(*source.opening, point);
  const std::vector<ConvexPolygon> whole = polygons_of(opening, point);
  std::vector<ConvexPolygon> above;
  double area = 0;
  for (const ConvexPolygon& polygon : whole) {
    area += vector_area(polygon.points()).norm();
    const ConvexPolygon part =
        clip_to_half_space(polygon.points(), Vec3::Zero(), normal, shadows_.thickness());
    if (!part.empty()) above.push_back(part);
  }
  if (above.empty()) return {};
  thread_local ShadowCutter cutter;
  const PhotometricWeb& web = webs_[source.photometry];
  return mean_over_parts(shadows_.seen_parts(point, above, opening.axis, cutter), area,
                         kOfMeanAtPoint, [&](const Vec3& there) {
                           const double distance = there.norm();
                           const double cosine = normal.dot(there) / distance;
                           if (!(distance > shadows_.thickness()) || !(cosine > 0)) return 0.;
                           return intensity(web, source.axes.transpose() * -there) * cosine /
                                  square(distance);
                         });
}

double LuminaireLight::add(const Vec3& point, const Vec3& normal,
                           Eigen::Ref<Eigen::VectorXd> irradiance) const {
  double error = 0;
  for (const Source& source : sources_) {
    if (source.opening) {
      const OpeningMean mean = at_point(source, point, normal);
      irradiance += mean.value * source.watts_per_lumen;
      error += mean.error * source.watts_per_lumen.maxCoeff();
      continue;
    }
    const Vec3 way = point - source.light.position;
    const double distance = way.norm();
    const double cosine = -normal.dot(way) / distance;
    if (!(distance > shadows_.thickness()) || !(cosine > 0)) continue;
    const double candela = intensity(webs_[source.photometry], source.axes.transpose() * way);
    if (candela == 0 || !shadows_.is_lit(source.light, point)) continue;
    irradiance += candela * cosine / square(distance) * source.watts_per_lumen;
  }
  return error;
}

IncidentIrradiance LuminaireLight::irradiance(const Progress& progress) const {
  const std::size_t n = sources_.empty() ? 0 : sources_.back().luminaire + 1;
  return std::move(irradiance_of_groups(std::vector<int>(n, 0), 1, progress).front());
}

double LuminaireLight::flux_through(const Source& source, const Vec3& from, Index patch,
                                    ShadowCutter& cutter) const {
  double flux = 0;
  for (const ConvexPolygon& part : shadows_.lit_parts({from, source.light.axis}, patch, cutter)) {
    const ConvexPolygon seen = turned(part, source.axes.transpose());
    flux += fluxes_[source.photometry].through(seen.points());
  }
  return std::max(flux, 0.);  // rounding leaves what is dark just below
}

OpeningMean LuminaireLight::on_patch(const Source& source, Index patch,
                                     ShadowCutter& cutter) const {
  if (!source.opening) return {flux_through(source, source.light.position, patch, cutter), 0};
  const Vec3& center = mesh_.centroid[patch];
  double radius = 0;
  for (int k = 0; k < mesh_.n_corners(patch); ++k) {
    radius = std::max(radius, (mesh_.corner(patch, k) - center).norm());
  }
  const LuminousOpening opening = seen_from(*source.opening, center);
  const double size = std::hypot(opening.half_u.norm(), opening.half_v.norm());
  const double distance = (center - opening.center).norm() - radius;
  const OpeningRule rule{
      .tolerance = kOfMeanOnPatch,
      .negligible = source.undimmed > 0 ? even_light_ * mesh_.area[patch] / source.undimmed : 0,
      .is_near = distance < kNear * size};
  return mean_over_opening(
      opening, rule, [&](const Vec3& from) { return flux_through(source, from, patch, cutter); });
}

std::vector<IncidentIrradiance> LuminaireLight::irradiance_of_groups(
    const std::vector<int>& group, Index n_groups, const Progress& progress) const {
  constexpr std::ptrdiff_t kGrain = 16;
  std::vector<IncidentIrradiance> result(
      static_cast<std::size_t>(n_groups),
      {Eigen::MatrixXd::Zero(mesh_.size(), n_bands_), Eigen::VectorXd::Zero(mesh_.size())});
  const Coverage coverage = find_coverage(mesh_, shadows_.thickness());
  parallel_ranges(mesh_.size(), kGrain, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    ShadowCutter cutter;
    for (std::ptrdiff_t i = begin; i < end; ++i) {
      progress.check();
      if (coverage.is_covered(static_cast<std::int32_t>(i))) continue;
      for (const Source& source : sources_) {
        const OpeningMean flux = on_patch(source, i, cutter);
        IncidentIrradiance& sum = result[static_cast<std::size_t>(group[source.luminaire])];
        sum.irradiance.row(i) += flux.value / mesh_.area[i] * source.watts_per_lumen.transpose();
        sum.error[i] += flux.error / mesh_.area[i] * source.watts_per_lumen.maxCoeff();
      }
    }
  });
  return result;
}

}  // namespace radiosity
