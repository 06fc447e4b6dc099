#pragma once

#include <cstddef>
#include <functional>
#include <span>

namespace radiosity {

/// Which part of a work that is done in several, on other machines perhaps, is meant.
struct WorkPart {
  std::size_t number = 0;   ///< from 0, < n_parts
  std::size_t n_parts = 1;  ///< > 0; 1 = the whole
};

/// Parts that a work may have, at most.
inline constexpr std::size_t kMostParts = 1'000'000;

/// Takes a record of a work file.
using RecordVisitor = std::function<void(std::span<const std::byte> record)>;

}  // namespace radiosity
