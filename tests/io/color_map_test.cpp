#include "io/picture/color_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace {

using io::ColorScale;

TEST(ColorScale, IsRoundAndLeavesOutTheBrightestTwoPercent) {
  Eigen::VectorXd values = Eigen::VectorXd::LinSpaced(1000, 13, 97.3);
  values.tail(15).setConstant(1e6);
  values[3] = std::numeric_limits<double>::quiet_NaN();
  const ColorScale scale = io::fitting_scale(values, false);
  EXPECT_DOUBLE_EQ(scale.low, 10);
  EXPECT_DOUBLE_EQ(scale.high, 100);
  const ColorScale logarithmic = io::fitting_scale(values, true);
  EXPECT_DOUBLE_EQ(logarithmic.low, 10);
  EXPECT_DOUBLE_EQ(logarithmic.high, 100);
}

TEST(ColorScale, ScalesWithTheValuesAndKeepsSigns) {
  const Eigen::VectorXd values = Eigen::VectorXd::LinSpaced(500, -3.1, 8.2);
  const ColorScale scale = io::fitting_scale(values, false);
  EXPECT_DOUBLE_EQ(scale.low, -4);
  EXPECT_DOUBLE_EQ(scale.high, 8);
  const ColorScale small = io::fitting_scale(1e-7 * values, false);
  EXPECT_NEAR(small.low, -4e-7, 1e-15);
  EXPECT_NEAR(small.high, 8e-7, 1e-15);
}

TEST(ColorScale, HasASpanWhateverTheValues) {
  for (const bool logarithmic : {false, true}) {
    for (const double value : {0.0, 3.7, -2.0, 1e-300, 1e300}) {
      const ColorScale scale = io::fitting_scale(Eigen::VectorXd::Constant(9, value), logarithmic);
      EXPECT_LT(scale.low, scale.high) << value;
      if (logarithmic) {
        EXPECT_GT(scale.low, 0) << value;
      }
    }
    const ColorScale none = io::fitting_scale(Eigen::VectorXd(), logarithmic);
    EXPECT_LT(none.low, none.high);
  }
  // A log scale spans no more than six decades.
  const ColorScale wide = io::fitting_scale(Eigen::Vector3d(1e-12, 1, 1), true);
  EXPECT_NEAR(wide.low, 1e-6, 1e-15);
}

TEST(ColorScale, SpansTheRanksThatAreChosen) {
  const Eigen::VectorXd values = Eigen::VectorXd::LinSpaced(1001, 0, 1000);
  const ColorScale all = io::fitting_scale(values, false, {.low_percent = 0, .high_percent = 100});
  EXPECT_EQ(all.low, 0);
  EXPECT_EQ(all.high, 1000);
  const ColorScale inner =
      io::fitting_scale(values, false, {.low_percent = 20, .high_percent = 70});
  EXPECT_DOUBLE_EQ(inner.low, 200);
  EXPECT_DOUBLE_EQ(inner.high, 700);
  const ColorScale logarithmic =
      io::fitting_scale(values, true, {.low_percent = 10, .high_percent = 100});
  EXPECT_DOUBLE_EQ(logarithmic.low, 100);
}

TEST(ColorScale, IsSymmetricIfThatIsChosenAndAnyIsBelowZero) {
  const io::ScaleChoice choice = {.high_percent = 100, .is_symmetric = true};
  const ColorScale scale = io::fitting_scale(Eigen::Vector3d(-3, 1, 9.5), false, choice);
  EXPECT_EQ(scale.low, -scale.high);
  EXPECT_GE(scale.high, 9.5);
  EXPECT_EQ(io::fitting_scale(Eigen::Vector3d(0, 1, 9.5), false, choice).low, 0);
}

TEST(ColorScale, ValuesAreWhereTheirPositionsAre) {
  for (const ColorScale& scale : {ColorScale{-3, 17}, {0.01, 100, true}}) {
    for (const double position : {0.0, 0.25, 1.0}) {
      EXPECT_NEAR(io::position_on(scale, io::value_at(scale, position)), position, 1e-12);
    }
    EXPECT_GT(io::value_at(scale, 1.5), scale.high);
    EXPECT_LT(io::value_at(scale, -0.5), scale.low);
  }
}

TEST(ColorScale, PositionsRunFromZeroToOne) {
  EXPECT_EQ(io::position_on({10, 30}, 20), 0.5);
  EXPECT_EQ(io::position_on({10, 30}, 5), 0);
  EXPECT_EQ(io::position_on({10, 30}, 31), 1);
  EXPECT_NEAR(io::position_on({0.01, 100, true}, 1), 0.5, 1e-15);
  EXPECT_EQ(io::position_on({0.01, 100, true}, -1), 0);
}

