#include "radiosity/exchange/point_sampler.h"

#include <algorithm>
#include <cmath>

#include "radiosity/polygon/exchange_area.h"
#include "radiosity/polygon/point_to_polygon.h"
#include "radiosity/polygon/polygon_quadrature.h"

namespace radiosity {
namespace {

/// The standard error of a piece's four quarters as a share of how far they are off the piece in
/// all and one by one, and of what is aimed at, since these may be small by chance.
constexpr double kRuleError = 0.3;
constexpr double kQuarterError = 0.2;
constexpr double kChanceOfQuarters = 0.1;
/// Error of the kernel of parts that are proved visible or hidden, of what is asked of the pair.
constexpr double kPartKernel = 1e-3;
/// The standard error of what points miss as a share of it.
constexpr double kMissed = 0.5;
/// The same of what their rule misses of the unobstructed kernel.
constexpr double kPeakError = 0.3;

/// Whether a point is inside a blocker, or on its surface with nothing of the target beyond.
bool is_inside(const Blocker& blocker, const Vec3& point, const ConvexPolygon& target,
               double thickness) {
  return std::all_of(blocker.faces.begin(), blocker.faces.end(), [&](const HalfSpace& face) {
    const double height = face.normal.dot(point) - face.offset;
    if (height < -thickness) return true;
    if (height > thickness) return false;
    return std::all_of(target.begin(), target.end(), [&](const Vec3& corner) {
      return face.normal.dot(corner) - face.offset <= thickness;
    });
  });
}

/// What 16 points of a piece of the source may miss of blockers that hide the target from a spot
/// smaller than their spacing only, as a share of what the piece sees.
double missed_share(const ConvexPolygon& piece, const Vec3& normal,
                    std::span<const Blocker* const> blockers) {
  const double area = vector_area(piece.points()).norm();
  const double spacing = bounding_disc(piece.points()).radius / 2;
  double squares = 0;
  for (const Blocker* blocker : blockers) {
    // The height of the box's middle, which is above its lowest corner by half of its size at most.
    const double height = normal.dot(blocker->box.center() - piece[0]);
    const double spot = std::max(height, 0.0) + 0.5 * blocker->box.diagonal().norm();
    if (spot < spacing) squares += square(kMissed * square(spot) / area);
  }
  return std::sqrt(squares);
}

}  // namespace

PairEstimate PointSampler::sample(const PairView& view, PairBlockers& between, double whole,
                                  double error) {
  points_left_ = kMostPoints;
  part_tolerance_ = std::max(options_.kernel_tolerance, kPartKernel * error);
  const Sums coarse = apply_rule(view, *view.source, between);
  Sums sums;
  add_parts(view, *view.source, between.blockers, coarse, error * coarse.whole, 0, sums);
  if (sums.whole <= 0) return {};
  const double missed = kPeakError * (sums.whole - whole) / whole;
  const double sigma =
      std::hypot(std::sqrt(sums.variance) / sums.whole, missed, options_.least_error);
  const double fraction = sums.visible / sums.whole;
  return {fraction, sigma, Blocking::some, fraction > 0 && fraction < 1};
}

void PointSampler::Sums::add(const Sums& other) {
  whole += other.whole;
  visible += other.visible;
  variance += other.variance;
}

PointSampler::Sums PointSampler::apply_rule(const PairView& view, const ConvexPolygon& piece,
                                            PairBlockers& between) {
  constexpr int kOrder = 2;
  Sums sums;
  const auto visible_from = [&](const Vec3& point, double whole) {
    if (!between.dividing.empty()) {
      const SegmentBundle bundle({std::span(&point, 1), true}, {view.target->points(), true},
                                 options_.thickness);
      for (const std::size_t k : between.dividing) {
        between.shadows[k].clear();
        const auto verdict = bundle.test(*between.blockers[k], &between.shadows[k]);
        if (verdict.blocking == Blocking::all) return 0.0;
        if (verdict.divides_target == nullptr) continue;
        // From inside a body only what else is inside can be seen, and that is next to nothing.
        if (is_inside(*between.blockers[k], point, *view.target, options_.thickness)) return 0.0;
      }
    }
    return cutter_.visible_part(point, view.source_normal, *view.target, whole,
                                {between.shadows.data(), between.blockers.size()});
  };
  constexpr std::array<std::size_t, 4> kCornerOfPoint{0, 3, 1, 2};
  sums.has_quarters = piece.size() == 4;
  std::size_t n_points = 0;
  for_each_quadrature_point(piece.points(), kOrder, [&](const Vec3& point, double weight) {
    const std::size_t corner = kCornerOfPoint[n_points++ % 4];
    --points_left_;
    const double whole = facing_point_to_polygon(point, view.source_normal, view.target->points());
    if (!(whole > 0)) return;  // in the target's plane but for rounding
    const double visible = visible_from(point, whole);
    sums.whole += weight * whole;
    sums.visible += weight * visible;
    sums.quarter_whole[corner] = weight * whole;
    sums.quarter_visible[corner] = weight * visible;
  });
  return sums;
}

PointSampler::Sums PointSampler::look_at_part(const PairView& view, const ConvexPolygon& part,
                                              Blockers candidates, std::size_t depth) {
  PairBlockers& between = between_[depth];
  const Blocking blocking = between.find(part, *view.target, candidates, options_.thickness);
  if (blocking == Blocking::some && between.target_divider == nullptr) {
    return apply_rule(view, part, between);
  }
  const double whole = exchange_area(part.points(), view.target->points(), part_tolerance_);
  return {whole, blocking == Blocking::all ? 0 : whole, 0, blocking != Blocking::some};
}

void PointSampler::add_parts(const PairView& view, const ConvexPolygon& piece, Blockers blockers,
                             const Sums& coarse, double goal, std::size_t depth, Sums& sums) {
  const std::vector<ConvexPolygon> parts = divide_about_corners(piece);
  std::array<Sums, kMostCorners> fine;
  Sums total;
  bool is_proved = true;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    fine[k] = look_at_part(view, parts[k], blockers, depth);
    total.add(fine[k]);
    is_proved &= fine[k].is_proved;
  }
  if (is_proved) {
    sums.add(total);
    return;
  }
  const double share = total.whole > 0 ? total.visible / total.whole : 0;
  // The sum may agree by chance, four quarters hardly ever do.
  const double change = total.visible - coarse.visible - share * (total.whole - coarse.whole);
  double squares = 0;
  for (std::size_t k = 0; coarse.has_quarters && k < parts.size(); ++k) {
    squares += square(fine[k].visible - coarse.quarter_visible[k] -
                      share * (fine[k].whole - coarse.quarter_whole[k]));
  }
  double variance = square(kRuleError * change) + square(kQuarterError) * squares;
  // Where the kernel peaks between the points, what is seen there is not known.
  variance += square(kPeakError * (total.whole - coarse.whole));
  variance += square(kUnseen * total.whole);
  variance += square(total.whole * missed_share(piece, view.source_normal, blockers));
  const bool is_good = coarse.has_quarters && variance <= square(goal);
  if (is_good || depth + 1 >= kMostQuarterings || points_left_ <= 0) {
    total.variance += variance + square(kChanceOfQuarters * goal);
    sums.add(total);
    return;
  }
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (fine[k].is_proved) {
      sums.add(fine[k]);
      continue;
    }
    between_[depth].find(parts[k], *view.target, blockers, options_.thickness);
    add_parts(view, parts[k], between_[depth].blockers, fine[k], goal / 2, depth + 1, sums);
  }
}

}  // namespace radiosity
