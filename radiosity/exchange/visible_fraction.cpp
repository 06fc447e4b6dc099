#include "radiosity/exchange/visible_fraction.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "radiosity/polygon/seen_polygon.h"

namespace radiosity {
namespace {

constexpr int kPacket = SegmentSampler::kPacket;
using Lanes = SegmentSampler::Lanes;

/// The standard error of n quasi-random points, as a share of that of random ones: kEven times
/// (kPacket / n)^kEvenness. Measured over partly hidden pairs of a furnished room and of many
/// boxes.
constexpr double kEven = 0.52;
constexpr double kEvenness = 0.15;
/// Blocks from which on their disagreement counts, and its share of the error of all samples if it
/// falls like n^-0.65: ⅛^(0.65 - 0.5).
constexpr std::size_t kFewestBlocks = 8;
constexpr double kOfBlocks = 0.73;
/// What n samples leave open, as a share of 1 / n, where they agree but for some.
constexpr double kOpen = 1;
/// The error falls like n to minus this.
constexpr double kPower = 0.65;
/// Samples grow at most so much before the error is estimated anew.
constexpr int kMostGrowth = 8;

std::uint64_t mix(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31U);
}

/// A dimension of Sobol's sequence.
struct SobolDimension {
  std::array<std::uint32_t, 32> direction;
  std::array<std::uint32_t, kPacket> first;  // points
};

/// From a primitive polynomial of a degree, its inner coefficients as bits, and so many odd numbers
/// to start with. (Bratley & Fox 1988; those of Joe & Kuo 2008)
constexpr SobolDimension make_sobol(unsigned degree, unsigned coefficients,
                                    std::array<std::uint32_t, 3> start) {
  SobolDimension result{};
  auto& direction = result.direction;
  for (unsigned k = 0; k < 32; ++k) {
    if (degree == 0) {
      direction[k] = 1U << (31 - k);
    } else if (k < degree) {
      direction[k] = start[k] << (31 - k);
    } else {
      direction[k] = direction[k - degree] ^ (direction[k - degree] >> degree);
      for (unsigned m = 1; m < degree; ++m) {
        if ((coefficients >> (degree - 1 - m) & 1U) != 0) direction[k] ^= direction[k - m];
      }
    }
  }
  for (unsigned k = 0; k < kPacket; ++k) {
    for (unsigned bit = 0; bit < 4; ++bit) {
      if ((k >> bit & 1U) != 0) result.first[k] ^= direction[bit];
    }
  }
  return result;
}

constexpr std::array<SobolDimension, 4> kSobol{make_sobol(0, 0, {}), make_sobol(1, 0, {1}),
                                               make_sobol(2, 1, {1, 3}),
                                               make_sobol(3, 1, {1, 3, 1})};

/// Samples in all that get the error down to what is asked.
int samples_for(const PairEstimate& fraction, const RayEffort& effort) {
  const double power = fraction.is_partial ? 1 / kPower : 1;
  const double growth =
      std::min<double>(kMostGrowth, std::pow(fraction.error / effort.error, power));
  const double packets = std::ceil(growth * fraction.rays / kPacket);
  return std::min(effort.most_rays, kPacket * static_cast<int>(packets));
}

}  // namespace

SegmentSampler::Fan::Fan(const ConvexPolygon& polygon, const HalfSpace& other) {
  const Vec3& origin = polygon[0];
  corner_height = static_cast<float>(other.normal.dot(origin) - other.offset);
  for (int axis = 0; axis < 3; ++axis) corner[axis] = static_cast<float>(origin[axis]);
  const auto set_edge = [&](const Vec3& end, std::size_t k,
                            std::array<std::array<float, kMost>, 3>& edge,
                            std::array<float, kMost>& height) {
    const Vec3 way = end - origin;
    for (int axis = 0; axis < 3; ++axis) edge[axis][k] = static_cast<float>(way[axis]);
    height[k] = static_cast<float>(other.normal.dot(way));
  };
  constexpr double kSame = 1e-6;
  n_triangles = static_cast<int>(polygon.size()) - 2;
  if (polygon.size() == 4) {
    const Vec3 diagonal = polygon[2] - polygon[0];
    const Vec3 sides = polygon[1] + polygon[3] - 2 * polygon[0];
    if ((diagonal - sides).squaredNorm() < kSame * kSame * diagonal.squaredNorm()) {
      n_triangles = 0;
      set_edge(polygon[1], 0, first, first_height);
      set_edge(polygon[3], 0, second, second_height);
      return;
    }
  }
  double total = 0;
  std::array<double, kMost> area;
  for (int k = 0; k < n_triangles; ++k) {
    set_edge(polygon[k + 1], k, first, first_height);
    set_edge(polygon[k + 2], k, second, second_height);
    area[k] = (polygon[k + 1] - origin).cross(polygon[k + 2] - origin).norm();
    total += area[k];
  }
  double sum = 0;
  for (int k = 0; k < n_triangles; ++k) {
    sum += area[k];
    cumulative[k] = static_cast<float>(sum / total);
  }
}

