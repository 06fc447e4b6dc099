#include "study/daylight_year.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include "radiosity/base/error.h"
#include "radiosity/base/machine_memory.h"
#include "radiosity/base/parallel.h"
#include "radiosity/picture/final_gather.h"
#include "radiosity/polygon/polygon_quadrature.h"
#include "radiosity/polygon/seen_polygon.h"
#include "radiosity/scene/radiometry.h"
#include "radiosity/solve/solve.h"
#include "radiosity/visibility/partial_sky.h"

namespace study {
namespace {

using namespace radiosity;

/// Points a direction of the rule on a patch.
constexpr int kPatchPoints = 2;
/// Columns that are solved together.
constexpr Index kColumnsAtOnce = 48;
/// Points of a rule on a part of the sky that has the sun in it or not: the mean of its radiance.
constexpr int kPartPoints = 4;

/// Reflectances of one band by the weights.
Eigen::MatrixXd weighted_reflectance(const Study& study, const Eigen::VectorXd& weights) {
  return reflectance(study.scene, study.mesh) * weights / weights.sum();
}

/// The part of the sky that a direction is in; the nearest middle's.
Index part_of(const SkyParts& parts, const Vec3& direction) {
  Index best = 0;
  for (Index k = 1; k < parts.size(); ++k) {
    if (parts.middles[k].dot(direction) > parts.middles[best].dot(direction)) best = k;
  }
  return best;
}

/// Mean of φ f over a part.
double mean_value(const SkyHour& hour, const Vec3& up, const ConvexPolygon& triangle) {
  double sum = 0;
  double solid_angle = 0;
  for_each_quadrature_point(triangle.points(), kPartPoints, [&](const Vec3& x, double weight) {
    const double r = x.norm();
    const double angle = weight / (r * r * r);  // but for a factor
    sum += angle * hour.distribution.value(up.dot(x) / r, hour.towards_sun.dot(x) / r);
    solid_angle += angle;
  });
  return sum / solid_angle;
}

/// The radiance of each part: of its mean, and all of them the hour's E_h.
Eigen::VectorXd radiances(const SkyHour& hour, const Vec3& up, const SkyParts& parts) {
  Eigen::VectorXd result(parts.size());
  double horizontal = 0;
  for (Index k = 0; k < parts.size(); ++k) {
    result[k] = mean_value(hour, up, parts.triangles[k]);
    horizontal += result[k] * parts.sections[k];
  }
  return horizontal > 0 ? Eigen::VectorXd(hour.diffuse / horizontal * result)
                        : Eigen::VectorXd::Zero(parts.size()).eval();
}

/// Light from each part of the sky, its radiosity, and what the gather keeps of it.
void check_memory(Index n_patches, Index n_parts) {
  const double needed =
      3. * sizeof(double) * static_cast<double>(n_patches) * static_cast<double>(n_parts + 1);
  const auto limit = static_cast<double>(memory_limit(0));
  if (needed <= limit) return;
  throw MemoryShortage(fmt::format(
      "the light of {} parts of the sky on {} patches needs {:.1f} GB beside the form factors, and "
      "{:.1f} GB can be used: fewer patches (--patches N) or parts (--sky-parts N) need less",
      n_parts, n_patches, 1e-9 * needed, 1e-9 * limit));
}

}  // namespace

SkyParts make_sky_parts(const Vec3& up, int n_parts) {
  // The least n with 4 n² >= n_parts but for one at the zenith, which triangles have none of.
  const int n = std::max(1, static_cast<int>(std::ceil(std::sqrt((n_parts - 1) / 4.) - 1e-9)));
  SkyParts parts;
  const std::vector<ConvexPolygon> cells = octants(up);
  for (std::size_t octant = 0; octant < 4; ++octant) {
    const ConvexPolygon& cell = cells[octant];
    const auto corner = [&](int i, int k) {
      return Vec3(cell[0] + (cell[1] - cell[0]) * i / n + (cell[2] - cell[0]) * k / n).normalized();
    };
    const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
      const std::array corners{a, b, c};
      parts.triangles.emplace_back(corners);
      parts.middles.push_back((a + b + c).normalized());
      parts.solid_angles.push_back(SeenPolygon(Vec3::Zero(), parts.triangles.back()).solid_angle());
      parts.sections.push_back(projected_solid_angle(parts.triangles.back(), up));
    };
    for (int i = 0; i < n; ++i) {
      for (int k = 0; i + k < n; ++k) {
        add(corner(i, k), corner(i + 1, k), corner(i, k + 1));
        if (i + k + 1 < n) add(corner(i + 1, k), corner(i + 1, k + 1), corner(i, k + 1));
      }
    }
  }
  return parts;
}

