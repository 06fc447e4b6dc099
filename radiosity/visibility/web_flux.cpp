#include "radiosity/visibility/web_flux.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "radiosity/polygon/gauss.h"

namespace radiosity {
namespace {

/// Sine of the angle between an edge's plane and the pole below which the edge is a meridian, along
/// which the azimuth does not change.
constexpr double kMeridian = 1e-15;
/// Pieces next to where an arc is nearest to the pole are as long as it is distant there, and each
/// further one three times as long: the integrand's branch points stay two half-lengths away from
/// each, so that 8 points are right to 4^-16.
constexpr double kGrading = 3;
constexpr double kLongestPiece = 0.6;
constexpr int kOrder = 8;
/// So much shorter than the distance to the pole 4 points are as good.
constexpr double kShortPiece = 0.2;
constexpr int kLowOrder = 4;

}  // namespace

/// A great circle's arc: d(t) = cos t start + sin t ahead, 0 <= t <= length < π.
struct WebFlux::Arc {
  Vec3 start;
  Vec3 ahead;
  double length;
  double turning;   ///< sin²θ dφ/dt, constant
  double distance;  ///< least angle to the pole on the great circle, or to the opposite one
  double nearest;   ///< where that is
  [[nodiscard]] Vec3 at(double t) const { return std::cos(t) * start + std::sin(t) * ahead; }
};

double WebFlux::Table::below_polar(double polar_angle, Index column) const {
  if (polar_angle <= polar.front()) return 0;
  if (polar_angle >= polar.back()) return below(below.rows() - 1, column);
  const Interval row = interval_of(polar, polar_angle);
  const double first = intensity(row.k, column);
  const double last = first + row.share * (intensity(row.k + 1, column) - first);
  const auto weights = polar_weights(polar[static_cast<std::size_t>(row.k)], polar_angle);
  return below(row.k, column) + weights[0] * first + weights[1] * last;
}

double WebFlux::Table::integral(double polar_angle, double azimuth_angle) const {
  if (azimuth.size() == 1) return below_polar(polar_angle, 0);
  const double turned = turned_into(azimuth, azimuth_angle);
  if (turned > azimuth.back()) return 0;
  const Interval column = interval_of(azimuth, turned);
  return (1 - column.share) * below_polar(polar_angle, column.k) +
         column.share * below_polar(polar_angle, column.k + 1);
}

WebFlux::Table WebFlux::make_table(const PhotometricWeb& web, bool is_turned) {
  Table table{polar_axes(web.type), 1, web.polar, web.azimuth, web.intensity, {}};
  if (is_turned) {
    table.axes.pole = -table.axes.pole;
    std::reverse(table.polar.begin(), table.polar.end());
    for (double& angle : table.polar) angle = kPi - angle;
    table.intensity = web.intensity.colwise().reverse();
  }
  table.sense = -table.axes.zero.cross(table.axes.quarter).dot(table.axes.pole);
  table.below = Eigen::MatrixXd::Zero(table.intensity.rows(), table.intensity.cols());
  for (Index i = 1; i < table.below.rows(); ++i) {
    const auto weights = polar_weights(table.polar[static_cast<std::size_t>(i - 1)],
                                       table.polar[static_cast<std::size_t>(i)]);
    table.below.row(i) = table.below.row(i - 1) + weights[0] * table.intensity.row(i - 1) +
                         weights[1] * table.intensity.row(i);
  }
  return table;
}

WebFlux::WebFlux(const PhotometricWeb& web)
    : near_pole_(make_table(web, false)), far_pole_(make_table(web, true)) {}

/// Where the arc has to be divided, in order, with both ends.
void WebFlux::divide(const Table& table, const Arc& arc, std::vector<double>& places) {
  places.assign({0, arc.length});
  const auto add = [&](double t) {
    if (t > 0 && t < arc.length) places.push_back(t);
  };
  const auto add_turned = [&](double t) {
    for (const double turn : {-2 * kPi, 0.0, 2 * kPi}) add(t + turn);
  };
  for (const double center : {arc.nearest - kPi, arc.nearest, arc.nearest + kPi}) {
    add(center);
    for (double step = std::max(arc.distance, kMeridian); step < 2 * kPi; step *= kGrading) {
      add(center - step);
      add(center + step);
    }
  }
  // Circles of the grid.
  const Vec3& pole = table.axes.pole;
  const double high = std::hypot(arc.start.dot(pole), arc.ahead.dot(pole));
  const auto polar_at = [&](double t) {
    return std::acos(std::clamp(arc.at(t).dot(pole), -1., 1.));
  };
  double least = std::min(polar_at(0), polar_at(arc.length));
  double most = std::max(polar_at(0), polar_at(arc.length));
  if (arc.nearest > 0 && arc.nearest < arc.length) least = 0;
  for (const double furthest : {arc.nearest - kPi, arc.nearest + kPi}) {
    if (furthest > 0 && furthest < arc.length) most = kPi;
  }
  const auto begin = std::lower_bound(table.polar.begin(), table.polar.end(), least);
  const auto end = std::upper_bound(begin, table.polar.end(), most);
  for (auto angle = begin; angle != end; ++angle) {
    const double cosine = std::cos(*angle);
    if (!(std::abs(cosine) < high)) continue;
    const double away = std::acos(cosine / high);
    add_turned(arc.nearest - away);
    add_turned(arc.nearest + away);
  }
  // Half-planes of the grid.
  if (table.azimuth.size() > 1) {
    const auto azimuth_at = [&](double t) {
      const Vec3 d = arc.at(t);
      return std::atan2(d.dot(table.axes.quarter), d.dot(table.axes.zero));
    };
    double from = azimuth_at(0);
    double to = azimuth_at(arc.length);
    if (arc.turning < 0) std::swap(from, to);
    if (to < from) to += 2 * kPi;
    for (const double turn : {-4 * kPi, -2 * kPi, 0.0, 2 * kPi}) {
      const auto first = std::lower_bound(table.azimuth.begin(), table.azimuth.end(), from + turn);
      const auto last = std::upper_bound(first, table.azimuth.end(), to + turn);
      for (auto angle = first; angle != last; ++angle) {
        const Vec3 across =
            std::cos(*angle) * table.axes.quarter - std::sin(*angle) * table.axes.zero;
        const double t = std::atan2(-arc.start.dot(across), arc.ahead.dot(across));
        add(t);
        add(t + kPi);
      }
    }
  }
  std::sort(places.begin(), places.end());
}

/// ∫ J dφ along the edge.
double WebFlux::along(const Table& table, const Vec3& from, const Vec3& to) {
  const Vec3 start = from.normalized();
  const Vec3 normal = start.cross(to);
  const double sine = normal.norm();
  if (!(sine > 0)) return 0;
  Arc arc;
  arc.start = start;
  arc.ahead = (normal / sine).cross(start);
  arc.length = std::atan2(sine, start.dot(to));
  const Vec3 axis = table.axes.zero.cross(table.axes.quarter);
  arc.turning = normal.dot(axis) / sine;
  if (!(std::abs(arc.turning) > kMeridian)) return 0;
  const double x = arc.start.dot(table.axes.pole);
  const double y = arc.ahead.dot(table.axes.pole);
  arc.nearest = std::atan2(y, x);
  arc.distance = std::atan2(std::abs(arc.turning), std::hypot(x, y));
  thread_local std::vector<double> places;
  divide(table, arc, places);
  double sum = 0;
  for (std::size_t k = 1; k < places.size(); ++k) {
    const double whole = places[k] - places[k - 1];
    const int n_pieces = std::max(1, static_cast<int>(std::ceil(whole / kLongestPiece)));
    const double length = whole / n_pieces;
    const int order = length < kShortPiece * arc.distance ? kLowOrder : kOrder;
    for (int piece = 0; piece < n_pieces; ++piece) {
      for (const GaussPoint& point : gauss_rule(order)) {
        const Vec3 d = arc.at(places[k - 1] + (piece + point.x) * length);
        const double u = d.dot(table.axes.zero);
        const double v = d.dot(table.axes.quarter);
        const double square_sine = u * u + v * v;
        const double polar = std::atan2(std::sqrt(square_sine), d.dot(table.axes.pole));
        sum += point.weight * length * table.integral(polar, std::atan2(v, u)) / square_sine;
      }
    }
  }
  return arc.turning * sum;
}

double WebFlux::through(std::span<const Vec3> polygon) const {
  const bool is_near = near_pole_.axes.pole.dot(vector_area(polygon)) <= 0;
  const Table& table = is_near ? near_pole_ : far_pole_;
  double sum = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    sum += along(table, polygon[k], polygon[k + 1 < polygon.size() ? k + 1 : 0]);
  }
  return table.sense * sum;
}

}  // namespace radiosity