SegmentSampler::SegmentSampler(const SampledPair& pair, std::uint64_t seed, Sampling sampling)
    : pair_(pair),
      sampling_(sampling),
      from_i_(vector_area(pair.polygon_i.points()).squaredNorm() <=
              vector_area(pair.polygon_j.points()).squaredNorm()),
      fan_i_(pair.polygon_i, pair.plane_j),
      fan_j_(pair.polygon_j, pair.plane_i),
      scale_(static_cast<float>(1 / (pair.polygon_i[1] - pair.polygon_j[0]).norm())) {
  for (std::size_t k = 0; k < shift_.size(); k += 2) {
    seed = mix(seed);
    shift_[k] = static_cast<std::uint32_t>(seed >> 32U);
    shift_[k + 1] = static_cast<std::uint32_t>(seed);
  }
}

__attribute__((target_clones("arch=x86-64-v3", "default"))) void SegmentSampler::place(
    const Fan& fan, const Lanes& u, const Lanes& v, std::array<Lanes, 3>& points, Lanes& heights) {
  if (fan.n_triangles == 0) {
    for (int k = 0; k < kPacket; ++k) {
      points[0][k] = fan.corner[0] + u[k] * fan.first[0][0] + v[k] * fan.second[0][0];
      points[1][k] = fan.corner[1] + u[k] * fan.first[1][0] + v[k] * fan.second[1][0];
      points[2][k] = fan.corner[2] + u[k] * fan.first[2][0] + v[k] * fan.second[2][0];
      heights[k] = fan.corner_height + u[k] * fan.first_height[0] + v[k] * fan.second_height[0];
    }
    return;
  }
  alignas(64) Lanes along_first;
  alignas(64) Lanes along_second;
  float before = 0;
  for (int t = 0; t < fan.n_triangles; ++t) {
    // Each triangle takes the places above the last one's; what it gets wrong the next ones mend.
    const float inverse = 1 / std::max(fan.cumulative[t] - before, 1e-30F);
    for (int k = 0; k < kPacket; ++k) {
      const float root = std::sqrt(std::min(std::max((u[k] - before) * inverse, 0.0F), 1.0F));
      along_first[k] = root * (1 - v[k]);
      along_second[k] = root * v[k];
    }
    for (int k = 0; k < kPacket; ++k) {
      const bool is_here = t == 0 || u[k] >= before;
      const float x =
          fan.corner[0] + along_first[k] * fan.first[0][t] + along_second[k] * fan.second[0][t];
      const float y =
          fan.corner[1] + along_first[k] * fan.first[1][t] + along_second[k] * fan.second[1][t];
      const float z =
          fan.corner[2] + along_first[k] * fan.first[2][t] + along_second[k] * fan.second[2][t];
      const float height = fan.corner_height + along_first[k] * fan.first_height[t] +
                           along_second[k] * fan.second_height[t];
      points[0][k] = is_here ? x : points[0][k];
      points[1][k] = is_here ? y : points[1][k];
      points[2][k] = is_here ? z : points[2][k];
      heights[k] = is_here ? height : heights[k];
    }
    before = fan.cumulative[t];
  }
}

