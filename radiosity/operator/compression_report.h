#pragma once

namespace radiosity {

/// How a compressed operator was made, and what it is worth.
struct CompressionReport {
  /// What F B was found to be off by, for B = 1 and others: root of the mean square over all area,
  /// relative to that of F B. With 95 % confidence it is no more.
  double verified_error = 0;
  double estimated_error = 0;  ///< the same for B = 1 as the blocks' errors tell it
  long n_rows = 0;             ///< rows that were evaluated to verify it
  int n_rounds = 0;            ///< of refinement
  double coefficients = 0;     ///< per patch, numbers kept
  double entries = 0;          ///< per patch, form factors evaluated
};

}  // namespace radiosity
