#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <span>
#include <vector>

#include "radiosity/base/geometry.h"

namespace radiosity {

/// A convex polygon of few vertices without heap memory: a patch, or what clipping left of one.
class ConvexPolygon {
 public:
  /// A quad clipped by ten planes still fits.
  static constexpr std::size_t kCapacity = 14;

  ConvexPolygon() = default;
  ConvexPolygon(const ConvexPolygon& other) : ConvexPolygon(other.points()) {}
  ConvexPolygon& operator=(const ConvexPolygon& other) {
    size_ = other.size_;
    std::copy(other.begin(), other.end(), points_.begin());
    return *this;
  }
  explicit ConvexPolygon(std::span<const Vec3> points) {
    for (const Vec3& point : points) push_back(point);
  }

  void push_back(const Vec3& point) {
    assert(size_ < kCapacity);
    points_[size_++] = point;
  }
  void clear() { size_ = 0; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  Vec3& operator[](std::size_t k) { return points_[k]; }
  const Vec3& operator[](std::size_t k) const { return points_[k]; }
  [[nodiscard]] const Vec3* begin() const { return points_.data(); }
  [[nodiscard]] const Vec3* end() const { return points_.data() + size_; }
  [[nodiscard]] std::span<const Vec3> points() const { return {points_.data(), size_}; }

 private:
  std::array<Vec3, kCapacity> points_;
  std::size_t size_ = 0;
};

/// A circle about the mean of a polygon's corners that holds them all, m.
struct Disc {
  Vec3 center;
  double radius;
};

Disc bounding_disc(std::span<const Vec3> polygon);

/// The polygon in as many quads as it has corners, one about each.
std::vector<ConvexPolygon> divide_about_corners(const ConvexPolygon& polygon);

/// The part of `polygon` where normal · (x - on_plane) >= 0. Vertices within `thickness` (m) of the
/// plane count as lying on it. Empty if nothing with area is left. (Sutherland & Hodgman 1974)
ConvexPolygon clip_to_half_space(std::span<const Vec3> polygon, const Vec3& on_plane,
                                 const Vec3& normal, double thickness);

/// Leaves the part where normal · (x - on_plane) >= 0 only, and tells whether there is any area.
bool keep_above(const Vec3& on_plane, const Vec3& normal, ConvexPolygon& polygon);

/// Both parts of a polygon, and whether the plane goes through it. If not, all of it is `above`, or
/// `below` if nothing of it is above. Vertices within `thickness` (m) of the plane lie on it.
bool split(const ConvexPolygon& polygon, const Vec3& on_plane, const Vec3& normal, double thickness,
           ConvexPolygon& above, ConvexPolygon& below);

}  // namespace radiosity