DaylightCoefficients daylight_coefficients(const Study& study,
                                           std::span<const DaylightPoint> points,
                                           const Eigen::VectorXd& weights,
                                           const YearOptions& options, const Progress& progress) {
  DaylightCoefficients result;
  result.parts = make_sky_parts(study.scene.sky->up, options.n_parts);
  const Index n_parts = result.parts.size();
  const Index n = study.mesh.size();
  check_memory(n, n_parts);
  const PartialSky partial(study.scene, study.mesh, result.parts.triangles, weights);
  Eigen::MatrixXd incident(n, n_parts + 1);
  std::mutex mutex;
  double n_done = 0;
  parallel_for(n, [&](Index i) {
    progress.check();
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(n_parts + 1);
    std::vector<Vec3> corners;
    for (int k = 0; k < study.mesh.n_corners(i); ++k) corners.push_back(study.mesh.corner(i, k));
    for_each_quadrature_point(corners, kPatchPoints, [&](const Vec3& x, double weight) {
      partial.add(x, study.mesh.normal[i], weight / study.mesh.area[i], sum);
    });
    incident.row(i) = sum.transpose();
    const std::scoped_lock lock(mutex);
    if (progress.report) {
      progress.report("sky parts", ++n_done, static_cast<double>(n), "patches");
    }
  });
  const Eigen::MatrixXd rho = weighted_reflectance(study, weights);
  Eigen::MatrixXd radiosity(n, n_parts + 1);
  for (Index first = 0; first <= n_parts; first += kColumnsAtOnce) {
    const Index k = std::min(kColumnsAtOnce, n_parts + 1 - first);
    SolveOptions solving{.tolerance = options.tolerance, .estimates_errors = false};
    solving.incident = incident.middleCols(first, k);
    solving.progress.stop = progress.stop;
    radiosity.middleCols(first, k) =
        solve(*study.transport, Eigen::MatrixXd::Zero(n, k), rho, solving).radiosity;
    if (progress.report) {
      progress.report("sky parts", static_cast<double>(first + k), static_cast<double>(n_parts + 1),
                      "solved");
    }
  }
  const auto n_points = static_cast<Index>(points.size());
  const FinalGather gather(study.mesh, radiosity);
  Eigen::MatrixXd straight(n_points, n_parts + 1);
  Eigen::MatrixXd reflected(n_points, n_parts + 1);
  parallel_for(n_points, [&](Index p) {
    progress.check();
    const DaylightPoint& point = points[static_cast<std::size_t>(p)];
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(n_parts + 1);
    partial.add(point.position, point.normal, 1, sum);
    straight.row(p) = sum.transpose();
    reflected.row(p) = gather.irradiance(std::span(&point.position, 1), point.normal).row(0);
  });
  result.straight = straight.leftCols(n_parts);
  result.reflected = reflected.leftCols(n_parts);
  result.straight_ground = straight.col(n_parts);
  result.reflected_ground = reflected.col(n_parts);
  return result;
}

Eigen::MatrixXd irradiance_in_hours(const Study& study, const DaylightCoefficients& coefficients,
                                    std::span<const DaylightPoint> points,
                                    std::span<const SkyHour> hours, const Eigen::VectorXd& weights,
                                    const Progress& progress) {
  const auto n_hours = static_cast<Index>(hours.size());
  const SkyParts& parts = coefficients.parts;
  const Vec3 up = study.scene.sky->up;
  const double ground = weights.dot(study.scene.sky->ground_reflectance) / weights.sum();
  Eigen::MatrixXd of_sky(parts.size(), n_hours);  // radiance
  Eigen::MatrixXd of_sun = Eigen::MatrixXd::Zero(parts.size(), n_hours);
  Eigen::VectorXd of_ground(n_hours);
  std::vector<Vec3> suns;
  for (const SkyHour& hour : hours) suns.push_back(hour.towards_sun);
  parallel_for(n_hours, [&](Index h) {
    progress.check();
    const SkyHour& hour = hours[static_cast<std::size_t>(h)];
    of_sky.col(h) = radiances(hour, up, parts);
    const Index there = part_of(parts, hour.towards_sun);
    of_sun(there, h) = hour.direct / parts.solid_angles[there];
    const double height = std::max(0., up.dot(hour.towards_sun));
    of_ground[h] = ground * (hour.diffuse + hour.direct * height) / kPi;
  });
  Eigen::MatrixXd result =
      (coefficients.straight + coefficients.reflected) * of_sky + coefficients.reflected * of_sun +
      (coefficients.straight_ground + coefficients.reflected_ground) * of_ground.transpose();
  const PartialSky partial(study.scene, study.mesh, parts.triangles, weights);
  parallel_for(static_cast<Index>(points.size()), [&](Index p) {
    progress.check();
    const DaylightPoint& point = points[static_cast<std::size_t>(p)];
    partial.visit_beams(point.position, point.normal, suns, [&](std::size_t h, double factor) {
      result(p, static_cast<Index>(h)) += hours[h].direct * factor;
    });
  });
  return result.transpose();
}

}  // namespace study
