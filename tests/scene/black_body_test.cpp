// How black bodies' emission is spread over wavelengths.
#include "radiosity/scene/black_body.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "radiosity/polygon/gauss.h"

namespace radiosity {
namespace {

/// F_{0-λT} by 32-point Gauss rules on pieces of Planck's law, which leave less than 1e-15.
double integrated_fraction(double wavelength_temperature) {
  const double x = kSecondRadiationConstant / wavelength_temperature;
  constexpr double kEnd = 60;  // e^-60 60³ = 2e-21
  constexpr double kPiece = 0.5;
  double sum = 0;
  for (double start = x; start < kEnd; start += kPiece) {
    for (const GaussPoint& point : gauss_rule(kMaxGaussOrder)) {
      const double t = start + kPiece * point.x;
      sum += kPiece * point.weight * t * t * t / std::expm1(t);
    }
  }
  return 15 / std::pow(kPi, 4) * sum;
}

TEST(BlackBody, FractionsAreThoseOfTables) {
  // Incropera & DeWitt (1996), table 12.1, µm K.
  const std::vector<std::pair<double, double>> table = {{1000, 0.000321},  {2000, 0.066728},
                                                        {4000, 0.480877},  {6000, 0.737818},
                                                        {10000, 0.914199}, {20000, 0.985602}};
  // Its constants c₁ = 3.742e8 and σ = 5.670e-8 have four digits, which is 1e-4 together; and six
  // decimals.
  for (const auto& [x, fraction] : table) {
    EXPECT_NEAR(black_body_fraction(x), fraction, 1e-4 * fraction + 1e-6) << x;
  }
  // Wien's displacement law: a quarter of the power is below the peak, at 2897.8 µm K.
  EXPECT_NEAR(black_body_fraction(2897.772), 0.25005, 1e-5);
}

TEST(BlackBody, FractionsAreIntegralsOfPlancksLaw) {
  for (double x = 300; x < 3e6; x *= 1.13) {
    EXPECT_NEAR(black_body_fraction(x), integrated_fraction(x), 1e-13) << x;
  }
  // On both sides of where one series takes over from the other.
  const double border = kSecondRadiationConstant;
  EXPECT_NEAR(black_body_fraction(border * (1 - 1e-13)), black_body_fraction(border * (1 + 1e-13)),
              1e-12);
  EXPECT_EQ(black_body_fraction(0), 0);
  EXPECT_EQ(black_body_fraction(1), 0);
  EXPECT_NEAR(black_body_fraction(1e12), 1, 1e-15);
}

TEST(BlackBody, BandsShareAllThatIsEmitted) {
  for (const double temperature : {0., 3., 300., 5772.}) {
    const Eigen::VectorXd fractions = thermal_fractions(
        {.kind = Bands::Kind::thermal, .wavelengths = {}, .edges = {2, 4, 8, 20}}, temperature);
    ASSERT_EQ(fractions.size(), 5);
    EXPECT_NEAR(fractions.sum(), 1, 1e-15);
    EXPECT_GE(fractions.minCoeff(), 0);
  }
  EXPECT_EQ(thermal_fractions({.kind = Bands::Kind::grey, .wavelengths = {}}, 300),
            Eigen::VectorXd::Ones(1));
  EXPECT_EQ(thermal_fractions({.kind = Bands::Kind::solar_infrared, .wavelengths = {}}, 300),
            Eigen::Vector2d(0, 1));
  const Eigen::VectorXd split = thermal_fractions(
      {.kind = Bands::Kind::solar_infrared, .wavelengths = {}, .edges = {3}}, 1000);
  EXPECT_NEAR(split[0], black_body_fraction(3000), 1e-16);
}

}  // namespace
}  // namespace radiosity
