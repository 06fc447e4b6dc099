#include "radiosity/exchange/pair_kernel.h"

#include <algorithm>
#include <cmath>

#include "radiosity/polygon/exchange_area.h"

namespace radiosity {

PatchTable::PatchTable(const PatchMesh& mesh, double tolerance) : tolerance_(tolerance) {
  for (int order = 0; order <= kLargestAreaRule; ++order) {
    least_ratio_[order] = area_rule_least_ratio(order, tolerance);
  }
  const Box3 box = bounds(mesh);
  const Vec3 center = box.isEmpty() ? Vec3(Vec3::Zero()) : box.center();
  thickness_ = plane_thickness(mesh);
  for (Index i = 0; i < mesh.size(); ++i) {
    const HalfSpace plane{mesh.normal[i], mesh.normal[i].dot(mesh.centroid[i] - center)};
    ConvexPolygon polygon;
    for (int k = 0; k < mesh.n_corners(i); ++k) {
      const Vec3 corner = mesh.corner(i, k) - center;
      // A quad that is planar only to a file's digits would lie in its own shadow.
      const double height = plane.normal.dot(corner) - plane.offset;
      const bool is_off = std::abs(height) > thickness_;
      polygon.push_back(is_off ? Vec3(corner - height * plane.normal) : corner);
    }
    const Disc disc = bounding_disc(polygon.points());
    polygons_.push_back(polygon);
    planes_.push_back(plane);
    centers_.push_back(disc.center);
    radii_.push_back(disc.radius);
    for (int order = 2; order <= kKeptOrder; ++order) {
      Rule& rule = rules_[order - 2];
      int n_points = 0;
      const auto add = [&](const Vec3& point, double weight) {
        rule.x.push_back(point.x());
        rule.y.push_back(point.y());
        rule.z.push_back(point.z());
        rule.weight.push_back(weight);
        ++n_points;
      };
      for_each_quadrature_point(polygon.points(), order, add);
      while (n_points < padded_points(order)) add(disc.center, 0);
    }
  }
}

Blocking PatchTable::in_front(Index i, Index j) const {
  bool any_above = false;
  bool any_below = false;
  for (const Vec3& corner : polygons_[j]) {
    const double height = planes_[i].normal.dot(corner) - planes_[i].offset;
    any_above |= height > thickness_;
    any_below |= height < -thickness_;
  }
  if (!any_above) return Blocking::none;
  return any_below ? Blocking::some : Blocking::all;
}

int PatchTable::rule_order(double distance_ratio) const {
  for (int order = 2; order <= kLargestAreaRule; ++order) {
    if (distance_ratio >= least_ratio_[order]) return order;
  }
  return 0;
}

double PatchTable::unoccluded(Index i, Index j, Blocking front_i, Blocking front_j) const {
  const bool is_whole = front_i == Blocking::all && front_j == Blocking::all;
  const double distance = (centers_[i] - centers_[j]).norm();
  const int order_i = is_whole ? rule_order((distance - radii_[j]) / radii_[i]) : 0;
  const int order_j = is_whole ? rule_order((distance - radii_[i]) / radii_[j]) : 0;
  if (order_i == 0 || order_j == 0) {
    return exchange_area(polygons_[i].points(), polygons_[j].points(), tolerance_);
  }
  WeightedPoints points_i;
  WeightedPoints points_j;
  find_points(i, order_i, planes_[j], points_i);
  find_points(j, order_j, planes_[i], points_j);
  return sum_over_points(points_i, order_i * order_i, points_j, padded_points(order_j));
}

void PatchTable::find_points(Index i, int order, const HalfSpace& other,
                             WeightedPoints& points) const {
  if (order > kKeptOrder) {
    points.make(polygons_[i].points(), order, other.normal, other.offset);
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
