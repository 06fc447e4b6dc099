#include "radiosity/exchange/shadowed_quadrature.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "radiosity/exchange/graded_pieces.h"
#include "radiosity/polygon/point_to_polygon.h"
#include "radiosity/polygon/polygon_quadrature.h"

namespace radiosity {
namespace {

/// The source is divided into this many pieces at most, for one low rule each and if they adapt;
/// what is left undivided costs accuracy.
constexpr std::size_t kMostPieces = 64;
constexpr std::size_t kMostAdaptivePieces = 256;
/// The same once they are strips along edges close to the source, and the narrowest strip in sizes
/// of the source times the error aimed at.
constexpr std::size_t kMostGradedPieces = 128;
constexpr double kLeastStrip = 0.1;
/// Points that every piece may have, however small: those of three rules.
constexpr long kPointsOfPiece = 29;
/// One sigma of what rules may miss between their points where events were left out, as a share of
/// a piece.
constexpr double kUnseen = 5e-3;
/// Polygons with this many corners are halved or not cut further, to stay within their capacity.
constexpr std::size_t kMostPieceCorners = 9;
/// Cuts closer to a corner than this share of the piece's size, or than what digits leave open, are
/// left out.
constexpr double kSliver = 1e-7;
constexpr double kDigits = 2;  // times the thickness of planes
/// Visible parts below this share of the whole are rounding.
constexpr double kRounding = 1e-12;
/// Pieces below this share of the source make do with one point, if the rule is low.
constexpr double kSmallPiece = 0.03;
/// One sigma of the low rule's error in a piece, as a share of how much the visible share varies
/// among its points, and of one point's. Measured against converged rules in cluttered rooms, 95 %
/// of pieces are within 0.6 and 1.5 sigma, 99.9 % within 6, since the errors have long tails. The
/// crossings of several shadows' borders are events that the pieces don't heed.
constexpr double kLowRuleError = 5e-3;
constexpr double kOnePointError = 2e-2;
constexpr double kLowRuleErrorOfMany = 2.5e-2;
/// The least of either, since spots may fall between points.
constexpr double kLeastLowRule = 2e-4;
/// One sigma of a converged rule's error as a share of its change from the rule before, and of what
/// was aimed at: two rules may agree by chance.
constexpr double kHighRuleError = 0.3;
constexpr double kChanceOfRules = 0.1;
/// Divisions of a piece at most.
constexpr int kMostPieceDivisions = 6;
/// Points for a pair at most at a tolerance of 1e-3, more in proportion to its inverse root: what
/// does not settle by then has the error that it has.
constexpr double kMostPoints = 4000;

/// Calls visit(point, weight) for a product rule on a convex polygon, which is cut into quads and
/// perhaps a triangle.
template <typename Visit>
void for_each_point(const ConvexPolygon& polygon, int order, const Visit& visit) {
  if (polygon.size() <= 4) {
    for_each_quadrature_point(polygon.points(), order, visit);
    return;
  }
  for (std::size_t k = 1; k + 1 < polygon.size(); k += 2) {
    ConvexPolygon part;
    part.push_back(polygon[0]);
    for (std::size_t c = k; c < std::min(k + 3, polygon.size()); ++c) part.push_back(polygon[c]);
    for_each_quadrature_point(part.points(), order, visit);
  }
}

}  // namespace

PairEstimate ShadowedQuadrature::integrate(const ShadowedPair& pair, double tolerance,
                                           bool adapts) {
  divide_source(pair, adapts ? kMostAdaptivePieces : kMostPieces);
  if (adapts && !grade_source(pair, tolerance)) return {0, 1, Blocking::some, false, 0};
  const double most_points = kMostPoints * std::max(1.0, std::sqrt(1e-3 / tolerance));
  points_left_ = 0;
  const double area = vector_area(pair.source.points()).norm();
  const bool is_single = pair.shadows.size() == 1;
  Sums total;
  for (const ConvexPolygon& piece : pieces_) {
    const double share = vector_area(piece.points()).norm() / area;
    if (adapts) {
      // Each has its share, and what those before it have left.
      points_left_ += kPointsOfPiece + static_cast<long>(most_points * share);
      const double whole = point_to_polygon(bounding_disc(piece.points()).center,
                                            pair.source_normal, pair.target.points()) *
                           area;
      add_adaptively(pair, piece, tolerance * whole * std::sqrt(share), kMostPieceDivisions, total);
      continue;
    }
    const bool is_small = share < kSmallPiece;
    Sums sums = apply_rule(pair, piece, is_small ? 1 : 2);
    if (sums.any_visible && sums.any_hidden) {
      const double spread = is_small ? 1 : sums.high - sums.low;
      const double error = !is_single || !is_divided_ ? kLowRuleErrorOfMany
                           : is_small                 ? kOnePointError
                                                      : kLowRuleError * (1 + 4 * spread * spread);
      sums.variance = square(std::max(error * spread, kLeastLowRule) * sums.whole);
    }
    if (!is_divided_) sums.variance += square(kUnseen * sums.whole);
    total.add(sums);
  }
  PairEstimate result;
  if (total.whole <= 0) return result;
  result.value = total.visible / total.whole;
  result.error = std::sqrt(total.variance) / total.whole;
  if (!total.any_hidden) result.value = 1;
  if (!total.any_visible) result.value = 0;
  result.is_partial = result.value > 0 && result.value < 1;
  if (is_single && is_divided_ && !(total.any_visible && total.any_hidden)) {
    result.error = 0;
    result.blocking = total.any_visible ? Blocking::none : Blocking::all;
  }
  return result;
}

void ShadowedQuadrature::Sums::add(const Sums& other) {
  whole += other.whole;
  visible += other.visible;
  variance += other.variance;
  any_visible |= other.any_visible;
  any_hidden |= other.any_hidden;
}

void ShadowedQuadrature::divide_source(const ShadowedPair& pair, std::size_t most_pieces) {
  pieces_.assign(1, pair.source);
  is_divided_ = true;
  const auto divide = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    divide_pieces((b - a).cross(c - a), a, pair, most_pieces);
  };
  for (const Shadow& shadow : pair.shadows) {
    for (const Shadow::Edge& edge : shadow.edges) {
      for (const Vec3& corner : pair.target) divide(edge.start, edge.end, corner);
      for (const HalfSpace& face : shadow.faces) {
        for (std::size_t k = 0; k < pair.target.size(); ++k) {
          const Vec3& p = pair.target[k];
          const Vec3& q = pair.target[k + 1 < pair.target.size() ? k + 1 : 0];
          const double height_p = face.normal.dot(p) - face.offset;
          const double height_q = face.normal.dot(q) - face.offset;
          if (height_p * height_q >= 0) continue;
          divide(edge.start, edge.end, p + height_p / (height_p - height_q) * (q - p));
        }
      }
      for (const Shadow::Edge& other : shadow.edges) {
        if (edge.end != other.start) continue;
        for (std::size_t k = 0; k < pair.target.size(); ++k) {
          divide(edge.end, pair.target[k], pair.target[k + 1 < pair.target.size() ? k + 1 : 0]);
        }
      }
    }
  }
}

