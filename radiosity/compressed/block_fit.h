#pragma once

#include <Eigen/Core>
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

/// Fits polynomials to samples between clusters, pair by pair.
class BlockFitter {
 public:
  /// `order` is the tree's. Both must outlive this.
  BlockFitter(const ClusterPolynomials& polynomials, const std::vector<std::int32_t>& order)
      : polynomials_(polynomials), order_(order) {}

  /// What follows is about clusters a and b, and polynomials of at most a degree in either.
  void start(std::int32_t a, std::int32_t b, int most_degree);
  /// By weighted least squares. The error allows for the freedom that the fit has, unless the
  /// samples are all pairs there are. Those of the last fit must be the first of them, or all
  /// pairs take their place.
  [[nodiscard]] BlockFit fit(DegreePair degrees, std::span<const DensitySample> samples,
                             bool are_all);

 private:
  void evaluate(std::span<const DensitySample> samples);
  [[nodiscard]] Eigen::VectorXd least_squares(DegreePair degrees, const Eigen::VectorXd& wanted,
                                              const Eigen::VectorXd& roots, double total);

  const ClusterPolynomials& polynomials_;
  const std::vector<std::int32_t>& order_;
  std::int32_t a_ = 0;
  std::int32_t b_ = 0;
  int most_degree_ = 0;
  bool had_all_ = false;
  std::vector<double> of_a_;  // by sample: the polynomials' values there
  std::vector<double> of_b_;
  Eigen::MatrixXd functions_;  // products of these, by the roots of the weights
};

}  // namespace radiosity
