#include "radiosity/solve/quantity.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "radiosity/scene/patch_mesh.h"
#include "radiosity/solve/solution.h"
#include "tests/support/shapes.h"

namespace radiosity {
namespace {

Bands wavelengths(double first, double step, int n) {
  Bands bands = {.kind = Bands::Kind::wavelengths, .wavelengths = {}};
  for (int k = 0; k < n; ++k) bands.wavelengths.push_back(first + k * step);
  return bands;
}

/// Six patches of 1/4, 1/2 m² ... with B, H, M_e, ρ, error all different.
struct Example {
  PatchMesh mesh;
  Solution solution;

  explicit Example(Index n_bands) {
    test::add_grid(mesh, Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), 2, 2);
    test::add_grid(mesh, Vec3(0, 0, 1), Vec3::UnitX(), Vec3::UnitY(), 1, 2);
    std::srand(7);
    const auto field = [&] { return Eigen::MatrixXd(Eigen::MatrixXd::Random(6, n_bands)); };
    solution.radiosity = field();
    solution.irradiance = field();
    solution.exitance = field();
    solution.reflectance = field();
    solution.radiosity_error = field();
  }
  [[nodiscard]] Eigen::MatrixXd values(Quantity quantity, const Bands& bands) const {
    return make_field(quantity, mesh, solution, bands).values;
  }
};

TEST(Quantities, HaveDifferentNamesThatFindThem) {
  std::set<std::string_view> names;
  std::set<std::string_view> columns;
  for (const QuantityInfo& info : quantity_infos()) {
    EXPECT_EQ(quantity_named(info.name), info.quantity);
    EXPECT_EQ(quantity_info(info.quantity).name, info.name);
    names.insert(info.name);
    columns.insert(info.column);
  }
  EXPECT_EQ(names.size(), 15U);
  EXPECT_EQ(columns.size(), 15U);
  EXPECT_FALSE(quantity_named("net_flux"));
}

TEST(Quantities, FollowFromTheSolution) {
  const Example example(3);
  const Solution& solution = example.solution;
  const Bands rgb;
  EXPECT_EQ(example.values(Quantity::radiosity, rgb), solution.radiosity);
  EXPECT_EQ(example.values(Quantity::irradiance, rgb), solution.irradiance);
  EXPECT_EQ(example.values(Quantity::exitance, rgb), solution.exitance);
  EXPECT_EQ(example.values(Quantity::reflectance, rgb), solution.reflectance);
  EXPECT_EQ(example.values(Quantity::error, rgb), solution.radiosity_error);
  EXPECT_EQ(example.values(Quantity::net_flux, rgb), solution.radiosity - solution.irradiance);
  EXPECT_EQ(example.values(Quantity::radiance, rgb), solution.radiosity / kPi);
  const Eigen::MatrixXd power = example.values(Quantity::power, rgb);
  EXPECT_TRUE(power.row(0).isApprox(0.25 * solution.radiosity.row(0), 1e-15));
  EXPECT_TRUE(power.row(5).isApprox(0.5 * solution.radiosity.row(5), 1e-15));
}

TEST(Quantities, PhotometricOnesAreRelatedAsTheirRadiometricOnes) {
  const Example example(3);
  const Bands rgb;
  const Eigen::MatrixXd exitance = example.values(Quantity::luminous_exitance, rgb);
  ASSERT_EQ(exitance.cols(), 1);
  const Eigen::RowVector3d b = example.solution.radiosity.row(2);
  EXPECT_NEAR(exitance(2, 0), 179 * (0.2126 * b[0] + 0.7152 * b[1] + 0.0722 * b[2]), 1e-12);
  EXPECT_TRUE(example.values(Quantity::luminance, rgb).isApprox(exitance / kPi, 1e-14));
  EXPECT_NEAR(example.values(Quantity::luminous_flux, rgb)(5, 0), 0.5 * exitance(5, 0), 1e-12);
  const Eigen::RowVector3d h = example.solution.irradiance.row(1);
  EXPECT_NEAR(example.values(Quantity::illuminance, rgb)(1, 0),
              179 * (0.2126 * h[0] + 0.7152 * h[1] + 0.0722 * h[2]), 1e-12);
}

TEST(LuminousWeights, OfAFlatSpectrumAreTheIntegralOfTheEyesSensitivity) {
  EXPECT_NEAR(luminous_weights(wavelengths(360, 5, 95)).sum(), 683 * 106.857, 683 * 1e-3);
  // Linear interpolation and the trapezoidal rule at the table's own wavelengths agree.
  EXPECT_NEAR(luminous_weights(wavelengths(360, 1, 471)).sum(), 683 * 106.857, 683 * 1e-3);
}

TEST(LuminousWeights, CountNothingOutsideTheVisible) {
  EXPECT_TRUE(luminous_weights(wavelengths(840, 100, 30)).isZero(0));
  EXPECT_TRUE(luminous_weights(wavelengths(100, 10, 26)).isZero(0));
  EXPECT_TRUE(luminous_weights(wavelengths(555, 1, 1)).isZero(0));
  const Eigen::VectorXd weights = luminous_weights(wavelengths(350, 10, 3));
  EXPECT_EQ(weights[0], 0);
  EXPECT_GT(weights[1], 0);
}

TEST(LuminousWeights, TakeTheEfficacyForGreyAndRgb) {
  const Bands grey = {.kind = Bands::Kind::grey, .wavelengths = {}};
  EXPECT_EQ(luminous_weights(grey)[0], 179);
  EXPECT_EQ(luminous_weights(grey, 100)[0], 100);
  EXPECT_NEAR(luminous_weights({}, 100).sum(), 100, 1e-12);
  EXPECT_DOUBLE_EQ(luminous_weights({}, 100)[1], 71.52);
}

TEST(Units, ArePerNanometreForWavelengths) {
  const Bands bands = wavelengths(400, 100, 4);
  EXPECT_EQ(band_unit("W", bands), "W/nm");
  EXPECT_EQ(band_unit("W/m²", bands), "W/(m² nm)");
  EXPECT_EQ(band_unit("W/(m² sr)", bands), "W/(m² sr nm)");
  EXPECT_EQ(band_unit("", bands), "");
  EXPECT_EQ(band_unit("W/m²", {}), "W/m²");
}

TEST(MeanOverBands, WeighsWavelengthsByWhatTheySpan) {
  Eigen::MatrixXd values(1, 3);
  values << 1, 2, 6;
  EXPECT_DOUBLE_EQ(mean_over_bands(values, {})[0], 3);
  EXPECT_DOUBLE_EQ(mean_over_bands(values, {400, 410, 450})[0], (5 * 1 + 25 * 2 + 20 * 6) / 50.0);
  EXPECT_DOUBLE_EQ(mean_over_bands(values.leftCols(1), {550})[0], 1);
}

}  // namespace
}  // namespace radiosity
