#include "viewer/desk/luminaire_shape.h"

#include <cmath>

namespace viewer {
namespace {

using radiosity::kPi;
using radiosity::Luminaire;
using radiosity::Photometry;
using radiosity::Vec3;
using Curve = LuminaireShape::Curve;

constexpr int kCurveSteps = 72;  // 5 degrees each
constexpr int kMeridians = 12;
constexpr int kParallels = 12;
constexpr int kRimSteps = 32;

/// γ from straight down and C about it, in the luminaire's frame.
Vec3 direction_of(double gamma, double c) {
  return {std::sin(gamma) * std::cos(c), std::sin(gamma) * std::sin(c), -std::cos(gamma)};
}

Curve opening_of(const Luminaire& luminaire, const Photometry& photometry) {
  const double along = photometry.along_c0 / 2;
  const double across = photometry.along_c90 / 2;
  Curve curve;
  if (!(along > 0) && !(across > 0)) return curve;
  const auto add = [&](double x, double y) {
    curve.push_back(luminaire.position + luminaire.axes * Vec3(along * x, across * y, 0));
  };
  if (photometry.is_round) {
    for (int k = 0; k <= kRimSteps; ++k) {
      add(std::cos(2 * kPi * k / kRimSteps), std::sin(2 * kPi * k / kRimSteps));
    }
  } else {
    for (const auto& [x, y] : {std::pair(1, 1), {-1, 1}, {-1, -1}, {1, -1}, {1, 1}}) add(x, y);
  }
  return curve;
}

}  // namespace

LuminaireShape luminaire_shape(const Luminaire& luminaire, const Photometry& photometry,
                               double size, LuminaireDetail detail) {
  const double peak = radiosity::peak_intensity(photometry.web).intensity;
  const double scale = peak > 0 ? size / peak : 0;
  const auto place = [&](double gamma, double c) -> Vec3 {
    const Vec3 direction = direction_of(gamma, c);
    const double length = scale * radiosity::intensity(photometry.web, direction);
    return luminaire.position + length * (luminaire.axes * direction);
  };
  LuminaireShape shape;
  shape.opening = opening_of(luminaire, photometry);
  shape.aim = {luminaire.position, luminaire.position - size * luminaire.axes.col(2)};
  for (int plane = 0; plane < 2; ++plane) {
    for (int k = 0; k <= kCurveSteps; ++k) {
      shape.planes[plane].push_back(place(2 * kPi * k / kCurveSteps, plane * kPi / 2));
    }
  }
  if (detail == LuminaireDetail::curves) return shape;
  for (int m = 0; m < kMeridians; ++m) {
    Curve& meridian = shape.solid.emplace_back();
    for (int k = 0; k <= kCurveSteps / 2; ++k) {
      meridian.push_back(place(2 * kPi * k / kCurveSteps, 2 * kPi * m / kMeridians));
    }
  }
  for (int p = 1; p < kParallels; ++p) {
    Curve& parallel = shape.solid.emplace_back();
    for (int k = 0; k <= kCurveSteps; ++k) {
      parallel.push_back(place(kPi * p / kParallels, 2 * kPi * k / kCurveSteps));
    }
  }
  return shape;
}

}  // namespace viewer
