// Means of textures over polygons, against the sum over texels clipped one by one.
#include "radiosity/scene/texture.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "radiosity/base/geometry.h"

namespace radiosity {
namespace {

using Eigen::Vector2d;
using Outline = std::vector<Vector2d>;

/// What of a polygon is on the side of x[axis] that `sign` points to from `at`.
Outline cut(const Outline& polygon, int axis, double at, double sign) {
  Outline kept;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector2d& a = polygon[k];
    const Vector2d& b = polygon[(k + 1) % polygon.size()];
    const double from = sign * (a[axis] - at);
    const double to = sign * (b[axis] - at);
    if (from >= 0) kept.push_back(a);
    if (from * to < 0) kept.emplace_back(a + from / (from - to) * (b - a));
  }
  return kept;
}

double area_of(const Outline& polygon) {
  double area = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector2d& a = polygon[k];
    const Vector2d& b = polygon[(k + 1) % polygon.size()];
    area += (a.x() * b.y() - a.y() * b.x()) / 2;
  }
  return area;
}

/// Reflectance of texel (x, y) of the endless texture, found the slow way.
double texel_of(int x, int y, int width, int height, TextureWrap across, TextureWrap down,
                const std::vector<std::uint8_t>& bytes, int band) {
  const auto place = [](int k, int n, TextureWrap wrap) {
    if (wrap == TextureWrap::clamp) return std::min(std::max(k, 0), n - 1);
    const bool is_mirror = wrap == TextureWrap::mirror;
    while (k < 0) k += 2 * n;
    k %= 2 * n;
    if (k < n) return k;
    return is_mirror ? 2 * n - 1 - k : k - n;
  };
  const int texel = place(y, height, down) * width + place(x, width, across);
  const double s = bytes[static_cast<std::size_t>(3 * texel + band)] / 255.0;
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

std::vector<std::uint8_t> random_bytes(std::size_t n, std::mt19937_64& random) {
  std::vector<std::uint8_t> bytes(n);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random() % 256);
  return bytes;
}

Texture texture_of(int width, int height, std::vector<std::uint8_t> bytes) {
  return {.image = std::make_shared<TextureImage>(width, height, std::move(bytes))};
}

TEST(TextureMean, IsThatOfTexelsOneByOne) {
  constexpr std::uint64_t kSeed = 20;
  std::mt19937_64 random(kSeed);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  constexpr std::array kWraps = {TextureWrap::repeat, TextureWrap::clamp, TextureWrap::mirror};
  for (int round = 0; round < 60; ++round) {
    SCOPED_TRACE(round);
    // Rows are longer and shorter than what is summed at once, and just as long.
    const int width = std::array{1, 7, 32, 64, 70}[random() % 5];
    const int height = 1 + static_cast<int>(random() % 9);
    const auto bytes = random_bytes(static_cast<std::size_t>(3 * width * height), random);
    Texture texture = texture_of(width, height, bytes);
    texture.across = kWraps[random() % 3];
    texture.down = kWraps[random() % 3];
    texture.factor = {uniform(0, 1), uniform(0, 1), 1};
    // A convex polygon turned anyhow: points of an ellipse, either way round.
    const Vector2d center(uniform(-2, 2), uniform(-2, 2));
    const double size = uniform(0.05, 1.5);
    const int n = 3 + static_cast<int>(random() % 3);
    const double turn = uniform(0, 2 * kPi);
    Outline outline;
    for (int k = 0; k < n; ++k) {
      const double angle = turn + (round % 2 == 0 ? 1 : -1) * 2 * kPi * k / n;
      outline.emplace_back(center + size * Vector2d(std::cos(angle), 0.6 * std::sin(angle)));
    }
    Outline texels;
    for (const Vector2d& point : outline)
      texels.push_back(point.cwiseProduct(Vector2d(width, height)));
    const double reach = 1 + size;
    Eigen::Array3d sum = Eigen::Array3d::Zero();
    Eigen::Array3d square_sum = Eigen::Array3d::Zero();
    for (int y = static_cast<int>(std::floor((center.y() - reach) * height));
         y <= (center.y() + reach) * height; ++y) {
      const Outline row = cut(cut(texels, 1, y, 1), 1, y + 1, -1);
      if (row.size() < 3) continue;
      for (int x = static_cast<int>(std::floor((center.x() - reach) * width));
           x <= (center.x() + reach) * width; ++x) {
        const double area = area_of(cut(cut(row, 0, x, 1), 0, x + 1, -1));
        for (int band = 0; band < 3; ++band) {
          const double value = texture.factor[band] * texel_of(x, y, width, height, texture.across,
                                                               texture.down, bytes, band);
          sum[band] += area * value;
          square_sum[band] += area * value * value;
        }
      }
    }
    const TextureMean mean = texture_mean(texture, outline);
    for (int band = 0; band < 3; ++band) {
      EXPECT_NEAR(mean.mean[band], sum[band] / area_of(texels), 1e-10);
      EXPECT_NEAR(mean.square[band], square_sum[band] / area_of(texels), 1e-10);
    }
  }
}

