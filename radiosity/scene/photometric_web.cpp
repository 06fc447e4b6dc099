#include "radiosity/scene/photometric_web.h"

#include <algorithm>
#include <cmath>

namespace radiosity {
namespace {

/// Angles may be off by rounding where they are compared with those at the border, radian.
constexpr double kAngleRounding = 1e-12;

/// Mean over azimuth of what the columns have, times the angle that they span.
template <typename Row>
double over_azimuth(const std::vector<double>& azimuth, const Row& values) {
  if (azimuth.size() == 1) return 2 * kPi * values[0];
  double sum = 0;
  for (std::size_t j = 1; j < azimuth.size(); ++j) {
    const auto column = static_cast<Index>(j);
    sum += 0.5 * (azimuth[j] - azimuth[j - 1]) * (values[column - 1] + values[column]);
  }
  return sum;
}

}  // namespace

PolarAxes polar_axes(PhotometricWeb::Type type) {
  switch (type) {
    case PhotometricWeb::Type::b:
      return {-Vec3::UnitX(), -Vec3::UnitZ(), Vec3::UnitY()};
    case PhotometricWeb::Type::a:
      return {-Vec3::UnitY(), -Vec3::UnitZ(), Vec3::UnitX()};
    case PhotometricWeb::Type::c:
      break;
  }
  return {-Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY()};
}

std::array<double, 2> polar_weights(double from, double to) {
  constexpr double kSmall = 0.1;
  const double middle = 0.5 * (from + to);
  const double half = 0.5 * (to - from);
  const double h2 = half * half;
  // cos h - sin h / h, which cancels
  const double even = half < kSmall ? -h2 / 3 * (1 - h2 / 10 * (1 - h2 / 28 * (1 - h2 / 54)))
                                    : std::cos(half) - std::sin(half) / half;
  const double odd = std::sin(half) * std::sin(middle);
  return {odd + even * std::cos(middle), odd - even * std::cos(middle)};
}

Interval interval_of(const std::vector<double>& increasing, double x) {
  const auto after = std::upper_bound(increasing.begin() + 1, increasing.end() - 1, x);
  const Index k = after - increasing.begin() - 1;
  const auto i = static_cast<std::size_t>(k);
  const double share = (x - increasing[i]) / (increasing[i + 1] - increasing[i]);
  return {k, std::clamp(share, 0.0, 1.0)};
}

double turned_into(const std::vector<double>& azimuth, double x) {
  x += 2 * kPi * std::ceil((azimuth.front() - kAngleRounding - x) / (2 * kPi));
  return x;
}

double intensity(const PhotometricWeb& web, const Vec3& direction) {
  const PolarAxes axes = polar_axes(web.type);
  const double x = direction.dot(axes.zero);
  const double y = direction.dot(axes.quarter);
  const double polar = std::atan2(std::hypot(x, y), direction.dot(axes.pole));
  if (polar < web.polar.front() - kAngleRounding || polar > web.polar.back() + kAngleRounding) {
    return 0;
  }
  const Interval row = interval_of(web.polar, polar);
  const auto at = [&](Index column) {
    return (1 - row.share) * web.intensity(row.k, column) +
           row.share * web.intensity(row.k + 1, column);
  };
  if (web.azimuth.size() == 1) return at(0);
  const double azimuth = turned_into(web.azimuth, std::atan2(y, x));
  if (azimuth > web.azimuth.back() + kAngleRounding) return 0;
  const Interval column = interval_of(web.azimuth, azimuth);
  return (1 - column.share) * at(column.k) + column.share * at(column.k + 1);
}

double flux(const PhotometricWeb& web) {
  double sum = 0;
  for (std::size_t i = 1; i < web.polar.size(); ++i) {
    const auto weights = polar_weights(web.polar[i - 1], web.polar[i]);
    const auto row = static_cast<Index>(i);
    sum += weights[0] * over_azimuth(web.azimuth, web.intensity.row(row - 1)) +
           weights[1] * over_azimuth(web.azimuth, web.intensity.row(row));
  }
  return sum;
}

double downward_flux(const PhotometricWeb& web) {
  PhotometricWeb lower = web;
  const double horizon = kPi / 2;
  if (web.polar.front() >= horizon) return 0;
  if (web.polar.back() <= horizon) return flux(web);
  const Interval last = interval_of(web.polar, horizon);
  const Index n = last.k + 2;
  lower.polar.resize(static_cast<std::size_t>(n));
  lower.polar.back() = horizon;
  lower.intensity.conservativeResize(n, Eigen::NoChange);
  lower.intensity.row(n - 1) =
      (1 - last.share) * web.intensity.row(n - 2) + last.share * web.intensity.row(n - 1);
  if (!(lower.polar[static_cast<std::size_t>(n - 2)] < horizon)) {
    lower.polar.pop_back();
    lower.intensity.conservativeResize(n - 1, Eigen::NoChange);
  }
  return lower.polar.size() > 1 ? flux(lower) : 0;
}

}  // namespace radiosity
