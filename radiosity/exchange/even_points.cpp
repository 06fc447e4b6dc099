#include "radiosity/exchange/even_points.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "radiosity/exchange/visible_fraction.h"
#include "radiosity/polygon/point_to_polygon.h"

namespace radiosity {
namespace {

/// Sequences, the points of each at first and at last, and how these grow.
constexpr int kSequences = 16;
constexpr int kFewestPoints = 16;
constexpr int kMostPointsOfSequence = 1024;
constexpr int kPointsGrowth = 4;
/// One sigma at least, per point: what none of them fell upon.
constexpr double kOpenPerPoint = 0.5;
/// 1 / g and 1 / g² with g³ = g + 1.
constexpr double kPlastic = 0.7548776662466927;
constexpr double kPlasticSquared = 0.5698402909980532;

double fraction_of(double x) { return x - std::floor(x); }

/// Maps the unit square to a convex polygon, evenly: a fan of triangles.
class EvenMap {
 public:
  explicit EvenMap(const ConvexPolygon& polygon) : polygon_(polygon) {
    double sum = 0;
    for (std::size_t k = 2; k < polygon.size(); ++k) {
      sum += (polygon[k - 1] - polygon[0]).cross(polygon[k] - polygon[0]).norm();
      up_to_[k - 2] = sum;
    }
  }

  [[nodiscard]] Vec3 point(double u, double v) const {
    const std::size_t last = polygon_.size() - 3;
    const double at = u * up_to_[last];
    std::size_t k = 0;
    while (k < last && at >= up_to_[k]) ++k;
    const double before = k > 0 ? up_to_[k - 1] : 0;
    const double share = std::clamp((at - before) / (up_to_[k] - before), 0.0, 1.0);
    return triangle_point(polygon_[0], polygon_[k + 1], polygon_[k + 2], share, v);
  }

 private:
  const ConvexPolygon& polygon_;
  std::array<double, ConvexPolygon::kCapacity> up_to_{};
};

}  // namespace

PairEstimate sample_evenly(const ShadowedPair& pair, double tolerance, std::uint64_t seed,
                           ShadowCutter& cutter) {
  const EvenMap map(pair.source);
  std::array<double, kSequences> whole{};
  std::array<double, kSequences> visible{};
  PairEstimate result;
  int n_done = 0;
  for (int n = kFewestPoints; n <= kMostPointsOfSequence; n *= kPointsGrowth) {
    for (int s = 0; s < kSequences; ++s) {
      const std::uint64_t shift = pair_seed(seed, s, 0);
      const double shift_u = 0x1p-32 * static_cast<double>(shift >> 32U);
      const double shift_v = 0x1p-32 * static_cast<double>(shift & 0xffffffffU);
      for (int k = n_done; k < n; ++k) {
        const Vec3 point = map.point(fraction_of(shift_u + k * kPlastic),
                                     fraction_of(shift_v + k * kPlasticSquared));
        const double all = facing_point_to_polygon(point, pair.source_normal, pair.target.points());
        if (!(all > 0)) continue;  // in the target's plane but for rounding
        whole[s] += all;
        visible[s] +=
            cutter.visible_part(point, pair.source_normal, pair.target, all, pair.shadows);
      }
    }
    n_done = n;
    double sum_whole = 0;
    double sum_visible = 0;
    for (int s = 0; s < kSequences; ++s) {
      sum_whole += whole[s];
      sum_visible += visible[s];
    }
    if (!(sum_whole > 0)) return {};
    result.value = sum_visible / sum_whole;
    double squares = 0;
    for (int s = 0; s < kSequences; ++s) squares += square(visible[s] - result.value * whole[s]);
    // Of a ratio of means (Cochran 1977, section 6.4).
    result.error = std::hypot(std::sqrt(squares * kSequences / (kSequences - 1)) / sum_whole,
                              kOpenPerPoint / (static_cast<double>(kSequences) * n));
    result.is_partial = result.value > 0 && result.value < 1;
    if (result.error <= tolerance) break;
  }
  return result;
}

}  // namespace radiosity
