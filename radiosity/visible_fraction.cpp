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

SegmentSampler::Fan::Fan(const ConvexPolygon& convex) : polygon(convex) {
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    total += (polygon[k - 1] - polygon[0]).cross(polygon[k] - polygon[0]).norm();
    cumulative[k] = total;
  }
}

Vec3 SegmentSampler::Fan::point(double u, double v) const {
  const double place = u * total;
  std::size_t k = 2;
  while (k + 1 < polygon.size() && place >= cumulative[k]) ++k;
  const double before = k > 2 ? cumulative[k - 1] : 0;
  const double root = std::sqrt((place - before) / (cumulative[k] - before));
  return polygon[0] + root * (1 - v) * (polygon[k - 1] - polygon[0]) +
         root * v * (polygon[k] - polygon[0]);
}

SegmentSampler::SegmentSampler(const SampledPair& pair, std::uint64_t seed)
    : pair_(pair), fan_i_(pair.polygon_i), fan_j_(pair.polygon_j) {
  for (double& value : state_) value = uniform(seed = mix(seed));
}

SegmentSampler::Packet SegmentSampler::next() {
  // Powers of 1/φ₄, where φ₄ is the root of x⁵ = x + 1.
  static constexpr std::array kStep{0.8566748838545029, 0.733891856627126, 0.6287067210378086,
                                    0.53859725722361};
  Packet packet;
  for (int k = 0; k < kPacket; ++k) {
    for (int axis = 0; axis < 4; ++axis) {
      state_[axis] += kStep[axis];
      if (state_[axis] >= 1) state_[axis] -= 1;
    }
    const Vec3 x = fan_i_.point(state_[0], state_[1]);
    const Vec3 y = fan_j_.point(state_[2], state_[3]);
    const double square = (y - x).squaredNorm();
    const double height_i = pair_.plane_i.normal.dot(y) - pair_.plane_i.offset;
    const double height_j = pair_.plane_j.normal.dot(x) - pair_.plane_j.offset;
    packet.weight[k] = std::max(0.0, height_i * height_j / (square * square));
    packet.from[k] = x + pair_.origin;
    packet.to[k] = y + pair_.origin;
  }
  return packet;
}

std::uint64_t pair_seed(std::uint64_t seed, std::int32_t i, std::int32_t j) {
  return mix(mix(seed) ^ (static_cast<std::uint64_t>(static_cast<std::uint32_t>(i)) << 32U |
                          static_cast<std::uint32_t>(j)));
}

VisibleFraction sample_visible_fraction(const Visibility& visibility, const SampledPair& pair,
                                        int max_rays, std::uint64_t seed) {
  constexpr int kPacket = SegmentSampler::kPacket;
  constexpr int kAgreed = 2 * kPacket;
  SegmentSampler sampler(pair, seed);
  Sums sums;
  while (sums.rays < max_rays) {
    const SegmentSampler::Packet packet = sampler.next();
    const std::uint32_t blocked = visibility.blocked(packet.from, packet.to, pair.i, pair.j);
    for (int k = 0; k < kPacket; ++k) {
      const double weight = packet.weight[k];
      const bool is_free = (blocked >> k & 1U) == 0;
      sums.w += weight;
      sums.ww += weight * weight;
      if (is_free) {
        sums.wv += weight;
        sums.wwv += weight * weight;
        ++sums.free;
      }
    }
    sums.rays += kPacket;
    if (sums.rays == kAgreed && (sums.free == 0 || sums.free == sums.rays)) break;
  }
  return evaluate(sums);
}

}  // namespace radiosity
