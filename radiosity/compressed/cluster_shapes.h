#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/exchange/exchange_evaluator.h"

namespace radiosity {

/// How the clusters of patches lie, by themselves and to each other.
class ClusterShapes {
 public:
  /// `areas` are the patches', m². The evaluator must outlive this.
  ClusterShapes(const ExchangeEvaluator& evaluator, const std::vector<double>& areas);

  [[nodiscard]] double total_area() const { return area_before_.back(); }  ///< m²
  [[nodiscard]] double diameter(std::int32_t cluster) const { return diameters_[cluster]; }  ///< m
  /// The distance of the boxes of two clusters, m.
  [[nodiscard]] double gap(std::int32_t a, std::int32_t b) const;
  /// Whether all patches of b are proved to be in front of all of a.
  [[nodiscard]] bool is_facing(std::int32_t a, std::int32_t b) const;
  /// No kernel between two clusters is larger, 1/m².
  [[nodiscard]] double largest_density(std::int32_t a, std::int32_t b) const;
  /// The kernel of two patches' middles, with nothing between, 1/m².
  [[nodiscard]] double open_density(std::int32_t i, std::int32_t j) const;
  /// The place in a cluster, in the tree's order, that has such a share of its area before it.
  [[nodiscard]] std::int32_t place_at(std::int32_t cluster, double share) const;

  /// The places of the patches that are furthest in eight directions, each once.
  struct Extremes {
    std::array<std::int32_t, 8> places{};
    int n = 0;
  };
  [[nodiscard]] const Extremes& extremes(std::int32_t cluster) const { return extremes_[cluster]; }

 private:
  void find_extremes();
  void find_cone(std::int32_t cluster, const std::vector<double>& areas);

  const ExchangeEvaluator& evaluator_;
  std::vector<double> area_before_;  // of the patches before each, in the tree's order; n + 1
  std::vector<Extremes> extremes_;   // per cluster, as what follows
  struct Cone {
    Vec3 axis = Vec3::Zero();
    double sine = 1;  // of the largest angle between a normal and the axis; 1: anything
  };
  std::vector<Cone> cones_;
  std::vector<double> diameters_;
};

}  // namespace radiosity
