#include "radiosity/scene/color_matching.h"

#include <gtest/gtest.h>

#include <vector>

namespace radiosity {
namespace {

std::vector<double> wavelengths(double first, double step, int n) {
  std::vector<double> result;
  for (int k = 0; k < n; ++k) result.push_back(first + k * step);
  return result;
}

Eigen::Vector3d tristimulus(const std::vector<double>& bands, const Eigen::VectorXd& spectrum) {
  return (spectrum.transpose() * tristimulus_weights(bands)).transpose();
}

Eigen::Vector3d flat_tristimulus(const std::vector<double>& bands) {
  return tristimulus(bands, Eigen::VectorXd::Ones(static_cast<Eigen::Index>(bands.size())));
}

TEST(ColorMatching, HasTheIntegralsOfTheStandard) {
  // The standard's table at every 1 nm adds up to 106.8655, 106.8569 and 106.8923.
  const Eigen::Vector3d integrals = flat_tristimulus(wavelengths(360, 5, 95));
  EXPECT_NEAR(integrals[0], 106.865, 1e-3);
  EXPECT_NEAR(integrals[1], 106.857, 1e-3);
  EXPECT_NEAR(integrals[2], 106.892, 2e-3);
}

TEST(ColorMatching, FollowsTheTableAndIsZeroOutside) {
  EXPECT_EQ(color_matching(555)[1], 1);
  EXPECT_NEAR(color_matching(507)[1], 0.4073 + 0.4 * (0.503 - 0.4073), 1e-15);
  EXPECT_EQ(color_matching(360), Eigen::Vector3d(0.0001299, 0.000003917, 0.0006061));
  EXPECT_EQ(color_matching(830)[1], 0.00000045181);
  for (const double outside : {0.0, 359.9, 830.1, 1e6}) {
    EXPECT_EQ(color_matching(outside), Eigen::Vector3d(0, 0, 0)) << outside;
  }
}

TEST(ColorMatching, EqualEnergyIsWhite) {
  for (const auto& bands : {wavelengths(360, 5, 95), wavelengths(400, 4, 76)}) {
    const Eigen::Vector3d xyz = flat_tristimulus(bands);
    EXPECT_NEAR(xyz[0] / xyz.sum(), 1.0 / 3, 1e-3) << bands.size();
    EXPECT_NEAR(xyz[1] / xyz.sum(), 1.0 / 3, 1e-3) << bands.size();
  }
}

TEST(ColorMatching, DaylightIsTheWhiteOfSrgb) {
  // Relative spectral power of CIE standard illuminant D65, 380 to 780 nm at 10 nm.
  const std::vector<double> d65 = {49.9755, 54.6482, 82.7549, 91.4860, 93.4318, 86.6823, 104.865,
                                   117.008, 117.812, 114.861, 115.923, 108.811, 109.354, 107.802,
                                   104.790, 107.689, 104.405, 104.046, 100.000, 96.3342, 95.7880,
                                   88.6856, 90.0062, 89.5991, 87.6987, 83.2886, 83.6992, 80.0268,
                                   80.2146, 82.2778, 78.2842, 69.7213, 71.6091, 74.3490, 61.6040,
                                   69.8856, 75.0870, 63.5927, 46.4182, 66.8054, 63.3828};
  // Between them it is linear by definition.
  Eigen::VectorXd spectrum(81);
  for (int k = 0; k < 81; ++k) spectrum[k] = (d65[k / 2] + d65[(k + 1) / 2]) / 2;
  const Eigen::Vector3d xyz = tristimulus(wavelengths(380, 5, 81), spectrum);
  // Published: x = 0.31272, y = 0.32903, from steps of 1 nm.
  EXPECT_NEAR(xyz[0] / xyz.sum(), 0.31272, 1e-4);
  EXPECT_NEAR(xyz[1] / xyz.sum(), 0.32903, 1e-4);
  const Eigen::Vector3d rgb = xyz_to_srgb() * xyz / xyz[1];
  for (const double component : rgb) EXPECT_NEAR(component, 1, 2e-3) << rgb.transpose();
}

TEST(ColorMatching, LuminanceOfSrgbIsY) {
  const Eigen::RowVector3d y = kSrgbLuminance.transpose() * xyz_to_srgb();
  EXPECT_NEAR(y[0], 0, 1e-4);
  EXPECT_NEAR(y[1], 1, 1e-4);
  EXPECT_NEAR(y[2], 0, 1e-4);
}

TEST(ColorMatching, IntegratesByTrapezoids) {
  EXPECT_EQ(integration_weights({400, 410, 450}), Eigen::Vector3d(5, 25, 20));
  EXPECT_EQ(integration_weights({550}), Eigen::VectorXd::Zero(1));
}

}  // namespace
}  // namespace radiosity
