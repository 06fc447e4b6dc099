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
  for (const Vec3& x : source) {
    for (const Vec3& y : target) {
      const Vec3 way = y - x;
      const double length = way.norm();
      const Vec3 direction = length > 0 ? Vec3(way / length) : Vec3(Vec3::Zero());
      const Vec3 moment = x.cross(direction);
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
SegmentBundle::sides(const Vec3& start, const Vec3& end) const {
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

SegmentBundle::Verdict SegmentBundle::test(const Blocker& blocker, Shadow* shadow) const {
  if ((blocker.box.min().array() >= box_.max().array() - thickness_).any() ||
      (box_.min().array() >= blocker.box.max().array() - thickness_).any()) {
    return {Blocking::none};
  }
  enum class Side { front, behind, divided };
  std::array<Side, Blocker::kMostFaces> side;
  std::array<bool, Blocker::kMostFaces> is_target_behind;
  Verdict verdict;
  bool any_front = false;
  bool is_target_outside = false;
  bool is_target_beside = false;
  bool is_source_on = false;
  bool is_target_on_front = false;
  const HalfSpace* target_divider = nullptr;
  for (std::size_t f = 0; f < blocker.faces.size(); ++f) {
    const HalfSpace& face = blocker.faces[f];
    const Range a = range_over(source_, face.normal);
    const Range b = range_over(target_, face.normal);
    const double above = face.offset + thickness_;
    const double below = face.offset - thickness_;
    if (a.low >= below && b.low >= below) return {Blocking::none};
    if (blocker.is_flat() && a.low >= below && a.high <= above) return {Blocking::none};
    side[f] = a.high <= above ? Side::behind : a.low >= below ? Side::front : Side::divided;
    if (side[f] == Side::divided && verdict.divides_source == nullptr) {
      verdict.divides_source = &face;
    }
    any_front |= side[f] == Side::front;
    is_target_behind[f] = b.high <= above;
    is_target_on_front |= side[f] == Side::front && b.high >= below;
    is_target_outside |= b.high > above && b.low >= below;
    // What lies on a face is not hidden from what is in front of that face.
    is_target_beside |= a.high >= below && b.high > above;
    is_source_on |= a.high >= below && a.low >= below && b.high > above;
    if (b.high > above && b.low < below) target_divider = &face;
  }
  if (!any_front && verdict.divides_source == nullptr) {
    // The source is inside. What is outside, too, sees it not; what is divided has to be divided.
    const bool is_beside = is_source_on || (is_target_beside && !is_flat(source_, thickness_));
    if (is_target_outside && !is_beside) return {Blocking::all};
    if (target_divider == nullptr) return {Blocking::none};
    verdict.divides_target = target_divider;
    return verdict;
  }
  const std::size_t first_edge = shadow != nullptr ? shadow->edges.size() : 0;
  bool hides_all = true;
  for (const Blocker::Edge& edge : blocker.edges) {
    const Side left = side[edge.left];
    const Side right = side[edge.right];
    if (left == right || left == Side::divided || right == Side::divided) continue;
    const Vec3& start = left == Side::front ? edge.start : edge.end;
    const Vec3& end = left == Side::front ? edge.end : edge.start;
    const Range range = sides(start, end);
    if (range.high <= thickness_) {
      if (shadow != nullptr) shadow->edges.resize(first_edge);
      return {Blocking::none};
    }
    if (range.low >= -thickness_) continue;
    hides_all = false;
    if (shadow != nullptr) shadow->edges.push_back({start, end});
  }
  if (verdict.divides_source != nullptr) {
    if (shadow != nullptr) shadow->edges.resize(first_edge);
    return verdict;
  }
  for (std::size_t f = 0; f < blocker.faces.size(); ++f) {
    if (side[f] != Side::front || is_target_behind[f]) continue;
    hides_all = false;
    if (shadow != nullptr) shadow->faces.push_back(blocker.faces[f]);
  }
  // What touches a face from outside is seen; a polygon does so with nothing but its border.
  if (hides_all && (!is_target_on_front || is_flat(target_, thickness_))) {
    verdict.blocking = Blocking::all;
  }
  return verdict;
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
