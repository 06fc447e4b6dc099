#include "io/base/rounding.h"

#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "tests/support/scratch_files.h"

namespace {

using io::found_rounding;
using io::Rounding;
using radiosity::Vec3;

constexpr int kPoints = 200;

double as_printed(double value, const char* format) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return std::strtod(text, nullptr);
}

/// What a program that prints its coordinates like this makes of points in a box from `origin`.
std::vector<Vec3> printed(const char* format, double size, const Vec3& origin = Vec3::Zero()) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> in_box(0, size);
  std::vector<Vec3> points;
  for (int i = 0; i < kPoints; ++i) {
    Vec3 point;
    for (int k = 0; k < 3; ++k) point[k] = as_printed(origin[k] + in_box(random), format);
    points.push_back(point);
  }
  return points;
}

TEST(Rounding, IsHalfAUnitOfTheLastSignificantDigit) {
  EXPECT_DOUBLE_EQ(found_rounding(printed("%.6g", 5)).precision, 0.5e-5);
  EXPECT_DOUBLE_EQ(found_rounding(printed("%.6g", 0.9)).precision, 0.5e-6);
  EXPECT_DOUBLE_EQ(found_rounding(printed("%.7g", 5000)).precision, 0.5e-3);
  EXPECT_DOUBLE_EQ(found_rounding(printed("%.9g", 5)).precision, 0.5e-8);
  EXPECT_DOUBLE_EQ(found_rounding(printed("%.12g", 5)).precision, 0.5e-11);
}

TEST(Rounding, IsHalfAUnitOfTheLastDecimal) {
  EXPECT_DOUBLE_EQ(found_rounding(printed("%.6f", 5)).precision, 0.5e-6);
  EXPECT_DOUBLE_EQ(found_rounding(printed("%.6f", 0.5)).precision, 0.5e-6);
  EXPECT_DOUBLE_EQ(found_rounding(printed("%.4f", 50)).precision, 0.5e-4);
  EXPECT_DOUBLE_EQ(found_rounding(printed("%.3f", 5000)).precision, 0.5e-3);
}

TEST(Rounding, KnowsSinglePrecisionHoweverItIsWritten) {
  std::vector<Vec3> stored = printed("%.17g", 5);
  std::vector<Vec3> shortest = stored;
  std::vector<Vec3> nine_digits = stored;
  for (int i = 0; i < kPoints; ++i) {
    for (int k = 0; k < 3; ++k) {
      const auto value = static_cast<float>(stored[i][k]);
      stored[i][k] = value;
      nine_digits[i][k] = as_printed(value, "%.9g");
      char text[32];
      *std::to_chars(text, text + sizeof text, value).ptr = 0;
      shortest[i][k] = std::strtod(text, nullptr);
    }
  }
  const double half_unit = 5 * std::ldexp(1, -24);  // of the largest coordinate, nearly 5
  for (const auto& points : {stored, shortest, nine_digits}) {
    EXPECT_NEAR(found_rounding(points).precision, half_unit, 0.02 * half_unit);
  }
}

TEST(Rounding, DoublesAndFewDigitsAreExact) {
  EXPECT_EQ(found_rounding({}).precision, 0);
  EXPECT_EQ(found_rounding(printed("%.17g", 5)).precision, 0);
  EXPECT_EQ(found_rounding(printed("%.15g", 5)).precision, 0);
  EXPECT_EQ(found_rounding(printed("%.4g", 5)).precision, 0);
  EXPECT_EQ(found_rounding(printed("%.1f", 900)).precision, 0);
  // By hand: a panel of 1 m on a ground of 2,000 km, and two plates 10 µm apart.
  const std::vector<Vec3> ground = {{-1e6, -1e6, 0}, {1e6, 1e6, 0}, {0.25, 0, 1}, {-0.125, 0, 1}};
  EXPECT_EQ(found_rounding(ground).precision, 0);
  const std::vector<Vec3> plates = {{0, 0, 0}, {1, 1, 0}, {0, 0, 1.00001}, {1, 1, 1.00001}};
  EXPECT_EQ(found_rounding(plates).precision, 0);
}