bool ShadowedQuadrature::grade_source(const ShadowedPair& pair, double tolerance) {
  edges_.clear();
  for (const Shadow& shadow : pair.shadows) {
    edges_.insert(edges_.end(), shadow.edges.begin(), shadow.edges.end());
  }
  for (std::size_t k = 0; k < pair.target.size(); ++k) {
    edges_.push_back({pair.target[k], pair.target[k + 1 < pair.target.size() ? k + 1 : 0]});
  }
  const double size = 2 * bounding_disc(pair.source.points()).radius;
  const double strip = kLeastStrip * tolerance;
  const Grading grading{std::max(strip * size, kDigits * pair.thickness),
                        strip * vector_area(pair.source.points()).norm(),
                        pieces_.size() + kMostGradedPieces};
  return grade_pieces(pieces_, pair.source_normal, edges_, grading);
}

void ShadowedQuadrature::divide_pieces(const Vec3& normal, const Vec3& on_plane,
                                       const ShadowedPair& pair, std::size_t most_pieces) {
  const double length = normal.norm();
  if (length == 0) return;
  const std::size_t n_pieces = pieces_.size();
  for (std::size_t k = 0; k < n_pieces; ++k) {
    const ConvexPolygon& piece = pieces_[k];
    double low = 0;
    double high = 0;
    for (const Vec3& corner : piece) {
      const double height = normal.dot(corner - on_plane);
      low = std::min(low, height);
      high = std::max(high, height);
    }
    const double least =
        length * std::max(kSliver * (piece[0] - piece[2]).norm(), kDigits * pair.thickness);
    if (low > -least || high < least) continue;
    if (pieces_.size() >= most_pieces || piece.size() >= kMostPieceCorners) {
      is_divided_ = false;
      continue;
    }
    ConvexPolygon above;
    ConvexPolygon below;
    split(piece, on_plane, normal, 0, above, below);
    pieces_[k] = above;
    pieces_.push_back(below);
  }
}

