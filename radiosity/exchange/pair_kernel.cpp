#include "radiosity/exchange/pair_kernel.h"

#include <algorithm>
#include <cmath>

#include "radiosity/polygon/exchange_area.h"

namespace radiosity {

PairKernel::PairKernel(const PreparedMesh& mesh, double tolerance)
    : mesh_(mesh), tolerance_(tolerance) {
  for (int order = 0; order <= kLargestAreaRule; ++order) {
    least_ratio_[order] = area_rule_least_ratio(order, tolerance);
  }
  for (int order = 2; order <= kKeptOrder; ++order) {
    Rule& rule = rules_[order - 2];
    for (Index i = 0; i < mesh.size(); ++i) {
      int n_points = 0;
      const auto add = [&](const Vec3& point, double weight) {
        rule.x.push_back(point.x());
        rule.y.push_back(point.y());
        rule.z.push_back(point.z());
        rule.weight.push_back(weight);
        ++n_points;
      };
      for_each_quadrature_point(mesh.polygons[i].points(), order, add);
      while (n_points < padded_points(order)) add(mesh.discs[i].center, 0);
    }
  }
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
  if (order > kKeptOrder) {
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
