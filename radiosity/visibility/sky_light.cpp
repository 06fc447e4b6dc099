#include "radiosity/visibility/sky_light.h"

#include <algorithm>
#include <cmath>

#include "radiosity/base/parallel.h"
#include "radiosity/polygon/polygon_quadrature.h"
#include "radiosity/scene/radiometry.h"

namespace radiosity {
namespace {

/// Of what an open sky gives: what quadrature over it may leave.
constexpr double kOfOpenSky = 1e-6;
constexpr double kOfHorizontal = 1e-8;
/// Means over patches: what two rules may differ by, of the mean and of E_h, ...
constexpr double kOfMean = 1e-3;
constexpr double kOfOutdoors = 1e-5;
/// ... their points a direction, and how often a patch is divided in four.
constexpr int kCoarsePoints = 2;
constexpr int kFinePoints = 3;
constexpr int kMostDivisions = 2;

bool is_below_horizon(const ConvexPolygon& part, const Vec3& up) {
  double sum = 0;
  for (const Vec3& corner : part) sum += up.dot(corner.normalized());
  return sum < 0;
}

std::vector<Glazing> glazings(const Scene& scene) {
  std::vector<Glazing> result;
  for (const Material& material : scene.materials) {
    result.push_back(material.glazing.value_or(Glazing{}));
  }
  return result;
}

bool is_alike(const Eigen::VectorXd& values) { return (values.array() == values[0]).all(); }

}  // namespace

double horizontal_ratio(const Sky& sky) {
  const double at_zenith = sky.value_at_zenith();
  const std::vector<ConvexPolygon> cells = octants(sky.up);
  const auto value = [&](const Vec3& direction) {
    const double cosine = sky.up.dot(direction);
    return sky.distribution.value(cosine, sky.towards_sun.dot(direction)) / at_zenith * cosine;
  };
  double sum = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    sum += spherical_integral(cells[k].points(), kOfHorizontal, value).value;
  }
  return sum;
}

Eigen::VectorXd horizontal_irradiance(const Sky& sky) {
  return horizontal_ratio(sky) * sky.zenith_radiance;
}

Eigen::VectorXd ground_radiance(const Sky& sky, const std::optional<Sun>& sun) {
  Eigen::VectorXd total = horizontal_irradiance(sky);
  if (sun) total += std::max(0., -sky.up.dot(sun->direction)) * sun->irradiance;
  return sky.ground_reflectance.cwiseProduct(total) / kPi;
}

SkyLight::SkyLight(const Scene& scene, const PatchMesh& mesh)
    : mesh_(mesh),
      sky_(*scene.sky),
      value_at_zenith_(sky_.value_at_zenith()),
      horizontal_(horizontal_ratio(sky_)),
      ground_(ground_radiance(sky_, scene.sun)),
      glazings_(glazings(scene)),
      cells_(octants(sky_.up)),
      visible_(mesh, panes_of(scene, mesh)) {}

double SkyLight::shared_factor(std::span<const VisibleSky::Pane> panes, const Vec3& direction,
                               Index band) const {
  double factor = 1;
  for (const VisibleSky::Pane& pane : panes) {
    factor *= glazings_[pane.kind].at(pane.normal.dot(direction), band);
  }
  return factor;
}

