#pragma once

#include <cstdint>

namespace radiosity {

/// What became of pairs of patches when their exchange areas were computed.
struct Census {
  std::int64_t facing = 0;     ///< unordered pairs that face each other, at least in part
  std::int64_t visible = 0;    ///< of these: proved to see each other wholly
  std::int64_t hidden = 0;     ///< of these: proved not to see each other
  std::int64_t undecided = 0;  ///< of these: not proved either way
  std::int64_t partial = 0;    ///< of the undecided: found to be partly hidden
  std::int64_t known = 0;      ///< of the facing: taken over from an earlier operator
  std::int64_t rays = 0;       ///< visibility rays cast

  Census& operator+=(const Census& other) {
    facing += other.facing;
    visible += other.visible;
    hidden += other.hidden;
    undecided += other.undecided;
    partial += other.partial;
    known += other.known;
    rays += other.rays;
    return *this;
  }
};

}  // namespace radiosity
