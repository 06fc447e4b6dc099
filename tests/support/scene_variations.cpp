#include "tests/support/scene_variations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <string>

#include "tests/support/scene_random.h"

namespace radiosity::test {
namespace {

/// Half a unit of the last of six digits of a coordinate as large as this.
double six_digits_precision(double largest) {
  return 0.5 * std::pow(10, std::floor(std::log10(largest)) - 5);
}

double single_precision(double largest) {
  return std::ldexp(1.0, static_cast<int>(std::floor(std::log2(largest))) - 24);
}

double rounded(double x, Digits digits) {
  switch (digits) {
    case Digits::six: {
      std::array<char, 32> text{};
      std::snprintf(text.data(), text.size(), "%.6g", x);
      return std::strtod(text.data(), nullptr);
    }
    case Digits::single:
      return static_cast<double>(static_cast<float>(x));
    case Digits::all:
      break;
  }
  return x;
}

/// Tells the scene how far off its coordinates may be, where scenes know.
template <class S>
void set_precision(S& scene, double precision) {
  if constexpr (requires { scene.precision; }) scene.precision = precision;
}

std::string describe(const Variation& v) {
  std::string text;
  if (v.is_turned) text += ", turned";
  if (v.scale != 1) text += ", scaled by " + std::to_string(v.scale);
  if (!v.shift.isZero()) text += ", moved by " + std::to_string(v.shift.norm());
  if (v.digits == Digits::six) text += ", 6 digits";
  if (v.digits == Digits::single) text += ", float32";
  if (v.is_shuffled) text += ", shuffled";
  if (v.is_triangular) text += ", triangles";
  return text + ", variation " + std::to_string(v.seed);
}

}  // namespace

Variation random_variation(std::uint64_t seed) {
  Random random(seed);
  Variation v{.seed = seed};
  v.is_turned = random.integer(0, 2) == 0;
  if (random.integer(0, 2) == 0) v.scale = random.log_uniform(1e-3, 1e3);
  v.digits = std::array{Digits::all, Digits::six, Digits::single}[random.integer(0, 2)];
  const bool is_moved = random.integer(0, 2) == 0;
  if (is_moved && v.digits == Digits::all) {
    // At most 1e6 m and as many sizes of the scene: beyond that it is no longer the same shape.
    v.shift = random.log_uniform(1, 1e6) * std::min(1.0, v.scale) * random.direction();
  }
  v.is_shuffled = random.coin();
  v.is_triangular = random.integer(0, 2) == 0;
  return v;
}

FamilyScene vary(const FamilyScene& original, const Variation& variation) {
  Random random(variation.seed);
  FamilyScene result = original;
  Scene& scene = result.scene;
  const Eigen::Matrix3d rotation =
      variation.is_turned ? random.rotation() : Eigen::Matrix3d::Identity();
  double largest = 0;
  for (Vec3& vertex : scene.vertices) {
    vertex = variation.scale * (rotation * vertex) + variation.shift;
    largest = std::max(largest, vertex.cwiseAbs().maxCoeff());
    for (double& coordinate : vertex) coordinate = rounded(coordinate, variation.digits);
  }
  if (variation.digits == Digits::six) result.precision = six_digits_precision(largest);
  if (variation.digits == Digits::single) result.precision = single_precision(largest);
  set_precision(scene, result.precision);

  std::vector<Index> order(original.scene.n_polygons());
  std::iota(order.begin(), order.end(), 0);
  if (variation.is_shuffled) random.shuffle(order);
  scene.corners.clear();
  scene.first_corner = {0};
  scene.polygon_surface.clear();
  result.pieces.clear();
  const auto add = [&](const std::vector<std::int32_t>& corners, Index polygon) {
    scene.add_polygon(corners, original.scene.polygon_surface[polygon]);
    result.pieces.push_back(original.pieces[polygon]);
  };
  for (const Index polygon : order) {
    const auto corners = original.scene.polygon(polygon);
    std::vector<std::int32_t> turned(corners.begin(), corners.end());
    if (variation.is_shuffled) {
      const int first = random.integer(0, static_cast<int>(turned.size()) - 1);
      std::rotate(turned.begin(), turned.begin() + first, turned.end());
    }
    if (variation.is_triangular && turned.size() == 4) {
      add({turned[0], turned[1], turned[2]}, polygon);
      add({turned[0], turned[2], turned[3]}, polygon);
    } else {
      add(turned, polygon);
    }
  }
  result.name += describe(variation);
  return result;
}

}  // namespace radiosity::test
