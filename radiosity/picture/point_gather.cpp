#include "radiosity/picture/point_gather.h"

#include <algorithm>
#include <array>
#include <utility>

#include "radiosity/base/median_split.h"
#include "radiosity/polygon/convex_hull.h"
#include "radiosity/polygon/point_to_polygon.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/scene/whole_mesh.h"
#include "radiosity/visibility/point_shadow.h"

namespace radiosity {
namespace {

/// So few points are not divided further.
constexpr std::size_t kFewPoints = 8;
/// Hulls with more corners are replaced by their rectangle: every test loops over them.
constexpr std::size_t kMostCorners = 10;

/// Distances, in units of the rectangle's radius, from which on an order of interpolation does.
std::array<double, RectangleInterpolation::kLargestOrder + 1> make_least_ratios() {
  std::array<double, RectangleInterpolation::kLargestOrder + 1> least{};
  for (int order = 2; order <= RectangleInterpolation::kLargestOrder; ++order) {
    double ratio = 1;
    const auto does = [&] {
      const int found = RectangleInterpolation::least_order(ratio, kInterpolationTolerance);
      return found > 0 && found <= order;
    };
    while (!does()) ratio *= 1.05;
    least[order] = ratio;
  }
  return least;
}

}  // namespace

GatherScene::GatherScene(const PatchMesh& mesh, const Eigen::MatrixXd& patch_radiosity)
    : PreparedMesh(WholeMesh(mesh).mesh()),
      radiosity(
          patch_radiosity.transpose().replicate(1, static_cast<Index>(mesh.images.size()) + 1)) {
  for (Index i = 0; i < radiosity.cols(); ++i) is_dark.push_back(radiosity.col(i).isZero(0));
}

void PointGather::gather(const HalfSpace& plane, std::span<GatherPoint> points,
                         Eigen::MatrixXd& irradiance) {
  if (points.empty() || scene_.tree.clusters.empty()) return;
  plane_ = plane;
  irradiance_ = &irradiance;
  clipped_.clear();
  if (levels_.empty()) levels_.emplace_back();
  levels_[0].targets.clear();
  levels_[0].blockers.clear();

  const Source source = make_source(points);
  Cluster source_cluster;
  source_cluster.outline = source.outline;
  source_cluster.is_flat = true;
  for (const Vec3& corner : source.outline) source_cluster.box.extend(corner);
  source_cluster.plane = plane;
  walk(source_cluster, 0, all_candidates(scene_.blockers), source);
  resolve(source, 0);
}

void PointGather::visit(const HalfSpace& plane, const Vec3& point, const PieceVisitor& visitor) {
  visitor_ = &visitor;
  Eigen::MatrixXd unused;
  std::array<GatherPoint, 1> points = {GatherPoint{point, 0}};
  gather(plane, points, unused);
  visitor_ = nullptr;
}

PointGather::Source PointGather::make_source(std::span<GatherPoint> points) const {
  const Vec3 u = plane_.normal.unitOrthogonal();
  const Vec3 v = plane_.normal.cross(u);
  const double thickness = scene_.thickness;
  Source source;
  source.points = points;
  std::vector<Point2> places;
  for (const GatherPoint& point : points) {
    const Vec3 way = point.position - points.front().position;
    places.emplace_back(u.dot(way), v.dot(way));
  }
  for (const std::int32_t k : convex_hull(places, thickness)) {
    source.outline.push_back(points[k].position);
  }
  if (source.outline.empty()) {
    // A point or a line is widened by what counts as the same place.
    const auto along = [&](const GatherPoint& a, const GatherPoint& b) {
      const Vec3 way_a = a.position - points.front().position;
      const Vec3 way_b = b.position - points.front().position;
      return std::pair(u.dot(way_a), v.dot(way_a)) < std::pair(u.dot(way_b), v.dot(way_b));
    };
    const auto [first, last] = std::minmax_element(points.begin(), points.end(), along);
    Vec3 way = last->position - first->position;
    way = way.squaredNorm() > 0 ? Vec3(way.normalized()) : u;
    const Vec3 ahead = 0.5 * thickness * way;
    const Vec3 aside = plane_.normal.cross(ahead);
    source.outline = {first->position - ahead - aside, last->position + ahead - aside,
                      last->position + ahead + aside, first->position - ahead + aside};
  }
  source.rectangle = bounding_rectangle(source.outline, plane_.normal);
  if (source.outline.size() > kMostCorners) {
    const Rectangle& r = source.rectangle;
    source.outline = {r.center - r.half_u - r.half_v, r.center + r.half_u - r.half_v,
                      r.center + r.half_u + r.half_v, r.center - r.half_u + r.half_v};
  }
  return source;
}

void PointGather::walk(const Cluster& source_cluster, std::int32_t cluster,
                       const Candidates& candidates, const Source& source) {
  const Cluster& there = scene_.tree.clusters[cluster];
  const double thickness = scene_.thickness;
  if (are_averted(source_cluster, there, thickness)) return;
  const auto kept =
      possible_blockers(source_cluster, there, scene_.blockers, candidates, thickness);
  if (!kept) return;
  if (!there.is_leaf()) {
    walk(source_cluster, there.left, *kept, source);
    walk(source_cluster, there.right, *kept, source);
    return;
  }
  for (Index k = there.begin; k < there.end; ++k) add_patch(scene_.tree.order[k], *kept, source);
}

const ConvexPolygon& PointGather::polygon(const Target& target) const {
  return target.clipped < 0 ? scene_.polygons[target.patch] : clipped_[target.clipped];
}

bool PointGather::is_behind(const Vec3& point, std::int32_t patch) const {
  const HalfSpace& plane = scene_.planes[patch];
  return plane.normal.dot(point) <= plane.offset + scene_.thickness;
}

void PointGather::add_patch(std::int32_t patch, const Candidates& candidates,
                            const Source& source) {
  if (scene_.is_dark[patch]) return;
  const bool is_averted =
      std::all_of(source.points.begin(), source.points.end(),
                  [&](const GatherPoint& point) { return is_behind(point.position, patch); });
  if (is_averted) return;
  const ConvexPolygon& whole = scene_.polygons[patch];
  const bool is_in_front = std::all_of(whole.begin(), whole.end(), [&](const Vec3& corner) {
    return plane_.normal.dot(corner) >= plane_.offset;
  });
  Target target{patch, -1, levels_[0].blockers.size(), candidates.size()};
  if (!is_in_front) {
    const ConvexPolygon part = clip_to_half_space(whole.points(), plane_.normal * plane_.offset,
                                                  plane_.normal, scene_.thickness);
    if (part.empty()) return;
    target.clipped = static_cast<std::int32_t>(clipped_.size());
    clipped_.push_back(part);
  }
  if (candidates.empty()) {
    add_visible(target, source);
    return;
  }
  Level& level = levels_[0];
  level.blockers.insert(level.blockers.end(), candidates.begin(), candidates.end());
  level.targets.push_back(target);
}

void PointGather::resolve(const Source& source, std::size_t depth) {
  if (levels_.size() <= depth + 1) levels_.resize(depth + 2);
  const Level& level = levels_[depth];
  Level& next = levels_[depth + 1];
  next.targets.clear();
  next.blockers.clear();
  const bool is_last = source.points.size() <= kFewPoints;
  for (const Target& target : level.targets) {
    const std::span blockers(level.blockers.data() + target.first_blocker, target.n_blockers);
    const Blocking blocking = find_open(polygon(target), blockers, source);
    if (blocking == Blocking::all) continue;
    if (blocking == Blocking::none) {
      add_visible(target, source);
    } else if (is_last) {
      add_partial(target, source);
    } else {
      next.targets.push_back({target.patch, target.clipped, next.blockers.size(), open_.size()});
      next.blockers.insert(next.blockers.end(), open_.begin(), open_.end());
    }
  }
  interpolate(source);
  if (next.targets.empty()) return;
  for (const auto half : halved(source)) resolve(make_source(half), depth + 1);
}

std::array<std::span<GatherPoint>, 2> PointGather::halved(const Source& source) {
  const Rectangle& r = source.rectangle;
  const Vec3 axis = r.half_u.squaredNorm() >= r.half_v.squaredNorm() ? r.half_u : r.half_v;
  return split_at_median(source.points, [&](const GatherPoint& point) {
    return std::pair(axis.dot(point.position), point.column);
  });
}

Blocking PointGather::find_open(const ConvexPolygon& target, std::span<const std::int32_t> blockers,
                                const Source& source) {
  const bool is_last = source.points.size() <= kFewPoints;
  const SegmentBundle bundle({source.outline, true}, {target.points(), true}, scene_.thickness);
  open_.clear();
  point_by_point_.clear();
  n_shadows_ = 0;
  for (const std::int32_t k : blockers) {
    Shadow* shadow = nullptr;
    if (is_last) shadow = &next_shadow();
    const SegmentBundle::Verdict verdict = bundle.test(scene_.blockers.blocker(k), shadow);
    if (verdict.blocking == Blocking::all) return Blocking::all;
    if (verdict.blocking == Blocking::none) continue;
    open_.push_back(k);
    if (!is_last) continue;
    if (verdict.divides_source != nullptr || verdict.divides_target != nullptr) {
      point_by_point_.push_back(k);
    } else {
      ++n_shadows_;
    }
  }
  return open_.empty() ? Blocking::none : Blocking::some;
}

Shadow& PointGather::next_shadow() {
  if (shadows_.size() <= n_shadows_) shadows_.resize(n_shadows_ + 1);
  shadows_[n_shadows_].clear();
  return shadows_[n_shadows_];
}

void PointGather::add_partial(const Target& target, const Source& source) {
  const ConvexPolygon& part = polygon(target);
  const std::size_t n_common = n_shadows_;
  for (const GatherPoint& point : source.points) {
    if (is_behind(point.position, target.patch)) continue;
    n_shadows_ = n_common;
    bool is_hidden = false;
    for (const std::int32_t k : point_by_point_) {
      const Blocking blocking = add_point_shadow(scene_.blockers.blocker(k), point.position,
                                                 part.points(), scene_.thickness, next_shadow());
      is_hidden |= blocking == Blocking::all;
      if (blocking == Blocking::some) ++n_shadows_;
    }
    if (is_hidden) continue;
    if (visitor_ != nullptr) {
      const std::span<const Shadow> shadows(shadows_.data(), n_shadows_);
      for (const ConvexPolygon& piece : cutter_.visible_parts(point.position, part, shadows)) {
        (*visitor_)(target.patch, piece.points());
      }
      continue;
    }
    const double whole = facing_point_to_polygon(point.position, plane_.normal, part.points());
    add(target.patch,
        cutter_.visible_part(point.position, plane_.normal, part, whole,
                             {shadows_.data(), n_shadows_}),
        point.column);
  }
}

void PointGather::add_visible(const Target& target, const Source& source) {
  static const auto kLeastRatios = make_least_ratios();
  const ConvexPolygon& part = polygon(target);
  const Rectangle& r = source.rectangle;
  const Disc& disc = scene_.discs[target.patch];
  const double distance = (disc.center - r.center).norm() - disc.radius;
  int order = 2;
  while (order <= RectangleInterpolation::kLargestOrder &&
         distance < kLeastRatios[order] * r.radius()) {
    ++order;
  }
  const bool pays = static_cast<std::size_t>(order) * order < source.points.size();
  const HalfSpace& plane = scene_.planes[target.patch];
  const double reach = std::abs(plane.normal.dot(r.half_u)) + std::abs(plane.normal.dot(r.half_v));
  const bool is_in_front = plane.normal.dot(r.center) - reach > plane.offset;
  if (order > RectangleInterpolation::kLargestOrder || !pays || !is_in_front) {
    for (const GatherPoint& point : source.points) {
      if (is_behind(point.position, target.patch)) continue;
      if (visitor_ != nullptr) {
        (*visitor_)(target.patch, part.points());
        continue;
      }
      add(target.patch, facing_point_to_polygon(point.position, plane_.normal, part.points()),
          point.column);
    }
    return;
  }
  Nodes& nodes = nodes_[order];
  if (!nodes.interpolation) {
    nodes.interpolation.emplace(r, order);
    nodes.irradiance.setZero(scene_.radiosity.rows(), nodes.interpolation->n_nodes());
  }
  for (int k = 0; k < nodes.interpolation->n_nodes(); ++k) {
    nodes.irradiance.col(k) +=
        facing_point_to_polygon(nodes.interpolation->node(k), plane_.normal, part.points()) *
        scene_.radiosity.col(target.patch);
  }
}

void PointGather::interpolate(const Source& source) {
  for (Nodes& nodes : nodes_) {
    if (!nodes.interpolation) continue;
    for (const GatherPoint& point : source.points) {
      const auto weights = nodes.interpolation->weights(point.position);
      for (int k = 0; k < nodes.interpolation->n_nodes(); ++k) {
        irradiance_->col(point.column) += weights[k] * nodes.irradiance.col(k);
      }
    }
    nodes.interpolation.reset();
  }
}

void PointGather::add(std::int32_t patch, double factor, Index column) {
  irradiance_->col(column) += factor * scene_.radiosity.col(patch);
}

}  // namespace radiosity
