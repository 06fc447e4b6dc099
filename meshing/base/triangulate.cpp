#include "meshing/base/triangulate.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace meshing {
namespace {

using radiosity::Vec3;

/// Twice the area of a triangle, in squared polygon extents, that counts as none.
constexpr double kSliver = 1e-12;
/// Distance, in polygon extents, at which a corner counts as lying on the diagonal.
constexpr double kOnLine = 1e-10;

enum class Inside { closed, open };

bool is_in_triangle(const Vec2& p, const std::array<Vec2, 3>& t, Inside inside) {
  for (int k = 0; k < 3; ++k) {
    const Vec2& a = t[k];
    const Vec2& b = t[(k + 1) % 3];
    const double tolerance = (inside == Inside::closed ? -kOnLine : kOnLine) * (b - a).norm();
    if (signed_area2(a, b, p) < tolerance) return false;
  }
  return true;
}

/// The corners not yet clipped, as a ring.
class EarClipper {
 public:
  explicit EarClipper(std::span<const Vec2> polygon)
      : points_(polygon), next_(polygon.size()), previous_(polygon.size()) {
    const auto n = static_cast<std::int32_t>(polygon.size());
    for (std::int32_t k = 0; k < n; ++k) {
      next_[k] = (k + 1) % n;
      previous_[k] = (k + n - 1) % n;
    }
    for (std::int32_t k = 0; k < n; ++k) {
      if (corner_area2(k) <= kSliver) blockers_.push_back(k);
    }
  }

  std::optional<std::vector<Triangle>> run() {
    auto remaining = static_cast<std::int32_t>(points_.size());
    std::int32_t current = 0;
    for (; remaining > 3; --remaining) {
      std::optional<std::int32_t> ear = find_ear(current, remaining, Inside::closed);
      // Only where corners touch the diagonals of all ears; then touching must do.
      if (!ear) ear = find_ear(current, remaining, Inside::open);
      if (!ear) return std::nullopt;
      current = clip(*ear);
    }
    triangles_.push_back({previous_[current], current, next_[current]});
    if (corner_area2(current) <= 0) return std::nullopt;
    return triangles_;
  }

 private:
  [[nodiscard]] double corner_area2(std::int32_t k) const {
    return signed_area2(points_[previous_[k]], points_[k], points_[next_[k]]);
  }

  [[nodiscard]] bool is_ear(std::int32_t k, Inside inside) const {
    if (corner_area2(k) <= kSliver) return false;
    const std::array<Vec2, 3> ear{points_[previous_[k]], points_[k], points_[next_[k]]};
    // Only corners that were reflex or straight at the start can lie in an ear.
    return std::none_of(blockers_.begin(), blockers_.end(), [&](std::int32_t b) {
      const Vec2& p = points_[b];
      return !is_clipped(b) && p != ear[0] && p != ear[1] && p != ear[2] &&
             is_in_triangle(p, ear, inside);
    });
  }

  [[nodiscard]] bool is_clipped(std::int32_t k) const { return next_[k] < 0; }

  [[nodiscard]] std::optional<std::int32_t> find_ear(std::int32_t start, std::int32_t remaining,
                                                     Inside inside) const {
    for (std::int32_t step = 0, k = start; step < remaining; ++step, k = next_[k]) {
      if (is_ear(k, inside)) return k;
    }
    return std::nullopt;
  }

  /// Cuts ear k off and returns a corner from which to go on.
  std::int32_t clip(std::int32_t k) {
    triangles_.push_back({previous_[k], k, next_[k]});
    const std::int32_t after = next_[k];
    next_[previous_[k]] = after;
    previous_[after] = previous_[k];
    next_[k] = -1;
    return next_[after];  // not `after` itself, which would make a fan of slivers
  }

  std::span<const Vec2> points_;
  std::vector<std::int32_t> next_, previous_, blockers_;
  std::vector<Triangle> triangles_;
};

}  // namespace

PlaneFrame::PlaneFrame(std::span<const Vec3> polygon) : origin_(polygon[0]) {
  const Vec3 normal = radiosity::vector_area(polygon).normalized();
  Vec3 longest = Vec3::Zero();
  radiosity::Box3 box;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3 edge = polygon[(k + 1) % polygon.size()] - polygon[k];
    if (edge.squaredNorm() > longest.squaredNorm()) longest = edge;
    box.extend(polygon[k]);
  }
  u_ = (longest - longest.dot(normal) * normal).normalized();
  v_ = normal.cross(u_);
  unit_ = box.diagonal().norm();
}

Vec2 PlaneFrame::to_plane(const Vec3& point) const {
  const Vec3 offset = (point - origin_) / unit_;
  return {offset.dot(u_), offset.dot(v_)};
}

Vec3 PlaneFrame::to_space(const Vec2& point) const {
  return origin_ + unit_ * (point.x() * u_ + point.y() * v_);
}

double signed_area2(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

bool crosses_itself(std::span<const Vec2> polygon) {
  const std::size_t n = polygon.size();
  const auto start = [&](std::size_t k) -> const Vec2& { return polygon[k]; };
  const auto end = [&](std::size_t k) -> const Vec2& { return polygon[(k + 1) % n]; };
  const auto low_x = [&](std::size_t k) { return std::min(start(k).x(), end(k).x()); };
  const auto separates = [&](std::size_t line, std::size_t edge) {
    const double a = signed_area2(start(line), end(line), start(edge));
    const double b = signed_area2(start(line), end(line), end(edge));
    return (a > kSliver && b < -kSliver) || (a < -kSliver && b > kSliver);
  };
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return low_x(i) < low_x(j); });
  for (std::size_t i = 0; i < n; ++i) {
    const double high_x = std::max(start(order[i]).x(), end(order[i]).x());
    for (std::size_t j = i + 1; j < n && low_x(order[j]) <= high_x; ++j) {
      if (separates(order[i], order[j]) && separates(order[j], order[i])) return true;
    }
  }
  return false;
}

std::optional<std::vector<Triangle>> clip_ears(std::span<const Vec2> polygon) {
  if (polygon.size() < 3 || crosses_itself(polygon)) return std::nullopt;
  return EarClipper(polygon).run();
}

}  // namespace meshing
