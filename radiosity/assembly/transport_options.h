#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "radiosity/base/progress.h"
#include "radiosity/operator/transport.h"

namespace radiosity {

/// Whether the surfaces enclose the space that they light.
enum class Closed {
  no,        ///< light may escape; nothing is corrected
  yes,       ///< row sums are 1; small sampling errors are corrected symmetrically
  automatic  ///< found out from the form factors
};

/// Exchange areas that need not be computed again: those between patches of an earlier mesh.
struct KnownPairs {
  const Transport* transport = nullptr;      ///< of the earlier mesh; none = nothing is known
  std::span<const std::int32_t> patch = {};  ///< per patch: the same one there, or -1
};

struct TransportOptions {
  double tolerance = 1e-2;            ///< relative error asked of the form factors, > 0
  Closed closed = Closed::automatic;  ///< whether all row sums must be 1
  std::uint64_t seed = 0;             ///< of the visibility samples
  std::size_t memory = 0;  ///< bytes the operator may take; 0 = what the machine has available
  KnownPairs known = {};   ///< from an operator that was not corrected to be closed
  Progress progress{};
};

}  // namespace radiosity
