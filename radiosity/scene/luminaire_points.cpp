#include "radiosity/scene/luminaire_points.h"

#include <cmath>

namespace radiosity {
namespace {

/// The point of the unit disc for one of the square [-1, 1]², equal areas to equal areas. (Shirley
/// & Chiu 1997)
Eigen::Vector2d on_disc(const Eigen::Vector2d& square_point) {
  const double a = square_point.x();
  const double b = square_point.y();
  if (a == 0 && b == 0) return {0, 0};
  const bool is_wide = std::abs(a) > std::abs(b);
  const double radius = is_wide ? a : b;
  const double angle = is_wide ? kPi / 4 * b / a : kPi / 2 - kPi / 4 * a / b;
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

}  // namespace

std::vector<Vec3> luminaire_points(const Luminaire& luminaire, const Photometry& photometry,
                                   int automatic) {
  const Vec3 half(0.5 * photometry.along_c0, 0.5 * photometry.along_c90, 0);
  auto [n_c0, n_c90] = luminaire.divisions;
  if (n_c0 == 0) n_c0 = half.x() > 0 ? automatic : 1;
  if (n_c90 == 0) n_c90 = half.y() > 0 ? automatic : 1;
  std::vector<Vec3> points;
  for (int i = 0; i < n_c0; ++i) {
    for (int j = 0; j < n_c90; ++j) {
      Eigen::Vector2d place((2 * i + 1.0) / n_c0 - 1, (2 * j + 1.0) / n_c90 - 1);
      if (photometry.is_round) place = on_disc(place);
      const Vec3 off = half.cwiseProduct(Vec3(place.x(), place.y(), 0));
      points.emplace_back(luminaire.position + luminaire.axes * off);
    }
  }
  return points;
}

}  // namespace radiosity
