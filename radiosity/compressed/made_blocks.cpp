#include "radiosity/compressed/made_blocks.h"

namespace radiosity {

BlockCensus& BlockCensus::operator+=(const BlockCensus& other) {
  samples += other.samples;
  near_entries += other.near_entries;
  return *this;
}

void MadeBlocks::append(MadeBlocks&& other) {
  const std::uint64_t first_coefficient = coefficients.size();
  const std::uint64_t first_density = densities.size();
  for (CompressedBlocks::Far& block : other.far) block.first += first_coefficient;
  for (CompressedBlocks::Near& block : other.near) block.first += first_density;
  far.insert(far.end(), other.far.begin(), other.far.end());
  near.insert(near.end(), other.near.begin(), other.near.end());
  coefficients.insert(coefficients.end(), other.coefficients.begin(), other.coefficients.end());
  densities.insert(densities.end(), other.densities.begin(), other.densities.end());
  census += other.census;
  pairs += other.pairs;
  other = {};
}

}  // namespace radiosity
