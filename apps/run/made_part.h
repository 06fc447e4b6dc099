#pragma once

#include <cstdint>

#include "radiosity/base/work_part.h"

namespace apps {

/// What `form-factors --part` has made.
struct MadePart {
  radiosity::WorkPart part;
  std::int64_t records = 0;  ///< tiles, or groups of blocks
  std::uint64_t bytes = 0;   ///< of these
  double seconds = 0;        ///< that it took
};

}  // namespace apps