TEST(Ticks, AreRoundAndFew) {
  EXPECT_EQ(io::tick_values({0, 10}, 6), (std::vector<double>{0, 2, 4, 6, 8, 10}));
  EXPECT_EQ(io::tick_values({0, 10}, 4), (std::vector<double>{0, 5, 10}));
  EXPECT_EQ(io::tick_values({3, 17}, 5), (std::vector<double>{5, 10, 15}));
  EXPECT_EQ(io::tick_values({1, 100, true}, 9), (std::vector<double>{1, 2, 5, 10, 20, 50, 100}));
  EXPECT_EQ(io::tick_values({1, 100, true}, 4), (std::vector<double>{1, 10, 100}));
  EXPECT_EQ(io::tick_values({3.2, 3.4, true}, 4), (std::vector<double>{3.2, 3.4}));
  for (int most = 2; most < 20; ++most) {
    for (const ColorScale& scale :
         {ColorScale{0, 7e-5}, {-3, 1234}, {1e-6, 1, true}, {2, 90, true}}) {
      const auto ticks = io::tick_values(scale, most);
      EXPECT_GE(ticks.size(), 2U) << most;
      EXPECT_LE(static_cast<int>(ticks.size()), most);
      EXPECT_TRUE(std::is_sorted(ticks.begin(), ticks.end()));
    }
  }
}

/// CIE lightness (0 to 1) of 8-bit sRGB.
double lightness(const std::array<std::uint8_t, 3>& color) {
  const auto linear = [](double c) {
    c /= 255;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  const double y =
      0.2126 * linear(color[0]) + 0.7152 * linear(color[1]) + 0.0722 * linear(color[2]);
  return y > 0.008856 ? 1.16 * std::cbrt(y) - 0.16 : 9.033 * y;
}

TEST(ColorMap, IsFoundByItsName) {
  for (const io::ColorMap map : io::color_maps()) {
    EXPECT_EQ(io::color_map_named(io::color_map_name(map)), map);
  }
  EXPECT_EQ(io::color_map_named("gray"), io::ColorMap::grey);
  EXPECT_FALSE(io::color_map_named("jet"));
}

// What is larger is lighter; of a diverging one what is further from the middle is darker.
TEST(ColorMap, TellsNumbersByLightness) {
  const auto at = [](io::ColorMap map, int k) { return lightness(io::map_color(k / 20.0, map)); };
  for (const io::ColorMap map : io::color_maps()) {
    SCOPED_TRACE(io::color_map_name(map));
    const int middle = map == io::ColorMap::diverging ? 10 : 20;
    for (int k = 1; k <= 20; ++k) {
      const double rise = at(map, k) - at(map, k - 1);
      EXPECT_GT(k <= middle ? rise : -rise, 0) << k;
    }
  }
  const io::Rgb middle = io::map_color(0.5, io::ColorMap::diverging);
  EXPECT_EQ(middle[0], middle[1]);
  EXPECT_EQ(middle[1], middle[2]);
}

TEST(ColorMap, GrowsLighterEvenly) {
  EXPECT_EQ(io::map_color(0), (std::array<std::uint8_t, 3>{68, 1, 84}));
  EXPECT_EQ(io::map_color(1), (std::array<std::uint8_t, 3>{253, 231, 37}));
  EXPECT_EQ(io::map_color(-1), io::map_color(0));
  const double first = lightness(io::map_color(0));
  const double last = lightness(io::map_color(1));
  for (int k = 1; k <= 20; ++k) {
    const double here = lightness(io::map_color(k / 20.0));
    EXPECT_GT(here, lightness(io::map_color((k - 1) / 20.0)));
    // Viridis is uniform in CAM02-UCS, whose lightness is close to but not that of CIELAB.
    EXPECT_NEAR(here, first + k / 20.0 * (last - first), 0.03) << k;
  }
}

// Differences of either sign look alike but for their hue, and none looks like nothing.
TEST(ColorMap, OfDifferencesIsLightestInTheMiddle) {
  const auto color = [](double position) {
    return io::map_color(position, io::ColorMap::diverging);
  };
  const io::Rgb middle = color(0.5);
  EXPECT_EQ(middle[0], middle[1]);
  EXPECT_EQ(middle[1], middle[2]);
  for (int k = 1; k <= 10; ++k) {
    const io::Rgb less = color(0.5 - k / 20.0);
    const io::Rgb more = color(0.5 + k / 20.0);
    EXPECT_GT(less[2], less[0]);
    EXPECT_GT(more[0], more[2]);
    EXPECT_LT(lightness(less), lightness(color(0.5 - (k - 1) / 20.0)));
    EXPECT_LT(lightness(more), lightness(color(0.5 + (k - 1) / 20.0)));
  }
}

}  // namespace
