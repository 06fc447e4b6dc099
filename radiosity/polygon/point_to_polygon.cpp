#include "radiosity/polygon/point_to_polygon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "radiosity/polygon/convex_polygon.h"

namespace radiosity {
namespace {

/// Two edges of a polygon, a lane each: what any x86-64 computes at once. (Of GCC and Clang; twice
/// as fast as one edge by itself, and 1.6 times as Eigen's Array2d.)
using Lanes [[gnu::vector_size(2 * sizeof(double))]] = double;

inline Lanes square_root(const Lanes& x) { return Lanes{std::sqrt(x[0]), std::sqrt(x[1])}; }

/// The angle θ between unit vectors over its sine, in powers of z = 1 - cosθ: 2^2k (k!)² / (2k+1)!
/// (z/2)^k. The first few are enough for far polygons.
constexpr std::size_t kMostTerms = 12;
constexpr std::size_t kFewTerms = 6;
/// Where what these leave out is below 1e-16.
constexpr double kMostTermsEnd = 0.1;
constexpr double kFewTermsEnd = 0.003;
constexpr std::array<double, kMostTerms> kAngleSeries = [] {
  std::array<double, kMostTerms> terms{1};
  for (std::size_t k = 1; k < kMostTerms; ++k) {
    terms[k] = terms[k - 1] * static_cast<double>(k) / static_cast<double>(2 * k + 1);
  }
  return terms;
}();

/// Even and odd powers by themselves: two chains that run side by side.
template <std::size_t n_terms>
inline Lanes angle_series(const Lanes& z) {
  static_assert(n_terms % 2 == 0 && n_terms <= kMostTerms);
  const Lanes square = z * z;
  Lanes even = Lanes{} + kAngleSeries[n_terms - 2];
  Lanes odd = Lanes{} + kAngleSeries[n_terms - 1];
  const auto add = [&](std::size_t k) {
    even = even * square + kAngleSeries[k];
    odd = odd * square + kAngleSeries[k + 1];
  };
  [&]<std::size_t... k>(std::index_sequence<k...>) { (add(n_terms - 4 - 2 * k), ...); }
  (std::make_index_sequence<n_terms / 2 - 1>());
  return even + odd * z;
}

/// Vectors, one a lane.
struct VectorLanes {
  Lanes x;
  Lanes y;
  Lanes z;

  [[nodiscard]] Lanes dot(const VectorLanes& other) const {
    return x * other.x + y * other.y + z * other.z;
  }
  [[nodiscard]] VectorLanes cross(const VectorLanes& other) const {
    return {y * other.z - z * other.y, z * other.x - x * other.z, x * other.y - y * other.x};
  }
};

/// The angles between unit vectors over their sines.
inline Lanes angles_over_sines(const Lanes& cosines, const VectorLanes& cross) {
  const Lanes z = 1 - cosines;
  const double most = std::max(z[0], z[1]);
  if (most <= kFewTermsEnd) return angle_series<kFewTerms>(z);
  if (most <= kMostTermsEnd) return angle_series<kMostTerms>(z);
  // θ / sinθ = (θ/2) / sin(θ/2) / cos(θ/2), twice.
  constexpr double kQuartersEnd = 1.2;  // to here a quarter of the angle is in the series' range
  const Lanes half = square_root(1 - 0.5 * z);
  const Lanes quarter = square_root(0.5 + 0.5 * half);
  Lanes result = angle_series<kMostTerms>(1 - quarter) / (half * quarter);
  for (int k = 0; most > kQuartersEnd && k < 2; ++k) {
    if (z[k] <= kQuartersEnd) continue;
    const double sine = Vec3(cross.x[k], cross.y[k], cross.z[k]).norm();
    result[k] = sine > 0 ? std::atan2(sine, cosines[k]) / sine : 0;
  }
  return result;
}

inline VectorLanes directions_to(const Vec3& a, const Vec3& b, const Vec3& from) {
  VectorLanes way{Lanes{a[0], b[0]} - from[0], Lanes{a[1], b[1]} - from[1],
                  Lanes{a[2], b[2]} - from[2]};
  const Lanes square = way.dot(way);
  // From one of the corners there is no way to it, and no division by its length.
  const Lanes inverse = 1 / square_root(square + std::numeric_limits<double>::min());
  way.x *= inverse;
  way.y *= inverse;
  way.z *= inverse;
  return way;
}

}  // namespace

double facing_point_to_polygon(const Vec3& point, const Vec3& normal,
                               std::span<const Vec3> polygon) {
  const auto corner = [&](std::size_t k) -> const Vec3& {
    return polygon[k < polygon.size() ? k : 0];
  };
  Lanes sum{};
  const VectorLanes first = directions_to(corner(0), corner(1), point);
  VectorLanes start = first;
  for (std::size_t k = 0; k < polygon.size(); k += 2) {
    // Of an odd number of corners, the first one follows itself, with an edge of no length.
    const VectorLanes next =
        k + 2 < polygon.size() ? directions_to(corner(k + 2), corner(k + 3), point) : first;
    const VectorLanes end{
        {start.x[1], next.x[0]}, {start.y[1], next.y[0]}, {start.z[1], next.z[0]}};
    const VectorLanes cross = start.cross(end);
    const Lanes heights = normal[0] * cross.x + normal[1] * cross.y + normal[2] * cross.z;
    sum += angles_over_sines(start.dot(end), cross) * heights;
    start = next;
  }
  // Counter-clockwise about the polygon's normal is clockwise as seen from the point.
  return std::max(0.0, -(sum[0] + sum[1]) / (2 * kPi));
}

double point_to_polygon(const Vec3& point, const Vec3& normal, std::span<const Vec3> polygon) {
  const Vec3 area = vector_area(polygon);
  if (area.dot(point - polygon.front()) <= 0) return 0;  // behind the polygon
  const bool is_above = std::all_of(polygon.begin(), polygon.end(), [&](const Vec3& corner) {
    return normal.dot(corner - point) >= 0;
  });
  if (is_above) return facing_point_to_polygon(point, normal, polygon);
  if (polygon.size() > ConvexPolygon::kCapacity - 2) {
    double sum = 0;
    for (std::size_t k = 2; k < polygon.size(); ++k) {
      const std::array triangle{polygon[0], polygon[k - 1], polygon[k]};
      sum += point_to_polygon(point, normal, triangle);
    }
    return sum;
  }
  return facing_point_to_polygon(point, normal,
                                 clip_to_half_space(polygon, point, normal, 0).points());
}

}  // namespace radiosity
