#include "radiosity/segment_bundle.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace radiosity {

namespace {

/// Whether the corners, of a convex polygon or of a box, lie in one plane.
bool is_flat(std::span<const Vec3> corners, double thickness) {
  const Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
  return std::all_of(corners.begin(), corners.end(), [&](const Vec3& corner) {
    return std::abs(normal.dot(corner - corners.front())) <= thickness;
  });
}

}  // namespace

void Shadow::clear() {
  edges.clear();
  faces.clear();
}

SegmentBundle::SegmentBundle(std::span<const Vec3> source, std::span<const Vec3> target,
                             double thickness)
    : source_(source), target_(target), thickness_(thickness) {
  assert(source.size() <= kMostCorners && target.size() <= kMostCorners);
  for (const Vec3& point : source) box_.extend(point);
  for (const Vec3& point : target) box_.extend(point);
  least_side_ = thickness * box_.diagonal().norm();
  for (const Vec3& x : source) {
    for (const Vec3& y : target) {
      const Vec3 direction = y - x;
      const Vec3 moment = x.cross(y);
      for (int axis = 0; axis < 3; ++axis) {
        lines_[axis][n_lines_] = direction[axis];
        lines_[3 + axis][n_lines_] = moment[axis];
      }
      ++n_lines_;
    }
  }
  for (; n_lines_ % kLanes != 0; ++n_lines_) {
    for (auto& coordinate : lines_) coordinate[n_lines_] = coordinate[0];
  }
}

SegmentBundle::Range SegmentBundle::range_over(std::span<const Vec3> points, const Vec3& normal) {
  Range range{1e300, -1e300};
  for (const Vec3& point : points) {
    const double height = normal.dot(point);
    range.low = std::min(range.low, height);
    range.high = std::max(range.high, height);
  }
  return range;
}

__attribute__((target_clones("arch=x86-64-v3", "default"))) SegmentBundle::Range
SegmentBundle::passing_of(const Vec3& start, const Vec3& end) const {
  // The side operator of two lines in Plücker coordinates. (Stolfi 1991)
  const Vec3 direction = (end - start).normalized();
  const Vec3 moment = start.cross(direction);
  double low[kLanes];
  double high[kLanes];
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    low[lane] = 1e300;
    high[lane] = -1e300;
  }
  for (std::size_t k = 0; k < n_lines_; k += kLanes) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const std::size_t line = k + lane;
      const double side = -(lines_[0][line] * moment.x() + lines_[1][line] * moment.y() +
                            lines_[2][line] * moment.z() + lines_[3][line] * direction.x() +
                            lines_[4][line] * direction.y() + lines_[5][line] * direction.z());
      low[lane] = side < low[lane] ? side : low[lane];
      high[lane] = side > high[lane] ? side : high[lane];
    }
  }
  return {*std::min_element(low, low + kLanes), *std::max_element(high, high + kLanes)};
}

std::optional<SegmentBundle::Sides> SegmentBundle::find_sides(const Blocker& blocker) const {
  Sides sides;
  for (std::size_t f = 0; f < blocker.faces.size(); ++f) {
    const HalfSpace& face = blocker.faces[f];
    const Range a = range_over(source_, face.normal);
    const Range b = range_over(target_, face.normal);
    const double above = face.offset + thickness_;
    const double below = face.offset - thickness_;
    if (a.low >= below && b.low >= below) return std::nullopt;
    const bool is_source_on = a.low >= below && a.high <= above;
    if (blocker.is_flat() && is_source_on) return std::nullopt;
    sides.of_source[f] = a.high <= above ? Side::behind : a.low >= below ? Side::front : Side::both;
    if (sides.of_source[f] == Side::both && sides.source_divider == nullptr) {
      sides.source_divider = &face;
    }
    sides.is_target_behind[f] = b.high <= above;
    sides.sees_a_face |= sides.of_source[f] == Side::front;
    sides.touches_seen_face |= sides.of_source[f] == Side::front && b.high >= below;
    sides.is_target_outside |= b.high > above && b.low >= below;
    // What lies on a face is not hidden from what is in front of that face.
    sides.is_source_on_face |= is_source_on && b.high > above;
    sides.touches_own_face |= a.high >= below && b.high > above;
    if (b.high > above && b.low < below) sides.target_divider = &face;
  }
  return sides;
}

