#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "radiosity/base/geometry.h"

namespace radiosity::test {

/// Numbers that do not depend on the standard library's distributions.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform(double low = 0, double high = 1) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  /// low to high, both included.
  int integer(int low, int high) {
    return low + static_cast<int>(engine_() % static_cast<std::uint64_t>(high - low + 1));
  }
  bool coin() { return integer(0, 1) == 1; }
  double log_uniform(double low, double high) { return low * std::pow(high / low, uniform()); }
  Vec3 vector(double low, double high) {
    const double x = uniform(low, high);
    const double y = uniform(low, high);
    return {x, y, uniform(low, high)};
  }
  Vec3 direction() {
    for (;;) {
      const Vec3 v = vector(-1, 1);
      if (v.squaredNorm() <= 1 && v.squaredNorm() > 0.01) return v.normalized();
    }
  }
  Eigen::Matrix3d rotation() {
    const Vec3 axis = direction();
    return Eigen::AngleAxisd(uniform(0, 2 * kPi), axis).toRotationMatrix();
  }
  template <class T>
  void shuffle(std::vector<T>& items) {
    for (std::size_t k = items.size(); k > 1; --k) {
      std::swap(items[k - 1], items[engine_() % k]);
    }
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace radiosity::test
