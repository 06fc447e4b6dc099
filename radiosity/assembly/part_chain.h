#pragma once

#include <span>
#include <vector>

#include "radiosity/assembly/tile_shares.h"
#include "radiosity/base/ranks.h"

namespace radiosity {

/// The sum of all ranks' parts, in their order, on every rank. `own` are this rank's, each with as
/// many values as `sum`. What has been summed goes from rank to rank in pieces, so that all add at
/// the same time, and from the last one to all: a rank sends and gets the values twice, whatever
/// the number of ranks.
void add_along_ranks(Ranks& ranks, const SumParts& parts, const std::vector<const double*>& own,
                     std::span<double> sum);

}  // namespace radiosity