TEST(Rounding, OneLongNumberDecidesNothing) {
  std::vector<Vec3> points = printed("%.6f", 0.5);
  points.emplace_back(1234.56, 1000, 0);  // in a file that is exact there
  EXPECT_DOUBLE_EQ(found_rounding(points).precision, 0.5e-6);
}

TEST(Rounding, SeesRoundedThingsInAnExactRoom) {
  std::vector<Vec3> points = printed("%.6g", 5);
  points.resize(8);  // a turned box
  for (int i = 0; i < kPoints; ++i) points.emplace_back(i % 10, i / 10, 0.5 * (i % 3));
  EXPECT_DOUBLE_EQ(found_rounding(points).precision, 0.5e-5);
}

TEST(Rounding, IsSmallForTheSizeButTellsWhatTheDigitsSay) {
  const Rounding moved = found_rounding(printed("%.8g", 10, {1e6, 2e6, 0}));
  EXPECT_DOUBLE_EQ(moved.of_digits, 0.05);
  EXPECT_NEAR(moved.precision, 1e-5 * 17, 2e-5);
  EXPECT_TRUE(rounding_warning(moved));
  EXPECT_FALSE(rounding_warning(found_rounding(printed("%.6g", 10))));
}

using PrecisionOfFiles = ScratchFiles;

constexpr const char* kTetrahedron =
    "v 0.123457 0.234567 0.345679\nv 1.23457 0.345671 0.456789\nv 0.765433 1.34568 0.567891\n"
    "v 0.678912 0.456781 1.45679\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

TEST_F(PrecisionOfFiles, ScalesWithTheUnit) {
  const auto path = file("box.obj", kTetrahedron);
  EXPECT_DOUBLE_EQ(io::read_scene(path).precision, 0.5e-5);
  EXPECT_DOUBLE_EQ(io::read_scene(path, {.unit = "mm"}).precision, 0.5e-8);
  EXPECT_DOUBLE_EQ(io::read_scene(path, {.precision = 1e-4}).precision, 1e-4);
}

TEST_F(PrecisionOfFiles, OfASceneIsTheLargestOfItsFiles) {
  (void)file("box.obj", kTetrahedron);
  const std::string scene =
      R"({"unit": "mm", "materials": {"m": {"reflectance": 0.5}}, "surfaces": [
      {"name": "box", "material": "m", "mesh": "box.obj", "unit": "cm",
       "transform": {"rotate": {"axis": [0, 0, 1], "degrees": 90}, "scale": 2}},
      {"name": "floor", "material": "m",
       "polygons": [[[0, 0, 0], [3000, 0, 0], [3000, 2000, 0], [0, 2000, 0]]]}])";
  EXPECT_NEAR(read("scene.json", scene + "}").precision, 2 * 0.01 * 0.5e-5, 1e-12);
  EXPECT_EQ(read("said.json", scene + ", \"precision\": 0.25}").precision, 0.25e-3);
  EXPECT_EQ(read("exact.json", scene + ", \"precision\": 0}").precision, 0);
  EXPECT_CONTAINS(error_of("wrong.json", scene + ", \"precision\": -1}"),
                  "wrong.json: precision: is -1, expected no negative number");
}

TEST_F(PrecisionOfFiles, OfInlinePolygonsIsThatOfTheirDigits) {
  const std::string scene =
      R"({"unit": "mm", "materials": {"m": {"reflectance": 0.5}}, "surfaces": [
      {"name": "floor", "material": "m",
       "polygons": [[[0, 0, 0], [3000, 0, 0], [3000, 2000, 0], [0, 2000, 0]]]},
      {"name": "turned", "material": "m", "polygons": [
       [[123.457, 234.567, 0], [1234.57, 345.678, 0], [567.891, 2345.67, 0], [678.912, 2345.11, 9]]]}
      ]})";
  EXPECT_NEAR(read("scene.json", scene).precision, 0.5e-5, 1e-15);
}

}  // namespace
