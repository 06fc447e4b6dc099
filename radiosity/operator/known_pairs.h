#pragma once

#include <cstdint>
#include <span>

#include "radiosity/operator/transport.h"

namespace radiosity {

/// Exchange areas that need not be computed again: those between patches of an earlier mesh.
struct KnownPairs {
  const Transport* transport = nullptr;      ///< of the earlier mesh; none = nothing is known
  std::span<const std::int32_t> patch = {};  ///< per patch: the same one there, or -1
};

}  // namespace radiosity
