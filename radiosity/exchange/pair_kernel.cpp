#include "radiosity/exchange/pair_kernel.h"

#include <algorithm>
#include <cmath>

#include "radiosity/base/parallel.h"
#include "radiosity/polygon/exchange_area.h"

namespace radiosity {

PairKernel::PairKernel(const PreparedMesh& mesh, double tolerance, std::size_t most_kept_bytes)
    : mesh_(mesh), tolerance_(tolerance) {
  for (int order = 0; order <= kLargestAreaRule; ++order) {
    least_ratio_[order] = area_rule_least_ratio(order, tolerance);
  }
  while (kept_order_ < kMostKeptOrder) {
    const int order = kept_order_ + 1;
    const std::size_t n_points = padded_points(order);
    if (mesh.size() * n_points * 4 * sizeof(double) > most_kept_bytes) break;
    keep_rule(order);
    kept_order_ = order;
  }
}

void PairKernel::keep_rule(int order) {
  const int n_points = padded_points(order);
  Rule& rule = rules_[order - 2];
  for (std::vector<double>* part : {&rule.x, &rule.y, &rule.z, &rule.weight}) {
    part->resize(mesh_.size() * n_points);
  }
  const auto keep = [&](Index i) {
    Index k = i * n_points;
    const auto add = [&](const Vec3& point, double weight) {
      rule.x[k] = point.x();
      rule.y[k] = point.y();
      rule.z[k] = point.z();
      rule.weight[k++] = weight;
    };
    for_each_quadrature_point(mesh_.polygons[i].points(), order, add);
    while (k < (i + 1) * n_points) add(mesh_.discs[i].center, 0);
  };
  constexpr Index kGrain = 1024;
  parallel_for(mesh_.size(), keep, kGrain);
}

Blocking PairKernel::in_front(Index i, Index j) const {
  bool any_above = false;
  bool any_below = false;
  for (const Vec3& corner : mesh_.polygons[j]) {
    const double height = mesh_.planes[i].normal.dot(corner) - mesh_.planes[i].offset;
    any_above |= height > mesh_.thickness;
    any_below |= height < -mesh_.thickness;
  }
  if (!any_above) return Blocking::none;
  return any_below ? Blocking::some : Blocking::all;
}

int PairKernel::rule_order(double distance_ratio) const {
  for (int order = 2; order <= kLargestAreaRule; ++order) {
    if (distance_ratio >= least_ratio_[order]) return order;
  }
  return 0;
}

double PairKernel::unoccluded(Index i, Index j, Blocking front_i, Blocking front_j) const {
  const bool is_whole = front_i == Blocking::all && front_j == Blocking::all;
  const double distance = (mesh_.discs[i].center - mesh_.discs[j].center).norm();
  const int order_i =
      is_whole ? rule_order((distance - mesh_.discs[j].radius) / mesh_.discs[i].radius) : 0;
  const int order_j =
      is_whole ? rule_order((distance - mesh_.discs[i].radius) / mesh_.discs[j].radius) : 0;
  if (order_i == 0 || order_j == 0) {
    return exchange_area(mesh_.polygons[i].points(), mesh_.polygons[j].points(), tolerance_);
  }
  WeightedPoints points_i;
  WeightedPoints points_j;
  find_points(i, order_i, mesh_.planes[j], points_i);
  find_points(j, order_j, mesh_.planes[i], points_j);
  return sum_over_points(points_i, order_i * order_i, points_j, padded_points(order_j));
}

void PairKernel::find_points(Index i, int order, const HalfSpace& other,
                             WeightedPoints& points) const {
  if (order > kept_order_) {
    points.make(mesh_.polygons[i].points(), order, other.normal, other.offset);
    return;
  }
  const int n_points = padded_points(order);
  const Rule& rule = rules_[order - 2];
  points.x = &rule.x[i * n_points];
  points.y = &rule.y[i * n_points];
  points.z = &rule.z[i * n_points];
  points.weigh(&rule.weight[i * n_points], n_points, other.normal, other.offset);
}

}  // namespace radiosity
