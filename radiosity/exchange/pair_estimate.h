#pragma once

#include "radiosity/visibility/blocking.h"

namespace radiosity {

/// How much two polygons see of each other: the visible fraction ∫∫ K V / ∫∫ K in [0, 1] with
/// K = cosθ_i cosθ_j / (π r²), or the exchange area ∫∫ K V, m².
struct PairEstimate {
  double value = 0;
  double error = 0;                    ///< one sigma; 0 if `blocking` is a proof
  Blocking blocking = Blocking::some;  ///< none and all are proofs
  bool is_partial = false;             ///< found to be partly hidden
  int rays = 0;

  /// Of a fraction: the exchange area, given that of the pair unobstructed, m².
  [[nodiscard]] PairEstimate times(double whole) const {
    return {value * whole, error * whole, blocking, is_partial, rays};
  }
};

}  // namespace radiosity
