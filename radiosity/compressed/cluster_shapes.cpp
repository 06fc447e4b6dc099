#include "radiosity/compressed/cluster_shapes.h"

#include <algorithm>
#include <cmath>

#include "radiosity/base/parallel.h"

namespace radiosity {

ClusterShapes::ClusterShapes(const ExchangeEvaluator& evaluator, const std::vector<double>& areas)
    : evaluator_(evaluator) {
  const ClusterTree& tree = evaluator.tree();
  area_before_.push_back(0);
  for (const std::int32_t patch : tree.order) {
    area_before_.push_back(area_before_.back() + areas[patch]);
  }
  for (const Cluster& cluster : tree.clusters) diameters_.push_back(cluster.box.diagonal().norm());
  find_extremes();
  cones_.resize(tree.clusters.size());
  constexpr std::ptrdiff_t kGrain = 64;
  parallel_for(
      static_cast<std::ptrdiff_t>(tree.clusters.size()),
      [&](std::ptrdiff_t c) { find_cone(static_cast<std::int32_t>(c), areas); }, kGrain);
}

void ClusterShapes::find_cone(std::int32_t c, const std::vector<double>& areas) {
  const ClusterTree& tree = evaluator_.tree();
  const Cluster& cluster = tree.clusters[c];
  const auto& planes = evaluator_.prepared().planes;
  Vec3 axis = Vec3::Zero();
  for (Index k = cluster.begin; k < cluster.end; ++k) {
    axis += areas[tree.order[k]] * planes[tree.order[k]].normal;
  }
  const double length = axis.norm();
  if (length == 0) return;
  cones_[c].axis = axis / length;
  double least = 1;
  for (Index k = cluster.begin; k < cluster.end; ++k) {
    least = std::min(least, cones_[c].axis.dot(planes[tree.order[k]].normal));
  }
  if (least > 0) cones_[c].sine = std::sqrt(std::max(0.0, 1 - least * least));
}

void ClusterShapes::find_extremes() {
  const ClusterTree& tree = evaluator_.tree();
  extremes_.resize(tree.clusters.size());
  const auto& discs = evaluator_.prepared().discs;
  // Children follow their parents.
  for (std::size_t c = tree.clusters.size(); c-- > 0;) {
    const Cluster& cluster = tree.clusters[c];
    std::vector<std::int32_t> candidates;
    if (cluster.is_leaf()) {
      for (Index k = cluster.begin; k < cluster.end; ++k) {
        candidates.push_back(static_cast<std::int32_t>(k));
      }
    } else {
      for (const std::int32_t child : {cluster.left, cluster.right}) {
        const Extremes& below = extremes_[child];
        candidates.insert(candidates.end(), below.places.begin(), below.places.begin() + below.n);
      }
    }
    Extremes& extremes = extremes_[c];
    for (int direction = 0; direction < 8; ++direction) {
      // Slightly different weights, so that what is even in one is told apart.
      const Vec3 way((direction & 1) != 0 ? 1.0 : -1.0, (direction & 2) != 0 ? 1.01 : -1.01,
                     (direction & 4) != 0 ? 1.02 : -1.02);
      const auto furthest =
          std::max_element(candidates.begin(), candidates.end(), [&](auto x, auto y) {
            return way.dot(discs[tree.order[x]].center) < way.dot(discs[tree.order[y]].center);
          });
      const auto end = extremes.places.begin() + extremes.n;
      if (std::find(extremes.places.begin(), end, *furthest) == end) {
        extremes.places[extremes.n++] = *furthest;
      }
    }
  }
}

double ClusterShapes::gap(std::int32_t a, std::int32_t b) const {
  const auto& clusters = evaluator_.tree().clusters;
  return clusters[a].box.exteriorDistance(clusters[b].box);
}

bool ClusterShapes::is_facing(std::int32_t a, std::int32_t b) const {
  const Cluster& ca = evaluator_.tree().clusters[a];
  const Cluster& cb = evaluator_.tree().clusters[b];
  if (ca.plane) {
    const double least = ca.plane->offset - evaluator_.prepared().thickness;
    return std::all_of(cb.outline.begin(), cb.outline.end(),
                       [&](const Vec3& x) { return ca.plane->normal.dot(x) >= least; });
  }
  const Cone& cone = cones_[a];
  if (cone.sine >= 1) return false;
  // Concave in the way from a to b, so its least value is at a corner of the box of all ways.
  const Box3 ways(cb.box.min() - ca.box.max(), cb.box.max() - ca.box.min());
  for (int k = 0; k < 8; ++k) {
    const Vec3 way = ways.corner(static_cast<Box3::CornerType>(k));
    if (cone.axis.dot(way) < cone.sine * way.norm()) return false;
  }
  return true;
}

double ClusterShapes::largest_density(std::int32_t a, std::int32_t b) const {
  const Cluster& ca = evaluator_.tree().clusters[a];
  const Cluster& cb = evaluator_.tree().clusters[b];
  const double distance = gap(a, b);
  const auto largest_cosine = [&](const Cluster& of, const Cluster& to) {
    if (!of.plane) return 1.0;
    double height = 0;
    for (const Vec3& x : to.outline) {
      height = std::max(height, of.plane->normal.dot(x) - of.plane->offset);
    }
    return std::min(1.0, height / distance);
  };
  return largest_cosine(ca, cb) * largest_cosine(cb, ca) / (kPi * distance * distance);
}

double ClusterShapes::open_density(std::int32_t i, std::int32_t j) const {
  const PreparedMesh& prepared = evaluator_.prepared();
  const Vec3 between = prepared.discs[j].center - prepared.discs[i].center;
  const double of_i = std::max(prepared.planes[i].normal.dot(between), 0.0);
  const double of_j = std::max(-prepared.planes[j].normal.dot(between), 0.0);
  return of_i * of_j / (kPi * square(between.squaredNorm()));
}

std::int32_t ClusterShapes::place_at(std::int32_t cluster, double share) const {
  const Cluster& its = evaluator_.tree().clusters[cluster];
  const auto begin = area_before_.begin() + its.begin;
  const auto end = area_before_.begin() + its.end;
  const double wanted = *begin + share * (*end - *begin);
  const auto after = std::upper_bound(begin + 1, end, wanted);
  return static_cast<std::int32_t>(its.begin + (after - (begin + 1)));
}

}  // namespace radiosity
