#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "radiosity/exchange/pair_estimate.h"
#include "radiosity/polygon/convex_polygon.h"
#include "radiosity/visibility/half_space.h"
#include "radiosity/visibility/visibility.h"

namespace radiosity {

/// A pair of patches as a visibility estimate sees it.
struct SampledPair {
  const ConvexPolygon& polygon_i;  ///< the part in front of j, relative to Visibility::center()
  const HalfSpace& plane_i;
  const ConvexPolygon& polygon_j;  ///< the part in front of i, relative to Visibility::center()
  const HalfSpace& plane_j;
  std::int32_t i;  ///< patches, for Visibility
  std::int32_t j;
};

/// What quasi-random segments are even in.
enum class Sampling {
  areas,       ///< of both polygons: cheap, in single precision
  directions,  ///< from points of the smaller polygon: no peaks where polygons are close or touch
};

/// Quasi-random segments between the polygons of a pair: Sobol's sequence in four dimensions, its
/// digits shifted at random by `seed`. Works on a packet at a time.
class SegmentSampler {
 public:
  static constexpr int kPacket = Visibility::kPacket;
  using Lanes = SegmentPacket::Lanes;

  /// The polygons may not change while segments are drawn.
  SegmentSampler(const SampledPair& pair, std::uint64_t seed, Sampling sampling = Sampling::areas);

  /// Segments and their weights: the kernel cosθ_i cosθ_j / r² over their density, up to a
  /// constant.
  struct Packet {
    SegmentPacket segments;
    alignas(64) Lanes weight;
  };
  const Packet& next();

 private:
  /// Maps the unit square to points of equal density on a convex polygon: a parallelogram as it is,
  /// others by a fan of triangles. Heights are above the plane of the other polygon.
  struct Fan {
    Fan(const ConvexPolygon& polygon, const HalfSpace& other);
    static constexpr std::size_t kMost = ConvexPolygon::kCapacity - 2;
    std::array<float, 3> corner;  // of all triangles
    float corner_height;
    std::array<std::array<float, kMost>, 3> first;  // edges from there
    std::array<std::array<float, kMost>, 3> second;
    std::array<float, kMost> first_height;
    std::array<float, kMost> second_height;
    std::array<float, kMost> cumulative;  // share of the area up to and with a triangle
    int n_triangles;                      // 0: a parallelogram
  };
  static void place(const Fan& fan, const Lanes& u, const Lanes& v, std::array<Lanes, 3>& points,
                    Lanes& heights);
  static void weigh(const Lanes& height_i, const Lanes& height_j, float scale, Packet& packet);
  void aim(const std::array<Lanes, 4>& at);

  const SampledPair& pair_;
  Sampling sampling_;
  bool from_i_;  // whether that polygon is the smaller one
  Fan fan_i_;
  Fan fan_j_;
  float scale_;  // of lengths, so that weights are near 1, 1/m
  std::uint32_t n_drawn_ = 0;
  std::array<std::uint32_t, 4> shift_{};  // fractions of 2³², by exclusive or
  Packet packet_;
};

/// How far samples go.
struct RayEffort {
  double error = 0;    ///< standard error of the fraction to get to
  int most_rays = 16;  ///< a multiple of the packets' size
};

/// Estimates the visible fraction of a pair from packets of segments between quasi-random points,
/// shifted at random by `seed` (which should depend on the pair). Partial if samples disagree.
class FractionSampler {
 public:
  FractionSampler(const Visibility& visibility, const SampledPair& pair, std::uint64_t seed,
                  Sampling sampling = Sampling::areas)
      : visibility_(visibility), pair_(pair), sampler_(pair, seed, sampling) {}

  /// What one packet more gives, together with those before.
  PairEstimate add_packet();
  /// As many packets more as the samples' disagreement and the error asked call for.
  PairEstimate add_packets(const RayEffort& effort);

 private:
  /// Sums over samples of the weight w and its visible part v, which is w or 0.
  struct Sums {
    double w = 0, v = 0, ww = 0, vv = 0;
    int n = 0;
    bool any_visible = false;
    bool any_hidden = false;
    void add(const SegmentSampler::Lanes& weight, std::uint32_t blocked);
    [[nodiscard]] PairEstimate evaluate() const;
  };
  /// The samples in a row of blocks of equal size, whose disagreement tells how much is gained by
  /// their evenness.
  class Blocks {
   public:
    void add(double packet_w, double packet_v);
    /// Standard error of the ratio of all, if there are enough.
    [[nodiscard]] std::optional<double> error(double share, double w) const;

   private:
    static constexpr std::size_t kMost = 16;
    std::array<double, kMost> w_{};
    std::array<double, kMost> v_{};
    std::size_t n_full_ = 0;
    int packets_of_block_ = 1;
    int packets_of_last_ = 0;
  };
  void sample();
  [[nodiscard]] PairEstimate evaluate() const;

  const Visibility& visibility_;
  const SampledPair& pair_;
  SegmentSampler sampler_;
  Sums sums_;
  Blocks blocks_;
};

/// The same in one go: a packet first, then as many as it takes.
PairEstimate sample_visible_fraction(const Visibility& visibility, const SampledPair& pair,
                                     const RayEffort& effort, std::uint64_t seed,
                                     Sampling sampling = Sampling::areas);

/// A seed for a pair from the run's seed. (SplitMix64, Steele et al. 2014)
std::uint64_t pair_seed(std::uint64_t seed, std::int32_t i, std::int32_t j);

}  // namespace radiosity
