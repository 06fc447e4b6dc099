#include "radiosity/visible_fraction.h"

#include <array>
#include <cmath>
#include <vector>

#include "radiosity/exchange_area.h"
#include "radiosity/segment_bundle.h"
#include "radiosity/visible_polygon.h"

namespace radiosity {
namespace {

std::uint64_t mix(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31U);
}

/// Visible parts below this share of the whole are rounding.
constexpr double kWhole = 1e-9;

double uniform(std::uint64_t bits) { return static_cast<double>(bits >> 11U) * 0x1p-53; }

/// Sums over samples of the weight w and its visible part v.
struct Sums {
  double w = 0, v = 0, ww = 0, wv = 0, vv = 0;
  int n = 0;
  bool any_visible = false;
  bool any_hidden = false;

  void add(double weight, double visible) {
    w += weight;
    v += visible;
    ww += weight * weight;
    wv += weight * visible;
    vv += visible * visible;
    ++n;
  }
};

/// The ratio Σ v / Σ w with the standard error of a ratio of means. (Cochran 1977, section 6.4)
VisibleFraction evaluate(const Sums& sums) {
  VisibleFraction result;
  result.is_partial = sums.any_visible && sums.any_hidden && sums.w > 0;
  const double n = sums.n;
  if (!result.is_partial) {
    // Agreement is no proof: with a flat prior n agreeing samples leave about 1/n open (Laplace).
    result.value = sums.any_visible ? 1 : 0;
    result.error = 1 / (n + 2);
    return result;
  }
  result.value = sums.v / sums.w;
  const double squares =
      sums.vv - 2 * result.value * sums.wv + result.value * result.value * sums.ww;
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
  while (sums.n < max_rays) {
    const SegmentSampler::Packet packet = sampler.next();
    const std::uint32_t blocked = visibility.blocked(packet.from, packet.to, pair.i, pair.j);
    for (int k = 0; k < kPacket; ++k) {
      const bool is_free = (blocked >> k & 1U) == 0;
      sums.add(packet.weight[k], is_free ? packet.weight[k] : 0);
      (is_free ? sums.any_visible : sums.any_hidden) = true;
    }
    if (sums.n == kAgreed && sums.any_visible != sums.any_hidden) break;
  }
  VisibleFraction result = evaluate(sums);
  result.rays = sums.n;
  return result;
}

VisibleFraction sample_shadowed_fraction(const SampledPair& pair,
                                         std::span<const Blocker* const> blockers, double thickness,
                                         int n_points, std::uint64_t seed) {
  SegmentSampler sampler(pair, seed);
  // From the smaller one the other's form factor varies less.
  const bool from_i =
      vector_area(pair.polygon_i.points()).norm() <= vector_area(pair.polygon_j.points()).norm();
  const Vec3& normal = from_i ? pair.plane_i.normal : pair.plane_j.normal;
  const ConvexPolygon& target = from_i ? pair.polygon_j : pair.polygon_i;
  ShadowCutter cutter;
  std::vector<Shadow> shadows;
  const auto visible_from = [&](const Vec3& point, double whole) {
    const SegmentBundle bundle(std::span(&point, 1), target.points(), thickness);
    std::size_t n_shadows = 0;
    for (const Blocker* blocker : blockers) {
      if (shadows.size() <= n_shadows) shadows.resize(n_shadows + 1);
      shadows[n_shadows].clear();
      const Blocking blocking = bundle.test(*blocker, &shadows[n_shadows]).blocking;
      if (blocking == Blocking::all) return 0.0;
      if (blocking == Blocking::some) ++n_shadows;
    }
    return cutter.visible_part(point, normal, target, whole, {shadows.data(), n_shadows});
  };
  Sums sums;
  while (sums.n < n_points) {
    const SegmentSampler::Packet packet = sampler.next();
    for (int k = 0; k < SegmentSampler::kPacket; ++k) {
      const Vec3 point = (from_i ? packet.from[k] : packet.to[k]) - pair.origin;
      const double whole = facing_point_to_polygon(point, normal, target.points());
      const double visible = visible_from(point, whole);
      sums.add(whole, visible);
      sums.any_visible |= visible > kWhole * whole;
      sums.any_hidden |= visible < (1 - kWhole) * whole;
    }
  }
  return evaluate(sums);
}

}  // namespace radiosity
