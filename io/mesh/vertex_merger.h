#pragma once

#include <cstdint>
#include <vector>

#include "radiosity/base/geometry.h"

namespace io {

/// Collects points, each position once (compared exactly; -0 equals 0). A hash table with open
/// addressing: a node per point, as in std::unordered_map, would take most of the time of reading
/// millions of triangles.
class VertexMerger {
 public:
  /// Index of the point in `vertices`, where it is appended if new.
  std::int32_t find_or_add(const radiosity::Vec3& point, std::vector<radiosity::Vec3>& vertices);

 private:
  void grow(const std::vector<radiosity::Vec3>& vertices);

  std::vector<std::int32_t> slots_;  // a power of two of them; -1 = free
};

}  // namespace io
