#pragma once

#include <cstdint>
#include <vector>

#include "radiosity/occluders.h"
#include "radiosity/visible_fraction.h"

namespace radiosity {

/// Exchange area of a pair that something may block, m².
struct PairEstimate {
  double value = 0;
  double error = 0;                    ///< one sigma; 0 if `blocking` is a proof
  Blocking blocking = Blocking::some;  ///< none and all are proofs, some was sampled
  bool is_partial = false;             ///< samples disagree
  int rays = 0;
};

struct OccludedPairOptions {
  int max_rays = 64;               ///< for a pair whose samples disagree
  double thickness = 0;            ///< how far off a plane a point may be and count as on it, m
  double kernel_tolerance = 1e-9;  ///< relative error of the kernel where visibility is proved
};

/// Estimates the exchange area of a pair given all occluders that may block it. Blockers are first
/// proved away one by one. Distant pairs then go to rays. Of near pairs the larger polygon is
/// divided until the two are alike in size or distant, since the kernel varies too strongly over
/// it; what stays near is clipped exactly.
PairEstimate estimate_occluded_pair(const Visibility& visibility, const SampledPair& pair,
                                    std::vector<const Occluder*> candidates,
                                    const OccludedPairOptions& options, std::uint64_t seed);

}  // namespace radiosity