void SkyLight::add_part(const ConvexPolygon& part, std::span<const VisibleSky::Pane> panes,
                        const Vec3& normal, SkyIrradiance& sum) const {
  const bool is_ground = is_below_horizon(part, sky_.up);
  const Eigen::VectorXd& radiance = is_ground ? ground_ : sky_.zenith_radiance;
  if (radiance.isZero(0)) return;
  Eigen::VectorXd& result = is_ground ? sum.ground : sum.sky;
  const bool is_even = is_ground || sky_.distribution.is_uniform();
  if (is_even && panes.empty()) {
    result += projected_solid_angle(part, normal) * radiance;
    return;
  }
  // One integral for all bands, unless a pane lets them through differently.
  const bool is_grey = std::all_of(panes.begin(), panes.end(), [&](const auto& pane) {
    return is_alike(glazings_[pane.kind].transmittance);
  });
  const Index n = is_grey ? 1 : radiance.size();
  const double allowed = kOfOpenSky * (is_ground ? 1 : horizontal_ / kPi);
  double error = 0;
  for (Index band = 0; band < n; ++band) {
    const auto value = [&](const Vec3& direction) {
      const double luminance = is_even ? 1
                                       : sky_.distribution.value(sky_.up.dot(direction),
                                                                 sky_.towards_sun.dot(direction)) /
                                             value_at_zenith_;
      return luminance * normal.dot(direction) * shared_factor(panes, direction, band);
    };
    SphericalIntegral integral = spherical_integral(part.points(), allowed, value);
    integral.value =
        std::max(0., integral.value);  // a cosine on the horizon may be below by rounding
    if (is_grey) {
      result += integral.value * radiance;
      error = integral.error * radiance.maxCoeff();
    } else {
      result[band] += integral.value * radiance[band];
      error = std::max(error, integral.error * radiance[band]);
    }
  }
  sum.error += error;
}

SkyIrradiance SkyLight::at(const Vec3& point, const Vec3& normal) const {
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(sky_.zenith_radiance.size());
  SkyIrradiance sum{none, none, 0};
  visible_.visit(point, normal, cells_, [&](const ConvexPolygon& part, auto panes) {
    add_part(part, panes, normal, sum);
  });
  return sum;
}

/// Of a patch or of a part of it.
struct SkyLight::Mean {
  Eigen::VectorXd irradiance;
  double error;
};

SkyLight::Mean SkyLight::mean_on(Index patch) const {
  const Vec3& normal = mesh_.normal[patch];
  const auto integral = [&](const ConvexPolygon& polygon, int n_points) {
    Mean sum{Eigen::VectorXd::Zero(sky_.zenith_radiance.size()), 0};
    for_each_quadrature_point(polygon.points(), n_points, [&](const Vec3& x, double weight) {
      const SkyIrradiance there = at(x, normal);
      sum.irradiance += weight * there.sum();
      sum.error += weight * there.error;
    });
    return sum;
  };
  const double outdoors = kOfOutdoors * horizontal_ * sky_.zenith_radiance.maxCoeff();
  const std::function<Mean(const ConvexPolygon&, int)> refine = [&](const ConvexPolygon& polygon,
                                                                    int divisions) {
    const Mean coarse = integral(polygon, kCoarsePoints);
    Mean fine = integral(polygon, kFinePoints);
    const double change = (fine.irradiance - coarse.irradiance).cwiseAbs().maxCoeff();
    const double area = vector_area(polygon.points()).norm();
    const bool is_done = change <= std::max(kOfMean * fine.irradiance.maxCoeff(), outdoors * area);
    if (is_done || divisions == kMostDivisions) {
      fine.error += change;
      return fine;
    }
    Mean sum{Eigen::VectorXd::Zero(sky_.zenith_radiance.size()), 0};
    for (const ConvexPolygon& part : divide_about_corners(polygon)) {
      const Mean there = refine(part, divisions + 1);
      sum.irradiance += there.irradiance;
      sum.error += there.error;
    }
    return sum;
  };
  ConvexPolygon polygon;
  for (int k = 0; k < mesh_.n_corners(patch); ++k) polygon.push_back(mesh_.corner(patch, k));
  Mean result = refine(polygon, 0);
  result.irradiance /= mesh_.area[patch];
  result.error /= mesh_.area[patch];
  return result;
}

PatchSkyIrradiance SkyLight::on_patches(const Progress& progress) const {
  PatchSkyIrradiance result{Eigen::MatrixXd(mesh_.size(), sky_.zenith_radiance.size()),
                            Eigen::VectorXd(mesh_.size())};
  constexpr std::ptrdiff_t kGrain = 8;
  parallel_ranges(mesh_.size(), kGrain, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
    for (std::ptrdiff_t i = begin; i < end; ++i) {
      progress.check();
      const Mean mean = mean_on(i);
      result.irradiance.row(i) = mean.irradiance.transpose();
      result.error[i] = mean.error;
    }
  });
  return result;
}

}  // namespace radiosity
