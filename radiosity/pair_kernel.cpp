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
    for (int order = 2; order <= kLargestAreaRule; ++order) {
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
  if (order_i > 0 && order_j > 0) return area_rule(i, order_i, j, order_j);
  return exchange_area(polygons_[i].points(), polygons_[j].points(), tolerance);
}

double PatchTable::area_rule(Index i, int order_i, Index j, int order_j) const {
  constexpr int kMost = padded_points(kLargestAreaRule);
  const int n_i = order_i * order_i;
  const int n_j = padded_points(order_j);
  const Rule& rule_i = rules_[order_i - 2];
  const Rule& rule_j = rules_[order_j - 2];
  const double* xi = &rule_i.x[i * padded_points(order_i)];
  const double* yi = &rule_i.y[i * padded_points(order_i)];
  const double* zi = &rule_i.z[i * padded_points(order_i)];
  const double* wi = &rule_i.weight[i * padded_points(order_i)];
  const double* xj = &rule_j.x[j * padded_points(order_j)];
  const double* yj = &rule_j.y[j * padded_points(order_j)];
  const double* zj = &rule_j.z[j * padded_points(order_j)];
  const double* wj = &rule_j.weight[j * padded_points(order_j)];
  // The patches are planar, so r cosθ_j depends on the point of i alone, and the reverse.
  std::array<double, kMost> cos_i;
  std::array<double, kMost> cos_j;
  const HalfSpace& plane_i = planes_[i];
  const HalfSpace& plane_j = planes_[j];
  for (int a = 0; a < n_i; ++a) {
    cos_i[a] = wi[a] * (plane_j.normal.x() * xi[a] + plane_j.normal.y() * yi[a] +
                        plane_j.normal.z() * zi[a] - plane_j.offset);
  }
  for (int b = 0; b < n_j; ++b) {
    cos_j[b] = wj[b] * (plane_i.normal.x() * xj[b] + plane_i.normal.y() * yj[b] +
                        plane_i.normal.z() * zj[b] - plane_i.offset);
  }
  return sum_over_points(xi, yi, zi, cos_i.data(), n_i, xj, yj, zj, cos_j.data(), n_j);
}

}  // namespace radiosity
