#pragma once

#include <array>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/polygon/convex_polygon.h"
#include "radiosity/polygon/polygon_quadrature.h"
#include "radiosity/scene/patch_mesh.h"
#include "radiosity/visibility/shaft.h"

namespace radiosity {

/// What the pair computations need of each patch, laid out for speed. Coordinates are relative to
/// the scene's centre, to keep digits when it lies far from the origin.
class PatchTable {
 public:
  /// `tolerance` is the relative error of the unoccluded exchange areas.
  PatchTable(const PatchMesh& mesh, double tolerance);

  [[nodiscard]] Index size() const { return static_cast<Index>(polygons_.size()); }
  [[nodiscard]] const ConvexPolygon& polygon(Index i) const { return polygons_[i]; }
  /// The patch's plane; its front is normal · x > offset.
  [[nodiscard]] const HalfSpace& plane(Index i) const { return planes_[i]; }
  /// How far from a plane a point may be and still count as on it, m.
  [[nodiscard]] double thickness() const { return thickness_; }

  /// How much of patch j lies in front of patch i: nothing, some, or all of it.
  [[nodiscard]] Blocking in_front(Index i, Index j) const;

  /// Exchange area of two patches without occlusion, m², given how much of either lies in front
  /// of the other.
  [[nodiscard]] double unoccluded(Index i, Index j, Blocking front_i, Blocking front_j) const;
  [[nodiscard]] double tolerance() const { return tolerance_; }

 private:
  /// Rules up to this order are kept for every patch; larger ones, for near pairs, are made anew.
  static constexpr int kKeptOrder = 4;
  struct Rule {
    std::vector<double> x, y, z, weight;
  };
  /// As area_rule_order does.
  [[nodiscard]] int rule_order(double distance_ratio) const;
  void find_points(Index i, int order, const HalfSpace& other, WeightedPoints& points) const;

  std::vector<ConvexPolygon> polygons_;
  std::vector<HalfSpace> planes_;
  std::vector<Vec3> centers_;
  std::vector<double> radii_;
  std::array<Rule, kKeptOrder - 1> rules_;  // orders 2, ...: padded_points(order) entries a patch
  double thickness_ = 0;
  double tolerance_;
  std::array<double, kLargestAreaRule + 1> least_ratio_;  // per order: of distance to radius
};

}  // namespace radiosity
