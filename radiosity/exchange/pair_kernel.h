#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/polygon/polygon_quadrature.h"
#include "radiosity/visibility/blocking.h"
#include "radiosity/visibility/half_space.h"
#include "radiosity/visibility/prepared_mesh.h"

namespace radiosity {

/// The kernel of pairs of patches that see each other, with each patch's quadrature points laid out
/// for speed.
class PairKernel {
 public:
  /// What the points of one rule on all patches may take to be kept: of order 4 those of 500,000
  /// patches, of order 3 of 700,000, of order 2 of two million.
  static constexpr std::size_t kMostKeptBytes = std::size_t{256} << 20;

  /// `tolerance` is the relative error of the unoccluded exchange areas, which are the same to the
  /// last bit whatever is kept. The mesh must outlive this.
  PairKernel(const PreparedMesh& mesh, double tolerance,
             std::size_t most_kept_bytes = kMostKeptBytes);

  /// How much of patch j lies in front of patch i: nothing, some, or all of it.
  [[nodiscard]] Blocking in_front(Index i, Index j) const;

  /// Exchange area of two patches without occlusion, m², given how much of either lies in front
  /// of the other.
  [[nodiscard]] double unoccluded(Index i, Index j, Blocking front_i, Blocking front_j) const;
  [[nodiscard]] double tolerance() const { return tolerance_; }

 private:
  /// Rules up to this order at most are kept for every patch; larger ones, for near pairs, are made
  /// anew, to the same bits.
  static constexpr int kMostKeptOrder = 4;
  struct Rule {
    std::vector<double> x, y, z, weight;
  };
  void keep_rule(int order);
  /// As area_rule_order does.
  [[nodiscard]] int rule_order(double distance_ratio) const;
  void find_points(Index i, int order, const HalfSpace& other, WeightedPoints& points) const;

  const PreparedMesh& mesh_;
  int kept_order_ = 1;
  // Orders 2, ..., kept_order_: padded_points(order) entries a patch.
  std::array<Rule, kMostKeptOrder - 1> rules_;
  double tolerance_;
  std::array<double, kLargestAreaRule + 1> least_ratio_;  // per order: of distance to radius
};

}  // namespace radiosity
