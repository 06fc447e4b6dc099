#include "radiosity/scene/winding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

namespace radiosity {
namespace {

/// Facets are taken together from so many radii away; if that leaves doubts, from more.
constexpr std::array<double, 2> kFarRadii{8, 32};
/// Numbers are certain if they with their error keep so far away from the middle between two,
/// whatever is rounded.
constexpr double kLeastDoubt = 0.01;

/// Solid angle of a facet as seen from a point, steradian; positive from behind. (van Oosterom &
/// Strackee 1983)
double solid_angle(std::span<const Vec3> outline, const Vec3& point) {
  double angle = 0;
  const Vec3 a = outline[0] - point;
  for (std::size_t k = 2; k < outline.size(); ++k) {
    const Vec3 b = outline[k - 1] - point;
    const Vec3 c = outline[k] - point;
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    angle += 2 * std::atan2(a.dot(b.cross(c)),
                            la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return angle;
}

}  // namespace

int winding_number(const SurfacePieces& pieces, const SurfacePiece& piece, const Vec3& point) {
  double angle = 0;
  for (const std::int32_t f : piece.facets) angle += solid_angle(pieces.outline(f), point);
  return static_cast<int>(std::lround(angle / (4 * kPi)));
}

WindingNumber::WindingNumber(const SurfacePieces& pieces, const SurfacePiece& piece)
    : pieces_(pieces), piece_(piece), facets_(piece.facets) {
  for (const std::int32_t f : facets_) {
    for (const Vec3& corner : pieces.outline(f)) box_.extend(corner);
  }
  if (!facets_.empty()) build(0, static_cast<std::int32_t>(facets_.size()));
}

void WindingNumber::build(std::int32_t begin, std::int32_t end) {
  constexpr std::int32_t kLeafSize = 4;
  Node node{begin, end, -1, Vec3::Zero(), 0, Vec3::Zero(), 0};
  Box3 box;
  for (std::int32_t k = begin; k < end; ++k) {
    const std::span<const Vec3> outline = pieces_.outline(facets_[k]);
    const Vec3 facet_area = vector_area(outline);
    node.vector_area += facet_area;
    node.area += facet_area.norm();
    for (const Vec3& corner : outline) box.extend(corner);
  }
  node.center = box.center();
  node.radius = 0.5 * box.diagonal().norm();
  const std::size_t self = nodes_.size();
  nodes_.push_back(node);
  if (end - begin <= kLeafSize) return;

  int axis = 0;
  box.sizes().maxCoeff(&axis);
  std::vector<std::pair<double, std::int32_t>> places;
  for (std::int32_t k = begin; k < end; ++k) {
    places.emplace_back(pieces_.outline(facets_[k])[0][axis], facets_[k]);
  }
  const std::int32_t half = (end - begin) / 2;
  std::nth_element(places.begin(), places.begin() + half, places.end());
  for (std::int32_t k = begin; k < end; ++k) facets_[k] = places[k - begin].second;
  build(begin, begin + half);
  nodes_[self].right = static_cast<std::int32_t>(nodes_.size());
  build(begin + half, end);
}

int WindingNumber::about(const Vec3& point) const {
  if (nodes_.empty() || !box_.contains(point)) return 0;
  for (const double far_radii : kFarRadii) {
    Sum sum;
    add(0, point, far_radii, sum);
    const double number = sum.angle / (4 * kPi);
    const double doubt = std::abs(number - std::round(number)) + sum.error / (4 * kPi);
    if (doubt < 0.5 - kLeastDoubt) return static_cast<int>(std::lround(number));
  }
  return winding_number(pieces_, piece_, point);
}

/// Adds the solid angle of a node's facets. Of dA at x it is dA · K(x), K(x) = (x - p) / |x - p|³,
/// and |K(x) - K(c)| is at most |x - c| times 2 / r³, the largest that K changes by at a distance
/// r.
void WindingNumber::add(std::int32_t n, const Vec3& point, double far_radii, Sum& sum) const {
  const Node& node = nodes_[n];
  const Vec3 away = node.center - point;
  const double distance = away.norm();
  if (distance > far_radii * node.radius && distance > 0) {
    const double nearest = distance - node.radius;
    sum.angle += node.vector_area.dot(away) / (distance * distance * distance);
    sum.error += node.area * node.radius * 2 / (nearest * nearest * nearest);
  } else if (node.right >= 0) {
    add(n + 1, point, far_radii, sum);
    add(node.right, point, far_radii, sum);
  } else {
    for (std::int32_t k = node.begin; k < node.end; ++k) {
      sum.angle += solid_angle(pieces_.outline(facets_[k]), point);
    }
  }
}

}  // namespace radiosity
