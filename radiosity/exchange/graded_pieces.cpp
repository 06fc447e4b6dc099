#include "radiosity/exchange/graded_pieces.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace radiosity {
namespace {

/// The widest strip, in distances from the edge.
constexpr double kWidest = 3;
/// Edges steeper than this above the plane (their sine) meet it in a spot, not along a strip.
constexpr double kSteepest = 0.9;
/// Pieces with so many corners are not cut further, to stay within their capacity.
constexpr std::size_t kMostCornersToCut = 12;

/// An edge as the plane of the pieces sees it.
struct EdgeAbove {
  Vec3 start;
  Vec3 way;     // from start to end
  Vec3 across;  // unit vector in the plane, at a right angle to the edge's foot
};

double point_distance(const EdgeAbove& edge, const Vec3& point) {
  const double along = (point - edge.start).dot(edge.way) / edge.way.squaredNorm();
  return (edge.start + std::clamp(along, 0.0, 1.0) * edge.way - point).norm();
}

/// Distance of two segments. (Ericson 2005, section 5.1.9)
double segment_distance(const EdgeAbove& edge, const Vec3& p, const Vec3& q) {
  const Vec3 way = q - p;
  const Vec3 between = edge.start - p;
  const double a = edge.way.squaredNorm();
  const double e = way.squaredNorm();
  if (e == 0) return point_distance(edge, p);
  const double b = edge.way.dot(way);
  const double c = edge.way.dot(between);
  const double f = way.dot(between);
  const double area = a * e - b * b;
  double s = area > 0 ? std::clamp((b * f - c * e) / area, 0.0, 1.0) : 0;
  const double t = std::clamp((b * s + f) / e, 0.0, 1.0);
  s = std::clamp((b * t - c) / a, 0.0, 1.0);
  return (between + s * edge.way - t * way).norm();
}

/// Distance of an edge from a piece: from its border, or above its inside.
double distance(const EdgeAbove& edge, const ConvexPolygon& piece, const Vec3& normal) {
  double least = std::numeric_limits<double>::infinity();
  double from = 0;
  double to = 1;
  for (std::size_t k = 0; k < piece.size(); ++k) {
    const Vec3& p = piece[k];
    const Vec3& q = piece[k + 1 < piece.size() ? k + 1 : 0];
    least = std::min(least, segment_distance(edge, p, q));
    const Vec3 inward = normal.cross(q - p);
    const double height = inward.dot(edge.start - p);
    const double slope = inward.dot(edge.way);
    if (slope > 0) from = std::max(from, -height / slope);
    if (slope < 0) to = std::min(to, -height / slope);
    if (slope == 0 && height < 0) to = -1;
  }
  if (from > to) return least;
  const double height = normal.dot(edge.start - piece[0]);
  const double slope = normal.dot(edge.way);
  return std::min({least, std::abs(height + from * slope), std::abs(height + to * slope)});
}

/// Where to cut a piece, from the foot of the edge; nothing (0 width) if it is small enough.
struct Cut {
  double at = 0;
  bool is_needed = false;
};

Cut find_cut(const EdgeAbove& edge, const ConvexPolygon& piece, const Vec3& normal,
             const Grading& grading) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const Vec3& corner : piece) {
    const double at = edge.across.dot(corner - edge.start);
    low = std::min(low, at);
    high = std::max(high, at);
  }
  if (high - low <= grading.least_width) return {};
  const double width = std::max(grading.least_width, kWidest * distance(edge, piece, normal));
  if (high - low <= width || vector_area(piece.points()).norm() <= grading.least_area) return {};
  // The strip beside the edge first, half of it on either side where the edge is above the piece.
  if (low >= 0) return {low + width, true};
  if (high <= 0) return {high - width, true};
  if (high > width / 2) return {width / 2, true};
  return {-width / 2, true};
}

}  // namespace

bool grade_pieces(std::vector<ConvexPolygon>& pieces, const Vec3& normal,
                  std::span<const Shadow::Edge> edges, const Grading& grading) {
  bool is_graded = true;
  std::vector<EdgeAbove> above;
  for (const Shadow::Edge& edge : edges) {
    const Vec3 way = edge.end - edge.start;
    const Vec3 across = normal.cross(way);
    const double height =
        std::max(normal.dot(edge.start - pieces[0][0]), normal.dot(edge.end - pieces[0][0]));
    if (height <= grading.least_width) continue;
    if (std::abs(normal.dot(way)) >= kSteepest * way.norm()) continue;
    above.push_back({edge.start, way, across.normalized()});
  }
  for (const EdgeAbove& edge : above) {
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      // What is cut off nearest to the edge is small enough; the rest stays here.
      while (true) {
        const Cut cut = find_cut(edge, pieces[k], normal, grading);
        if (!cut.is_needed) break;
        if (pieces.size() >= grading.most_pieces) return false;
        if (pieces[k].size() >= kMostCornersToCut) {
          is_graded = false;
          break;
        }
        ConvexPolygon rest;
        ConvexPolygon other;
        if (!split(pieces[k], edge.start + cut.at * edge.across, edge.across, 0, rest, other)) {
          break;
        }
        pieces[k] = rest;
        pieces.push_back(other);
      }
    }
  }
  return is_graded;
}

}  // namespace radiosity
