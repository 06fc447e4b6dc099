#include "radiosity/scene/black_body.h"

#include <cmath>

namespace radiosity {
namespace {

/// ζ(2k), k >= 1.
double even_zeta(int k) {
  if (k == 1) return square(kPi) / 6;
  if (k == 2) return square(square(kPi)) / 90;
  double sum = 0;
  for (int n = 40; n >= 1; --n) sum += std::pow(n, -2.0 * k);
  // What is left, ∫ from 40.5 on, to 2e-12: these terms count 1e-5 at most.
  return sum + std::pow(40.5, 1 - 2.0 * k) / (2 * k - 1);
}

/// 1 - F for x < 2π: 15/π⁴ x³ (1/3 - x/8 + Σ_k B_2k x^2k / ((2k + 3) (2k)!)), with
/// B_2k / (2k)! = -2 (-1)^k ζ(2k) / (2π)^2k.
double fraction_above(double x) {
  constexpr int kTerms = 16;  // (x/2π)² <= 1/39 each for x <= 1
  double sum = 1.0 / 3 - x / 8;
  const double ratio = square(x / (2 * kPi));
  double power = 1;
  for (int k = 1; k <= kTerms; ++k) {
    power *= -ratio;
    sum -= 2 * power * even_zeta(k) / (2 * k + 3);
  }
  return 15 / std::pow(kPi, 4) * x * x * x * sum;
}

}  // namespace

double black_body_fraction(double wavelength_temperature) {
  if (!(wavelength_temperature > 0)) return 0;
  const double x = kSecondRadiationConstant / wavelength_temperature;
  if (x < 1) return 1 - fraction_above(x);
  constexpr double kNegligible = 40;  // e^-40 = 4e-18
  double sum = 0;
  for (int n = 1; n == 1 || (n - 1) * x < kNegligible; ++n) {
    const double m = 1.0 / n;
    sum += std::exp(-n * x) * m * (x * x * x + m * (3 * x * x + m * (6 * x + 6 * m)));
  }
  return 15 / std::pow(kPi, 4) * sum;
}

Eigen::VectorXd thermal_fractions(const Bands& bands, double temperature) {
  Eigen::VectorXd fractions = Eigen::VectorXd::Zero(bands.count());
  double below = 0;
  for (std::size_t k = 0; k < bands.edges.size(); ++k) {
    const double fraction = black_body_fraction(bands.edges[k] * temperature);
    fractions[static_cast<Index>(k)] = fraction - below;
    below = fraction;
  }
  fractions[fractions.size() - 1] = 1 - below;
  return fractions;
}

}  // namespace radiosity