/// The source is inside the blocker. What is outside does not see it; what is divided has to be
/// divided to tell.
SegmentBundle::Verdict SegmentBundle::test_from_inside(const Sides& sides) const {
  const bool is_on_surface =
      sides.is_source_on_face || (sides.touches_own_face && !is_flat(source_, thickness_));
  if (sides.is_target_outside && !is_on_surface) return {Blocking::all};
  if (sides.target_divider == nullptr) return {Blocking::none};
  return {Blocking::some, nullptr, sides.target_divider};
}

SegmentBundle::Verdict SegmentBundle::test(const Blocker& blocker, Shadow* shadow) const {
  if ((blocker.box.min().array() >= box_.max().array() - thickness_).any() ||
      (box_.min().array() >= blocker.box.max().array() - thickness_).any()) {
    return {Blocking::none};
  }
  const std::optional<Sides> found = find_sides(blocker);
  if (!found) return {Blocking::none};
  const Sides& sides = *found;
  if (!sides.sees_a_face && sides.source_divider == nullptr) return test_from_inside(sides);

  const std::size_t n_edges = shadow != nullptr ? shadow->edges.size() : 0;
  bool hides_all = true;
  for (const Blocker::Edge& edge : blocker.edges) {
    const Side left = sides.of_source[edge.left];
    const Side right = sides.of_source[edge.right];
    if (left == right || left == Side::both || right == Side::both) continue;
    const Vec3& start = left == Side::front ? edge.start : edge.end;
    const Vec3& end = left == Side::front ? edge.end : edge.start;
    const Range passing = passing_of(start, end);
    if (passing.high <= least_side_) {
      if (shadow != nullptr) shadow->edges.resize(n_edges);
      return {Blocking::none};
    }
    if (passing.low >= -least_side_) continue;
    hides_all = false;
    if (shadow != nullptr) shadow->edges.push_back({start, end});
  }
  if (sides.source_divider != nullptr) {
    if (shadow != nullptr) shadow->edges.resize(n_edges);
    return {Blocking::some, sides.source_divider, nullptr};
  }
  for (std::size_t f = 0; f < blocker.faces.size(); ++f) {
    if (sides.of_source[f] != Side::front || sides.is_target_behind[f]) continue;
    hides_all = false;
    if (shadow != nullptr) shadow->faces.push_back(blocker.faces[f]);
  }
  // What touches a face from outside is seen; a polygon does so with nothing but its border.
  hides_all &= !sides.touches_seen_face || is_flat(target_, thickness_);
  return {hides_all ? Blocking::all : Blocking::some};
}

bool SegmentBundle::is_separated(const Blocker& blocker) const {
  const auto are_beyond = [](std::span<const Vec3> points, const Vec3& normal, double least) {
    return std::all_of(points.begin(), points.end(),
                       [&](const Vec3& point) { return normal.dot(point) >= least; });
  };
  const auto separates = [&](const Vec3& normal, double offset) {
    return are_beyond(blocker.corners, -normal, -offset - thickness_) &&
           are_beyond(source_, normal, offset - thickness_) &&
           are_beyond(target_, normal, offset - thickness_);
  };
  for (const Blocker::Edge& edge : blocker.edges) {
    const Vec3 way = edge.end - edge.start;
    for (const std::span<const Vec3> corners : {source_, target_}) {
      for (const Vec3& corner : corners) {
        Vec3 normal = way.cross(corner - edge.start);
        const double length = normal.norm();
        if (length <= thickness_ * way.norm()) continue;
        normal /= length;
        const double offset = normal.dot(edge.start);
        if (separates(normal, offset) || separates(-normal, -offset)) return true;
      }
    }
  }
  return false;
}

}  // namespace radiosity
