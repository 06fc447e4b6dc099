#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "radiosity/base/progress.h"
#include "radiosity/base/ranks.h"
#include "radiosity/compressed/block_store.h"
#include "radiosity/compressed/made_blocks.h"

namespace radiosity {

/// Makes the parts of a round that no rank has yet: each on one rank, by make(number), on many
/// threads at once; all ranks call this together and get all parts. The first rank's `store` (null
/// on the others, or if there is none) has some of them already, perhaps, and then has all.
std::vector<MadeBlocks> make_shared_parts(Ranks& ranks, std::size_t n_parts, BlockStore* store,
                                          const std::function<MadeBlocks(std::size_t)>& make,
                                          const Progress& progress);

}  // namespace radiosity
