#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "radiosity/base/error.h"

namespace radiosity {

/// No solution: light falls on patches that pass all of it on to each other.
class TrappedLight : public SolveError {
 public:
  TrappedLight(const std::string& message, std::vector<std::int32_t> trapping)
      : SolveError(message), patches(std::move(trapping)) {}
  std::vector<std::int32_t> patches;  ///< increasing
};

}  // namespace radiosity