ShadowedQuadrature::Sums ShadowedQuadrature::apply_rule(const ShadowedPair& pair,
                                                        const ConvexPolygon& piece, int order) {
  Sums sums;
  for_each_point(piece, order, [&](const Vec3& point, double weight) {
    --points_left_;
    const double whole = facing_point_to_polygon(point, pair.source_normal, pair.target.points());
    if (!(whole > 0)) return;  // in the target's plane but for rounding
    const double visible =
        cutter_.visible_part(point, pair.source_normal, pair.target, whole, pair.shadows);
    sums.whole += weight * whole;
    sums.visible += weight * visible;
    sums.low = std::min(sums.low, visible / whole);
    sums.high = std::max(sums.high, visible / whole);
    sums.any_visible |= visible > kRounding * whole;
    sums.any_hidden |= visible < (1 - kRounding) * whole;
  });
  return sums;
}

void ShadowedQuadrature::add_adaptively(const ShadowedPair& pair, const ConvexPolygon& piece,
                                        double goal, int depth, Sums& sums) {
  constexpr std::array kOrders{2, 3, 4, 6};
  // Borders that cross make kinks that two rules may see alike by chance, three hardly ever do.
  const int n_agreeing = pair.shadows.size() > 1 ? 2 : 1;
  int n_agreed = 0;
  Sums best = apply_rule(pair, piece, kOrders[0]);
  double error = 0;
  double most = 0;
  for (std::size_t k = 1; k < kOrders.size(); ++k) {
    const Sums next = apply_rule(pair, piece, kOrders[k]);
    // What the kernel's change does depends on the visible share of all pieces, which is not known
    // yet: the worst is that it is none or all.
    const double of_visible = next.visible - best.visible;
    const double of_hidden = next.whole - best.whole - of_visible;
    best = next;
    error = std::max(std::abs(of_visible), std::abs(of_hidden));
    most = std::max(most, error);
    n_agreed = error <= goal ? n_agreed + 1 : 0;
    if (n_agreed == n_agreeing) break;
  }
  const bool is_settled = n_agreed == n_agreeing;
  if (is_settled || depth == 0 || points_left_ <= 0) {
    // Of rules that did not settle, the last two may be alike by chance.
    best.variance = square(kHighRuleError * (is_settled ? error : most));
    if (best.any_visible && best.any_hidden) best.variance += square(kChanceOfRules * goal);
    if (!is_divided_) best.variance += square(kUnseen * best.whole);
    sums.add(best);
    return;
  }
  for (const ConvexPolygon& part : divide_about_corners(piece)) {
    add_adaptively(pair, part, goal / 2, depth - 1, sums);
  }
}

}  // namespace radiosity
