#include "radiosity/pair_kernel.h"

#include <algorithm>
#include <cmath>

#include "radiosity/exchange_area.h"

namespace radiosity {
namespace {

/// Points closer to a plane than this share of the scene's size lie on it.
constexpr double kThickness = 1e-11;
/// Rounding of coordinates far from the origin, relative to their size.
constexpr double kRounding = 4e-16;

/// 1/π Σ_a Σ_b cos_a cos_b / r⁴ over two rules, the cosine terms carrying the weights. Compiled for
/// several instruction sets; the one to run is chosen when the program starts.
__attribute__((target_clones("arch=x86-64-v3", "default"))) double sum_over_points(
    const double* xa, const double* ya, const double* za, const double* cos_a, int n_a,
    const double* xb, const double* yb, const double* zb, const double* cos_b, int n_b) {
  double total = 0;
  for (int a = 0; a < n_a; ++a) {
    double lanes[4] = {0, 0, 0, 0};
    for (int b = 0; b < n_b; b += 4) {
      for (int lane = 0; lane < 4; ++lane) {
        const double dx = xb[b + lane] - xa[a];
        const double dy = yb[b + lane] - ya[a];
        const double dz = zb[b + lane] - za[a];
        const double square = dx * dx + dy * dy + dz * dz;
        lanes[lane] += cos_b[b + lane] / (square * square);
      }
    }
    total += cos_a[a] * ((lanes[0] + lanes[1]) + (lanes[2] + lanes[3]));
  }
  return total / kPi;
}

}  // namespace

PatchTable::PatchTable(const PatchMesh& mesh) {
  const Box3 box = bounds(mesh);
  const Vec3 center = box.isEmpty() ? Vec3(Vec3::Zero()) : box.center();
  if (!box.isEmpty()) {
    const double furthest = box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff();
    thickness_ = kThickness * box.diagonal().norm() + kRounding * furthest;
  }
  for (Index i = 0; i < mesh.size(); ++i) {
    ConvexPolygon polygon;
    Vec3 middle = Vec3::Zero();
    for (int k = 0; k < mesh.n_corners(i); ++k) {
      polygon.push_back(mesh.corner(i, k) - center);
      middle += polygon[k] / mesh.n_corners(i);
    }
    double radius = 0;
    for (const Vec3& corner : polygon) radius = std::max(radius, (corner - middle).norm());
    polygons_.push_back(polygon);
    planes_.push_back({mesh.normal[i], mesh.normal[i].dot(mesh.centroid[i] - center)});
    centers_.push_back(middle);
    radii_.push_back(radius);
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
      while (n_points < padded_points(order)) add(middle, 0);
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

double PatchTable::exchange_area_unclipped(Index i, Index j, double tolerance) const {
  const double distance = (centers_[i] - centers_[j]).norm();
  const int order_i = area_rule_order((distance - radii_[j]) / radii_[i], tolerance);
  const int order_j = area_rule_order((distance - radii_[i]) / radii_[j], tolerance);
  if (order_i == 0 || order_j == 0) {
    return exchange_area(polygons_[i].points(), polygons_[j].points(), tolerance);
  }
  WeightedPoints points_i;
  WeightedPoints points_j;
  find_points(i, order_i, planes_[j], points_i);
  find_points(j, order_j, planes_[i], points_j);
  return sum_over_points(points_i.x, points_i.y, points_i.z, points_i.weight.data(),
                         order_i * order_i, points_j.x, points_j.y, points_j.z,
                         points_j.weight.data(), padded_points(order_j));
}

void PatchTable::find_points(Index i, int order, const HalfSpace& other,
                             WeightedPoints& points) const {
  const int n_points = padded_points(order);
  const double* weight = nullptr;
  std::array<double, WeightedPoints::kMost> own_weight;
  if (order <= kKeptOrder) {
    const Rule& rule = rules_[order - 2];
    points.x = &rule.x[i * n_points];
    points.y = &rule.y[i * n_points];
    points.z = &rule.z[i * n_points];
    weight = &rule.weight[i * n_points];
  } else {
    double* x = points.own.data();
    double* y = x + n_points;
    double* z = y + n_points;
    int n = 0;
    const auto add = [&](const Vec3& point, double point_weight) {
      x[n] = point.x();
      y[n] = point.y();
      z[n] = point.z();
      own_weight[n++] = point_weight;
    };
    for_each_quadrature_point(polygons_[i].points(), order, add);
    while (n < n_points) add(centers_[i], 0);
    points.x = x;
    points.y = y;
    points.z = z;
    weight = own_weight.data();
  }
  // Patches are planar, so r cosθ at the other patch depends on this patch's point alone.
  for (int k = 0; k < n_points; ++k) {
    points.weight[k] =
        weight[k] * (other.normal.x() * points.x[k] + other.normal.y() * points.y[k] +
                     other.normal.z() * points.z[k] - other.offset);
  }
}

}  // namespace radiosity