__attribute__((target_clones("arch=x86-64-v3", "default"))) void SegmentSampler::weigh(
    const Lanes& height_i, const Lanes& height_j, float scale, Packet& packet) {
  const SegmentPacket& segments = packet.segments;
  for (int k = 0; k < kPacket; ++k) {
    const float x = (segments.to[0][k] - segments.from[0][k]) * scale;
    const float y = (segments.to[1][k] - segments.from[1][k]) * scale;
    const float z = (segments.to[2][k] - segments.from[2][k]) * scale;
    const float square = x * x + y * y + z * z;
    const float kernel = (height_i[k] * scale) * (height_j[k] * scale) / (square * square);
    packet.weight[k] = kernel > 0 ? kernel : 0;
  }
}

void SegmentSampler::aim(const std::array<Lanes, 4>& at) {
  const ConvexPolygon& target = from_i_ ? pair_.polygon_j : pair_.polygon_i;
  const Vec3& normal = from_i_ ? pair_.plane_i.normal : pair_.plane_j.normal;
  const HalfSpace& plane = from_i_ ? pair_.plane_j : pair_.plane_i;
  auto& from = from_i_ ? packet_.segments.from : packet_.segments.to;
  auto& to = from_i_ ? packet_.segments.to : packet_.segments.from;
  alignas(64) Lanes heights;
  place(from_i_ ? fan_i_ : fan_j_, at[0], at[1], from, heights);
  for (int k = 0; k < kPacket; ++k) {
    const Vec3 point(from[0][k], from[1][k], from[2][k]);
    const SeenPolygon seen(point, target);
    const Vec3 way = seen.direction(at[2][k], at[3][k]);
    double farthest = 0;
    for (const Vec3& corner : target) {
      farthest = std::max(farthest, (corner - point).squaredNorm());
    }
    const double fall = plane.normal.dot(way);
    const double distance = (plane.offset - plane.normal.dot(point)) / fall;
    const bool is_met = fall < 0 && distance >= 0;
    const Vec3 end = point + (is_met ? std::min(distance, std::sqrt(farthest)) : 0) * way;
    for (int axis = 0; axis < 3; ++axis) to[axis][k] = static_cast<float>(end[axis]);
    const double weight = is_met ? normal.dot(way) * seen.solid_angle() : 0;
    packet_.weight[k] = static_cast<float>(std::max(weight, 0.0));
  }
}

const SegmentSampler::Packet& SegmentSampler::next() {
  // A packet's points differ in the last four bits of their number alone.
  alignas(64) std::array<Lanes, 4> at;
  for (std::size_t axis = 0; axis < 4; ++axis) {
    std::uint32_t start = shift_[axis];
    for (unsigned bit = 4; bit < 32 && n_drawn_ >> bit != 0; ++bit) {
      if ((n_drawn_ >> bit & 1U) != 0) start ^= kSobol[axis].direction[bit];
    }
    for (unsigned k = 0; k < kPacket; ++k) {
      const std::uint32_t bits = start ^ kSobol[axis].first[k];
      at[axis][k] = static_cast<float>(static_cast<std::int32_t>(bits >> 8U)) * 0x1p-24F;
    }
  }
  n_drawn_ += kPacket;
  if (sampling_ == Sampling::directions) {
    aim(at);
    return packet_;
  }
  alignas(64) Lanes height_of_i;
  alignas(64) Lanes height_of_j;
  place(fan_i_, at[0], at[1], packet_.segments.from, height_of_i);
  place(fan_j_, at[2], at[3], packet_.segments.to, height_of_j);
  weigh(height_of_i, height_of_j, scale_, packet_);
  return packet_;
}

std::uint64_t pair_seed(std::uint64_t seed, std::int32_t i, std::int32_t j) {
  return mix(mix(seed) ^ (static_cast<std::uint64_t>(static_cast<std::uint32_t>(i)) << 32U |
                          static_cast<std::uint32_t>(j)));
}

void FractionSampler::Sums::add(const Lanes& weight, std::uint32_t blocked) {
  float packet_w = 0;
  float packet_v = 0;
  float packet_ww = 0;
  float packet_vv = 0;
  for (unsigned k = 0; k < kPacket; ++k) {
    const float free = (blocked >> k & 1U) == 0 ? weight[k] : 0.0F;
    packet_w += weight[k];
    packet_v += free;
    packet_ww += weight[k] * weight[k];
    packet_vv += free * free;
  }
  w += packet_w;
  v += packet_v;
  ww += packet_ww;
  vv += packet_vv;
  n += kPacket;
  constexpr std::uint32_t kAll = (1U << kPacket) - 1;
  any_visible |= blocked != kAll;
  any_hidden |= blocked != 0;
}

