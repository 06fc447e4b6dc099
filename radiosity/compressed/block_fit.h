#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "radiosity/compressed/cluster_polynomials.h"
#include "radiosity/compressed/compressed_blocks.h"

namespace radiosity {

/// The density of exchange between two patches, G_ij / (A_i A_j), 1/m².
struct DensitySample {
  std::int32_t row = 0;  ///< places in the tree's order, of either cluster
  std::int32_t column = 0;
  double density = 0;
  double weight = 1;  ///< A_i A_j over the density of samples, up to a constant
};

/// A polynomial fitted to the densities between two clusters.
struct BlockFit {
  std::vector<double> coefficients;  ///< as CompressedBlocks::Far has them
  double error = 0;                  ///< what samples are off by, root of the mean square, 1/m²
  double lowest = 0;                 ///< least value at a sample, 1/m²
};

/// `order` is the tree's. Fits by weighted least squares; the error allows for the freedom that the
/// fit has, unless the samples are all pairs there are.
BlockFit fit_block(const ClusterPolynomials& polynomials, const std::vector<std::int32_t>& order,
                   std::int32_t a, std::int32_t b, DegreePair degrees,
                   std::span<const DensitySample> samples, bool are_all);

/// Coefficients of such a fit.
int n_coefficients(const ClusterPolynomials& polynomials, std::int32_t a, std::int32_t b,
                   int degree);

}  // namespace radiosity
