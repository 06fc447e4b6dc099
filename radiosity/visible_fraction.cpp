#include "radiosity/visible_fraction.h"

#include <array>
#include <cmath>

namespace radiosity {
namespace {

std::uint64_t mix(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31U);
}

double uniform(std::uint64_t bits) { return static_cast<double>(bits >> 11U) * 0x1p-53; }

/// Points of the additive recurrence with the generalised golden ratio of four dimensions (the
/// root of x⁵ = x + 1), which fill the cube evenly at every length. (Roberts 2018)
class Sequence4 {
 public:
  explicit Sequence4(std::uint64_t seed) {
    for (double& value : state_) value = uniform(seed = mix(seed));
  }
  const std::array<double, 4>& next() {
    static constexpr std::array kStep{0.8566748838545029, 0.733891856627126, 0.6287067210378086,
                                      0.53859725722361};
    for (int k = 0; k < 4; ++k) {
      state_[k] += kStep[k];
      if (state_[k] >= 1) state_[k] -= 1;
    }
    return state_;
  }

 private:
  std::array<double, 4> state_{};
};

/// Maps the unit square to points of equal density on a convex polygon, by a fan of triangles.
class PolygonSampler {
 public:
  explicit PolygonSampler(const ConvexPolygon& polygon) : polygon_(polygon) {
    for (std::size_t k = 2; k < polygon.size(); ++k) {
      total_ += (polygon[k - 1] - polygon[0]).cross(polygon[k] - polygon[0]).norm();
      cumulative_[k] = total_;
    }
  }
  [[nodiscard]] Vec3 point(double u, double v) const {
    const double place = u * total_;
    std::size_t k = 2;
    while (k + 1 < polygon_.size() && place >= cumulative_[k]) ++k;
    const double before = k > 2 ? cumulative_[k - 1] : 0;
    const double rest = (place - before) / (cumulative_[k] - before);
    const double root = std::sqrt(rest);
    return polygon_[0] + root * (1 - v) * (polygon_[k - 1] - polygon_[0]) +
           root * v * (polygon_[k] - polygon_[0]);
  }

 private:
  const ConvexPolygon& polygon_;
  std::array<double, ConvexPolygon::kCapacity> cumulative_{};
  double total_ = 0;
};

/// Sums over the samples drawn so far, w the kernel and v whether the segment is free.
struct Sums {
  double w = 0, wv = 0, ww = 0, wwv = 0;
  int rays = 0;
  int free = 0;
};

VisibleFraction evaluate(const Sums& sums) {
  VisibleFraction result;
  result.rays = sums.rays;
  result.is_partial = sums.free > 0 && sums.free < sums.rays;
  const double n = sums.rays;
  if (!result.is_partial) {
    // Agreement is no proof: with a flat prior n agreeing samples leave about 1/n open (Laplace).
    result.value = sums.free > 0 ? 1 : 0;
    result.error = 1 / (n + 2);
    return result;
  }
  result.value = sums.wv / sums.w;
  const double squares = sums.wwv * (1 - 2 * result.value) + sums.ww * result.value * result.value;
  result.error = std::sqrt(std::max(squares, 0.0) * n / (n - 1)) / sums.w;
  return result;
}

}  // namespace

std::uint64_t pair_seed(std::uint64_t seed, std::int32_t i, std::int32_t j) {
  return mix(mix(seed) ^ (static_cast<std::uint64_t>(static_cast<std::uint32_t>(i)) << 32U |
                          static_cast<std::uint32_t>(j)));
}

VisibleFraction sample_visible_fraction(const Visibility& visibility, const SampledPair& pair,
                                        int max_rays, std::uint64_t seed) {
  constexpr int kPacket = Visibility::kPacket;
  constexpr int kAgreed = 2 * kPacket;
  Sequence4 sequence(seed);
  const PolygonSampler sampler_i(pair.polygon_i);
  const PolygonSampler sampler_j(pair.polygon_j);
  Sums sums;
  while (sums.rays < max_rays) {
    std::array<Vec3, kPacket> from;
    std::array<Vec3, kPacket> to;
    std::array<double, kPacket> weight;
    for (int k = 0; k < kPacket; ++k) {
      const auto& u = sequence.next();
      const Vec3 x = sampler_i.point(u[0], u[1]);
      const Vec3 y = sampler_j.point(u[2], u[3]);
      const double square = (y - x).squaredNorm();
      const double height_i = pair.plane_i.normal.dot(y) - pair.plane_i.offset;
      const double height_j = pair.plane_j.normal.dot(x) - pair.plane_j.offset;
      weight[k] = std::max(0.0, height_i * height_j / (square * square));
      from[k] = x + pair.origin;
      to[k] = y + pair.origin;
    }
    const std::uint32_t blocked = visibility.blocked(from, to, pair.i, pair.j);
    for (int k = 0; k < kPacket; ++k) {
      const bool is_free = (blocked >> k & 1U) == 0;
      sums.w += weight[k];
      sums.ww += weight[k] * weight[k];
      if (is_free) {
        sums.wv += weight[k];
        sums.wwv += weight[k] * weight[k];
        ++sums.free;
      }
    }
    sums.rays += kPacket;
    if (sums.rays == kAgreed && (sums.free == 0 || sums.free == sums.rays)) break;
  }
  return evaluate(sums);
}

}  // namespace radiosity
