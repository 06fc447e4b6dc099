#pragma once

#include "radiosity/exchange/pair_blockers.h"
#include "radiosity/exchange/pair_view.h"
#include "radiosity/exchange/visible_fraction.h"

namespace radiosity {

/// What finds the visible part of a pair that is neither proved visible nor hidden.
enum class PairMethod {
  rays,    ///< segments between quasi-random points
  cuts,    ///< shadows cut out of the target, integrated over pieces that the shadows' events bound
  points,  ///< the same from points of the source that is divided until quarters agree
};

/// Rays at most, 10 ms of them.
inline constexpr int kMostPackets = 4096;
inline constexpr int kMostRays = SegmentSampler::kPacket * kMostPackets;

/// Whether rays for such a standard error of the visible share cost less than looking for proofs.
bool are_rays_cheap(double error);

/// Whether cuts need rules that go on until they agree: low ones won't do.
bool needs_adaption(const PairView& view, const PairBlockers& between, double error);

/// The method that is expected to get soonest to a standard error of the visible share. What each
/// costs was measured. `takes_rays`: they see something between polygons so close.
PairMethod choose_method(const PairView& view, const PairBlockers& between, double error,
                         bool takes_rays);

}  // namespace radiosity
