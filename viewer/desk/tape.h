#pragma once

#include <optional>

#include "radiosity/base/geometry.h"

namespace viewer {

/// A tape measure between two points of the scene.
struct Tape {
  bool is_in_hand = false;                   ///< clicks lay its ends, rather than ask patches
  std::optional<radiosity::Vec3> from = {};  ///< m
  std::optional<radiosity::Vec3> to = {};    ///< m; only with `from`

  /// From one end to the other, m; empty until both lie.
  [[nodiscard]] std::optional<radiosity::Vec3> difference() const {
    if (!from || !to) return std::nullopt;
    return *to - *from;
  }
};

/// Lays the next end; begins anew if both lie.
inline void lay(Tape& tape, const radiosity::Vec3& point) {
  if (tape.from && !tape.to) {
    tape.to = point;
  } else {
    tape.from = point;
    tape.to.reset();
  }
}

}  // namespace viewer
