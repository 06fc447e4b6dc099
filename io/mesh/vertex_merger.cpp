#include "io/mesh/vertex_merger.h"

#include <bit>

namespace io {
namespace {

using radiosity::Vec3;

/// Mixes the bits of the coordinates so that every bit changes the low ones (the finaliser of
/// MurmurHash3).
std::uint64_t hash(const Vec3& point) {
  std::uint64_t h = 0;
  for (const double x : point) {
    h = (h ^ std::bit_cast<std::uint64_t>(x)) * 0xff51afd7ed558ccdULL;
    h ^= h >> 33;
    h *= 0xc4ceb9fe1a85ec53ULL;
    h ^= h >> 33;
  }
  return h;
}

}  // namespace

std::int32_t VertexMerger::find_or_add(const Vec3& given, std::vector<Vec3>& vertices) {
  if (2 * (vertices.size() + 1) > slots_.size()) grow(vertices);
  const Vec3 point = given.array() + 0.0;  // turns -0 into 0, which would hash differently
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = hash(point) & mask;
  while (slots_[slot] >= 0) {
    if (vertices[slots_[slot]] == point) return slots_[slot];
    slot = (slot + 1) & mask;
  }
  slots_[slot] = static_cast<std::int32_t>(vertices.size());
  vertices.push_back(point);
  return slots_[slot];
}

void VertexMerger::grow(const std::vector<Vec3>& vertices) {
  slots_.assign(slots_.empty() ? 1024 : 2 * slots_.size(), -1);
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    std::size_t slot = hash(vertices[i]) & mask;
    while (slots_[slot] >= 0) slot = (slot + 1) & mask;
    slots_[slot] = static_cast<std::int32_t>(i);
  }
}

}  // namespace io
