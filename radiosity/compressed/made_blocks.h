#pragma once

#include <cstdint>
#include <vector>

#include "radiosity/compressed/compressed_blocks.h"
#include "radiosity/operator/census.h"

namespace radiosity {

/// What became of the pairs of patches, and what it took.
struct BlockCensus {
  std::int64_t samples = 0;       ///< entries evaluated for far blocks, some may block
  std::int64_t near_entries = 0;  ///< entries evaluated for near blocks
  BlockCensus& operator+=(const BlockCensus& other);
};

/// Blocks of a symmetric matrix of exchange areas.
struct MadeBlocks {
  std::vector<CompressedBlocks::Far> far;
  std::vector<float> coefficients;
  std::vector<CompressedBlocks::Near> near;
  std::vector<float> densities;
  BlockCensus census;
  Census pairs;
  void append(MadeBlocks&& other);
};

}  // namespace radiosity
