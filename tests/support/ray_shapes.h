#pragma once

#include <cstdint>
#include <vector>

#include "radiosity/base/geometry.h"

namespace radiosity::test {

/// Triangles and parallelograms as arrays, to be met by rays: plane, and two affine coordinates
/// that are at least 0 inside, with a sum of at most `most`.
class RayShapes {
 public:
  /// The triangle a, b, d (most = 1) or the parallelogram on its edges at a (most = 2) as a part of
  /// a face. Those without area are left out.
  void add(std::int32_t face, const Vec3& a, const Vec3& b, const Vec3& d, double most);
  /// The k-th of others.
  void append(const RayShapes& other, std::size_t k);

  [[nodiscard]] std::size_t size() const { return face_.size(); }
  /// What shape k is a part of.
  [[nodiscard]] std::int32_t face(std::size_t k) const { return face_[k]; }

  /// Distances of what a ray meets, in lengths of its direction; infinite for what it misses.
  void find_hits(const Vec3& origin, const Vec3& direction, std::vector<double>& distances) const;

 private:
  std::vector<double> nx_, ny_, nz_, offset_, ux_, uy_, uz_, u0_, vx_, vy_, vz_, v0_, most_;
  std::vector<std::int32_t> face_;
};

}  // namespace radiosity::test
