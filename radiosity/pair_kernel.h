#pragma once

#include <array>
#include <vector>

#include "radiosity/convex_polygon.h"
#include "radiosity/patch_mesh.h"
#include "radiosity/polygon_quadrature.h"
#include "radiosity/shaft.h"

namespace radiosity {

/// What the pair computations need of each patch, laid out for speed. Coordinates are relative to
/// the scene's centre, to keep digits when it lies far from the origin.
class PatchTable {
 public:
  explicit PatchTable(const PatchMesh& mesh);

  [[nodiscard]] Index size() const { return static_cast<Index>(polygons_.size()); }
  [[nodiscard]] const ConvexPolygon& polygon(Index i) const { return polygons_[i]; }
  /// The patch's plane; its front is normal · x > offset.
  [[nodiscard]] const HalfSpace& plane(Index i) const { return planes_[i]; }
  /// How far from a plane a point may be and still count as on it, m.
  [[nodiscard]] double thickness() const { return thickness_; }

  /// How much of patch j lies in front of patch i: nothing, some, or all of it.
  [[nodiscard]] Blocking in_front(Index i, Index j) const;

  /// Exchange area of two patches that wholly face each other, without occlusion, m².
  [[nodiscard]] double exchange_area_unclipped(Index i, Index j, double tolerance) const;

 private:
  /// Rules up to this order are kept for every patch; larger ones, for near pairs, are made anew.
  static constexpr int kKeptOrder = 3;
  struct Rule {
    std::vector<double> x, y, z, weight;
  };
  void find_points(Index i, int order, const HalfSpace& other, WeightedPoints& points) const;

  std::vector<ConvexPolygon> polygons_;
  std::vector<HalfSpace> planes_;
  std::vector<Vec3> centers_;
  std::vector<double> radii_;
  std::array<Rule, kKeptOrder - 1> rules_;  // orders 2, ...: padded_points(order) entries a patch
  double thickness_ = 0;
};

}  // namespace radiosity
