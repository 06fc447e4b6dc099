#pragma once

#include <cstdint>
#include <vector>

#include "radiosity/compressed/compressed_blocks.h"

namespace radiosity {

/// CompressedBlocks as plain arrays, which a file can keep. Where the numbers of each node and
/// block are is left out: they follow each other.
struct StoredBlocks {
  std::vector<std::int32_t> nodes;      ///< n_nodes x 4: begin, end, left, right
  std::vector<std::uint8_t> functions;  ///< n_nodes x 6: those up to each degree, those used
  std::vector<float> numbers;
  std::vector<std::int32_t> far;      ///< n_far x 2: a, b
  std::vector<std::uint8_t> degrees;  ///< n_far x 2: of a, of b
  std::vector<float> far_errors;
  std::vector<float> coefficients;
  std::vector<std::int32_t> near;         ///< n_near x 2: a, b
  std::vector<std::uint8_t> near_change;  ///< n_near: whether it may change, 0 or 1
  std::vector<float> near_errors;
  std::vector<float> densities;
};

/// Widths of the tables.
inline constexpr std::size_t kNodeWidth = 4;
inline constexpr std::size_t kFunctionWidth = NestedBasis::kMostDegree + 2;

StoredBlocks store(const CompressedBlocks& blocks);

/// The blocks of a matrix of so many rows. Every index and size is checked, so that whatever the
/// arrays hold, products with the matrix are safe. Throws SolveError, telling what is wrong.
CompressedBlocks restore(StoredBlocks stored, Index n_rows);

}  // namespace radiosity