TEST(TextureMean, OfWholePeriodsIsThatOfThePicture) {
  std::mt19937_64 random(3);
  Texture texture = texture_of(12, 5, random_bytes(3 * 12 * 5, random));
  const Eigen::Array3d whole = texture_mean(texture).mean;
  for (const TextureWrap wrap : {TextureWrap::repeat, TextureWrap::mirror}) {
    texture.across = texture.down = wrap;
    for (const double first : {-4., 0., 1000.}) {
      const Outline square = {{first, -2}, {first + 4, -2}, {first + 4, 6}, {first, 6}};
      EXPECT_LT((texture_mean(texture, square).mean - whole).abs().maxCoeff(), 1e-11) << first;
    }
  }
}

TEST(TextureMean, OfAPointOrALineIsWhatLiesThere) {
  // Black, then white: a palette and a ramp, as models without pictures of their own use them.
  const Texture texture = texture_of(2, 1, {0, 0, 0, 255, 255, 255});
  const auto mean = [&](const Outline& outline) { return texture_mean(texture, outline).mean[0]; };
  EXPECT_EQ(mean({{0.75, 0.5}, {0.75, 0.5}, {0.75, 0.5}}), 1);
  EXPECT_EQ(mean({{0.1, 0.5}, {0.2, 0.5}, {0.3, 0.5}}), 0);
  // Of a triangle whose u goes from 0 to 1: the white half of u is a quarter of it; points differ
  // from that by what a row of them holds.
  EXPECT_NEAR(mean({{0, 0.5}, {0, 0.5}, {1, 0.5}}), 0.25, 1. / 16);
}

TEST(TextureMean, KeepsDigitsInLargePictures) {
  // Grey everywhere: whatever the polygon, the mean is the grey.
  const Texture texture = texture_of(4096, 3, std::vector<std::uint8_t>(3 * 4096 * 3, 188));
  const double grey = std::pow((188 / 255.0 + 0.055) / 1.055, 2.4);
  for (const double size : {1e-3, 0.1, 3.0, 50.0}) {
    const Outline triangle = {{0.3, 0.2}, {0.3 + size, 0.2}, {0.3 + size / 3, 0.2 + size}};
    EXPECT_NEAR(texture_mean(texture, triangle).mean[0], grey, 1e-10) << size;
    EXPECT_NEAR(texture_mean(texture, triangle).square[0], grey * grey, 1e-10) << size;
  }
  const Texture white = texture_of(3, 3, std::vector<std::uint8_t>(27, 255));
  EXPECT_LE(texture_mean(white, Outline{{0, 0}, {0.9, 0.1}, {0.2, 0.7}}).mean.maxCoeff(), 1);
}

}  // namespace
}  // namespace radiosity
