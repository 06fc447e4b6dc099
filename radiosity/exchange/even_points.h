#pragma once

#include <cstdint>

#include "radiosity/exchange/pair_estimate.h"
#include "radiosity/exchange/shadowed_quadrature.h"

namespace radiosity {

/// The visible fraction of a pair from quasi-random points of the source, from each of which the
/// target without its shadows is exact: for pairs with shadows so near the source that no rule
/// settles. Takes points until the standard error is at most `tolerance`, or there are 16,384. The
/// error is what sixteen sequences, shifted at random by `seed`, disagree by; they are lattices of
/// the plastic number's powers (Roberts 2018), whose error falls nearly like 1 / n.
PairEstimate sample_evenly(const ShadowedPair& pair, double tolerance, std::uint64_t seed,
                           ShadowCutter& cutter);

}  // namespace radiosity