/// The ratio Σ v / Σ w with the standard error of a ratio of means. (Cochran 1977, section 6.4)
PairEstimate FractionSampler::Sums::evaluate() const {
  PairEstimate result;
  result.is_partial = any_visible && any_hidden && w > 0;
  result.rays = n;
  const double n_samples = n;
  if (!result.is_partial) {
    // Agreement is no proof: with a flat prior n agreeing samples leave about 1/n open (Laplace),
    // of uneven weights as many as even ones would have to be for the same variance (Kish 1965).
    result.value = any_visible ? 1 : 0;
    result.error = 1 / ((ww > 0 ? w * w / ww : 0) + 2);
    return result;
  }
  result.value = v / w;
  // Few samples may disagree by chance, or by ones of little weight only: one more of either kind
  // is taken into account (Agresti & Coull 1998), and as much left open as if they agreed.
  const double mean = w / n_samples;
  const double all = w + 2 * mean;
  const double share = (v + mean) / all;
  const double squares =
      (1 - 2 * share) * (vv + mean * mean) + share * share * (ww + 2 * mean * mean);
  const double of_random =
      std::sqrt(std::max(squares, 0.0) * (n_samples + 2) / (n_samples + 1)) / all;
  result.error = std::hypot(kEven * std::pow(kPacket / n_samples, kEvenness) * of_random,
                            kOpen / (n_samples + 2));
  return result;
}

void FractionSampler::Blocks::add(double packet_w, double packet_v) {
  if (n_full_ == kMost) {
    for (std::size_t k = 0; k < kMost; ++k) {
      const double both_w = k < kMost / 2 ? w_[2 * k] + w_[2 * k + 1] : 0;
      const double both_v = k < kMost / 2 ? v_[2 * k] + v_[2 * k + 1] : 0;
      w_[k] = both_w;
      v_[k] = both_v;
    }
    n_full_ = kMost / 2;
    packets_of_block_ *= 2;
  }
  w_[n_full_] += packet_w;
  v_[n_full_] += packet_v;
  if (++packets_of_last_ < packets_of_block_) return;
  packets_of_last_ = 0;
  ++n_full_;
}

std::optional<double> FractionSampler::Blocks::error(double share, double w) const {
  if (n_full_ < kFewestBlocks) return std::nullopt;
  double squares = 0;
  double used = 0;
  for (std::size_t k = 0; k < n_full_; ++k) {
    squares += square(v_[k] - share * w_[k]);
    used += w_[k];
  }
  const auto n = static_cast<double>(n_full_);
  return used > 0 ? std::optional(std::sqrt(squares * n / (n - 1) / (used * w))) : std::nullopt;
}

void FractionSampler::sample() {
  const SegmentSampler::Packet& packet = sampler_.next();
  const double w = sums_.w;
  const double v = sums_.v;
  sums_.add(packet.weight, visibility_.blocked(packet.segments, pair_.i, pair_.j));
  blocks_.add(sums_.w - w, sums_.v - v);
}

PairEstimate FractionSampler::evaluate() const {
  PairEstimate result = sums_.evaluate();
  if (!result.is_partial) return result;
  // Where there are more shadows than samples can resolve they gain nothing by being even.
  if (const auto of_blocks = blocks_.error(result.value, sums_.w)) {
    result.error = std::sqrt(0.5 * (square(result.error) + square(kOfBlocks * *of_blocks)));
  }
  return result;
}

PairEstimate FractionSampler::add_packet() {
  sample();
  return evaluate();
}

PairEstimate FractionSampler::add_packets(const RayEffort& effort) {
  PairEstimate result = evaluate();
  while (result.error > effort.error) {
    const int n_samples = samples_for(result, effort);
    if (n_samples <= sums_.n) break;
    while (sums_.n < n_samples) sample();
    result = evaluate();
  }
  return result;
}

PairEstimate sample_visible_fraction(const Visibility& visibility, const SampledPair& pair,
                                     const RayEffort& effort, std::uint64_t seed,
                                     Sampling sampling) {
  FractionSampler sampler(visibility, pair, seed, sampling);
  sampler.add_packet();
  return sampler.add_packets(effort);
}

}  // namespace radiosity
