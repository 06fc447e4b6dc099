#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "radiosity/visibility/patch_sides.h"

namespace radiosity {

/// What of the sides of patches that lie on each other counts, so that each bit of surface counts
/// once for either direction: emitting sides before backs, and of equals the first.
class FreeSides {
 public:
  /// `overlaps` are pairs of patches that lie on each other, no further apart than `reach`, m; of
  /// twins the first.
  FreeSides(const PatchSides& sides,
            const std::vector<std::pair<std::int32_t, std::int32_t>>& overlaps, double reach);

  using Outline = std::vector<Vec3>;
  /// The outlines of what counts of a side, m, counter-clockwise seen from its patch's front;
  /// nullptr if that is all of it. Slivers as narrow as the reach are left out.
  [[nodiscard]] const std::vector<Outline>* parts(Index side) const;
  /// The patches that lie on that side, or are on a level with it.
  [[nodiscard]] std::span<const std::int32_t> covers(Index side) const;

 private:
  struct Side {
    std::int32_t patch;
    std::vector<std::int32_t> covers;
    std::vector<Outline> parts;
  };
  std::map<Index, Side> covered_;
};

}  // namespace radiosity
