#include "radiosity/visibility/segment_bundle.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace radiosity {

namespace {

/// Edges of less than so many thicknesses have no direction that a proof could rest on.
constexpr double kShortEdge = 16;

}  // namespace

void Shadow::clear() {
  edges.clear();
  faces.clear();
}

SegmentBundle::End SegmentBundle::make_end(const ConvexSet& set) {
  End end{set.corners, Vec3::Zero(), 0, set.is_flat};
  for (const Vec3& corner : set.corners) end.center += corner;
  end.center /= static_cast<double>(set.corners.size());
  double square = 0;
  for (const Vec3& corner : set.corners)
    square = std::max(square, (corner - end.center).squaredNorm());
  end.radius = std::sqrt(square);
  return end;
}

SegmentBundle::SegmentBundle(const ConvexSet& source, const ConvexSet& target, double thickness)
    : thickness_(thickness),
      source_(make_end(source)),
      target_(make_end(target)),
      axis_(target_.center - source_.center),
      radius_(std::max(source_.radius, target_.radius)) {
  assert(source.corners.size() <= kMostCorners && target.corners.size() <= kMostCorners);
  for (const Vec3& point : source.corners) box_.extend(point);
  for (const Vec3& point : target.corners) box_.extend(point);
  for (const Vec3& x : source.corners) {
    for (const Vec3& y : target.corners) {
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

SegmentBundle::Range SegmentBundle::range_over(std::span<const Vec3> points,
                                               const HalfSpace& plane) {
  Range range{1e300, -1e300};
  for (const Vec3& point : points) {
    const double height = plane.normal.dot(point) - plane.offset;
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

bool SegmentBundle::all_pass(const Vec3& start, const Vec3& end, double sign) const {
  // Moving one end of a segment by the thickness changes its side by the thickness times the other
  // end's distance from the edge's line; either may be off.
  const Vec3 direction = (end - start).normalized();
  std::array<double, kMostCorners> distances;
  for (std::size_t k = 0; k < target_.corners.size(); ++k) {
    distances[k] = direction.cross(target_.corners[k] - start).norm();
  }
  for (const Vec3& x : source_.corners) {
    const Vec3 lever = direction.cross(x - start);
    const double distance = lever.norm();
    for (std::size_t k = 0; k < target_.corners.size(); ++k) {
      const double passing = -lever.dot(target_.corners[k] - start);
      if (sign * passing < -thickness_ * (distance + distances[k])) return false;
    }
  }
  return true;
}

SegmentBundle::Side SegmentBundle::side(const Range& height) const {
  if (height.high <= thickness_) return Side::behind;
  return height.low >= -thickness_ ? Side::front : Side::both;
}

bool SegmentBundle::is_on(const Range& height) const {
  return height.low >= -thickness_ && height.high <= thickness_;
}

bool SegmentBundle::is_out_of_reach(const Blocker& blocker) const {
  if ((blocker.box.min().array() >= box_.max().array() - thickness_).any() ||
      (box_.min().array() >= blocker.box.max().array() - thickness_).any()) {
    return true;
  }
  const Vec3 way = blocker.center - source_.center;
  const double square = axis_.squaredNorm();
  const double place = square > 0 ? std::clamp(axis_.dot(way) / square, 0.0, 1.0) : 0;
  const double reach = radius_ + blocker.radius;
  return (way - place * axis_).squaredNorm() > reach * reach;
}

bool SegmentBundle::find_heights(const Blocker& blocker, Heights& heights) const {
  const bool is_flat = blocker.is_flat();
  for (std::size_t f = 0; f < blocker.faces.size(); ++f) {
    Range& a = heights.of_source[f];
    Range& b = heights.of_target[f];
    if (is_flat && f == 1) {
      a = {-heights.of_source[0].high, -heights.of_source[0].low};
      b = {-heights.of_target[0].high, -heights.of_target[0].low};
    } else {
      a = range_over(source_.corners, blocker.faces[f]);
      b = range_over(target_.corners, blocker.faces[f]);
    }
    if (a.low >= -thickness_ && b.low >= -thickness_) return false;
    // What is in a polygon's plane is not hidden by it.
    if (is_flat && (is_on(a) || is_on(b))) return false;
  }
  return true;
}

/// What is outside does not see the inside, but for what lies on a face and looks out of it.
Blocking SegmentBundle::look_from_inside(const Blocker& blocker, const End& end,
                                         std::span<const Range> own,
                                         std::span<const Range> other) const {
  bool is_other_inside = true;
  bool is_other_outside = false;
  bool looks_out = false;
  for (std::size_t f = 0; f < blocker.faces.size(); ++f) {
    const bool is_beyond = other[f].high > thickness_;
    is_other_inside &= !is_beyond;
    is_other_outside |= is_beyond && other[f].low >= -thickness_;
    const bool touches = own[f].high >= -thickness_ && (!end.is_flat || is_on(own[f]));
    looks_out |= touches && is_beyond;
  }
  if (is_other_inside) return Blocking::none;
  return is_other_outside && !looks_out ? Blocking::all : Blocking::some;
}

SegmentBundle::Outlook SegmentBundle::look(const Blocker& blocker, const Heights& heights,
                                           bool from_source, Shadow* shadow) const {
  const End& end = from_source ? source_ : target_;
  const End& there = from_source ? target_ : source_;
  const std::span own(from_source ? heights.of_source.data() : heights.of_target.data(),
                      blocker.faces.size());
  const std::span other(from_source ? heights.of_target.data() : heights.of_source.data(),
                        blocker.faces.size());
  std::array<Side, Blocker::kMostFaces> sides;
  Outlook outlook;
  bool sees_a_face = false;
  bool hides_all = true;
  for (std::size_t f = 0; f < blocker.faces.size(); ++f) {
    sides[f] = side(own[f]);
    if (sides[f] == Side::both && outlook.divider == nullptr) outlook.divider = &blocker.faces[f];
    if (sides[f] != Side::front) continue;
    sees_a_face = true;
    // What is not a flat set may have patches in a plane that it touches: those of the other end
    // are seen there, and those of this end are not behind a polygon that they lie beside.
    hides_all &= other[f].high <= thickness_;
    hides_all &= there.is_flat || other[f].high < -thickness_;
    if (blocker.is_flat()) hides_all &= end.is_flat || own[f].low > thickness_;
  }
  if (!sees_a_face && outlook.divider == nullptr) {
    outlook.is_inside = true;
    outlook.blocking = look_from_inside(blocker, end, own, other);
    return outlook;
  }
  hides_all &= outlook.divider == nullptr;

  const double largest_tolerance = 2 * thickness_ * (box_.merged(blocker.box)).diagonal().norm();
  const std::size_t n_edges = shadow != nullptr ? shadow->edges.size() : 0;
  for (const Blocker::Edge& edge : blocker.edges) {
    const Side left = sides[edge.left];
    const Side right = sides[edge.right];
    if (left == right || left == Side::both || right == Side::both) continue;
    const Vec3& start = left == Side::front ? edge.start : edge.end;
    const Vec3& stop = left == Side::front ? edge.end : edge.start;
    Range passing = passing_of(start, stop);
    if (!from_source) passing = {-passing.high, -passing.low};
    const double way = from_source ? 1 : -1;
    const bool may_miss = passing.high <= largest_tolerance;
    const bool may_hide = passing.low >= -largest_tolerance;
    const double least_length = kShortEdge * thickness_;
    const bool is_short = (stop - start).squaredNorm() <= least_length * least_length;
    if (may_miss && !is_short && (passing.high <= 0 || all_pass(start, stop, -way))) {
      if (shadow != nullptr) shadow->edges.resize(n_edges);
      outlook.blocking = Blocking::none;
      return outlook;
    }
    if (may_hide && (passing.low >= 0 || all_pass(start, stop, way))) continue;
    hides_all = false;
    if (shadow != nullptr) shadow->edges.push_back({start, stop});
  }
  if (hides_all) outlook.blocking = Blocking::all;
  if (shadow == nullptr) return outlook;
  if (hides_all || outlook.divider != nullptr) {
    shadow->edges.resize(n_edges);
    return outlook;
  }
  for (std::size_t f = 0; f < blocker.faces.size(); ++f) {
    if (sides[f] == Side::front && other[f].high > thickness_) {
      shadow->faces.push_back(blocker.faces[f]);
    }
  }
  return outlook;
}

SegmentBundle::Verdict SegmentBundle::test(const Blocker& blocker, Shadow* shadow) const {
  assert(blocker.faces.size() <= Blocker::kMostFaces);
  if (is_out_of_reach(blocker)) return {Blocking::none};
  if (!blocker.outer.empty()) {
    if (misses(blocker.outer[0])) return {Blocking::none};
    if (!blocker.inner.empty()) {
      const bool hides = blocker.is_flat()
                             ? test(blocker.inner[0]).blocking == Blocking::all
                             : is_end_outside(blocker.outer[0]) && is_pierced(blocker.inner[0]);
      if (hides) return {Blocking::all};
    }
  }
  Heights heights;
  if (!find_heights(blocker, heights)) return {Blocking::none};
  const std::size_t n_edges = shadow != nullptr ? shadow->edges.size() : 0;
  const std::size_t n_faces = shadow != nullptr ? shadow->faces.size() : 0;
  const Outlook from_source = look(blocker, heights, true, shadow);
  if (from_source.blocking != Blocking::some) return {from_source.blocking};
  // Seen from behind, a polygon shows the same edges.
  const bool is_seen_alike = blocker.is_flat() && from_source.divider == nullptr &&
                             side(heights.of_target[0]) != Side::both && source_.is_flat &&
                             target_.is_flat;
  if (is_seen_alike) return {Blocking::some};
  const Outlook from_target = look(blocker, heights, false, nullptr);
  if (from_target.blocking != Blocking::some) {
    if (shadow != nullptr) {
      shadow->edges.resize(n_edges);
      shadow->faces.resize(n_faces);
    }
    return {from_target.blocking};
  }
  if (from_source.divider != nullptr) return {Blocking::some, from_source.divider, nullptr};
  if (!from_source.is_inside) return {Blocking::some};
  // Seen from inside, the target has to be divided to tell.
  for (std::size_t f = 0; f < blocker.faces.size(); ++f) {
    const Range& height = heights.of_target[f];
    if (height.high > thickness_ && height.low < -thickness_) {
      return {Blocking::some, nullptr, &blocker.faces[f]};
    }
  }
  return {Blocking::some};
}

bool SegmentBundle::misses(const Blocker& blocker) const {
  if (is_out_of_reach(blocker)) return true;
  Heights heights;
  if (!find_heights(blocker, heights)) return true;
  const auto is_missed_from = [&](bool source) {
    const Outlook outlook = look(blocker, heights, source, nullptr);
    return outlook.blocking == Blocking::none && !outlook.is_inside;
  };
  return is_missed_from(true) || is_missed_from(false);
}

bool SegmentBundle::is_pierced(const Blocker& body) const {
  if (is_out_of_reach(body)) return false;
  std::array<std::array<double, kMostCorners>, Blocker::kMostFaces> there;
  const std::size_t n_faces = body.faces.size();
  for (std::size_t f = 0; f < n_faces; ++f) {
    for (std::size_t k = 0; k < target_.corners.size(); ++k) {
      there[f][k] = body.faces[f].normal.dot(target_.corners[k]) - body.faces[f].offset;
    }
  }
  std::array<double, Blocker::kMostFaces> here;
  for (const Vec3& x : source_.corners) {
    for (std::size_t f = 0; f < n_faces; ++f) {
      here[f] = body.faces[f].normal.dot(x) - body.faces[f].offset;
    }
    for (std::size_t k = 0; k < target_.corners.size(); ++k) {
      double first = 0;
      double last = 1;
      for (std::size_t f = 0; f < n_faces && first < last; ++f) {
        const double a = here[f];
        const double b = there[f][k];
        if (a >= 0 && b >= 0) return false;
        if (a > 0) first = std::max(first, a / (a - b));
        if (b > 0) last = std::min(last, a / (a - b));
      }
      if (first >= last) return false;
    }
  }
  return true;
}

bool SegmentBundle::is_end_outside(const Blocker& body) const {
  return std::any_of(body.faces.begin(), body.faces.end(), [this](const HalfSpace& face) {
    return range_over(source_.corners, face).low >= -thickness_ ||
           range_over(target_.corners, face).low >= -thickness_;
  });
}

}  // namespace radiosity
