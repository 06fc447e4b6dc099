#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "radiosity/exchange/pair_blockers.h"
#include "radiosity/exchange/pair_estimate.h"
#include "radiosity/exchange/pair_view.h"
#include "radiosity/exchange/shadowed_quadrature.h"
#include "radiosity/visibility/visible_polygon.h"

namespace radiosity {

/// Visible shares of pairs from points of the source, with the shadows that each of them sees. The
/// source is divided into quarters, with blockers proved away a quarter at a time, until the
/// quarters agree with the whole piece. Keeps its memory from call to call.
class PointSampler {
 public:
  /// Points for a pair at most: what does not settle by then has the error that it has.
  static constexpr int kMostPoints = 300;
  /// The standard error of what happens between the twenty points of a piece and its quarters, such
  /// as a strip along its border from which alone the target is seen, as a share of all.
  static constexpr double kUnseen = 0.005;

  struct Options {
    double thickness = 0;            ///< how far off a plane a point may be and count as on it, m
    double kernel_tolerance = 1e-9;  ///< relative error of the kernel where that is proved visible
    double least_error = 0;          ///< of any share, one sigma
  };
  explicit PointSampler(const Options& options) : options_(options) {}

  /// `between` is what blocks the pair, none of which divides the target; of those that divide the
  /// source it gets the shadows of some point. `whole` is the exchange area without blockers, m²,
  /// and `error` the error of the share aimed at.
  PairEstimate sample(const PairView& view, PairBlockers& between, double whole, double error);

 private:
  static constexpr std::size_t kMostQuarterings = 7;
  /// Sums over points of the source, per area of the kernel.
  struct Sums {
    double whole = 0;
    double visible = 0;
    double variance = 0;
    bool is_proved = false;
    /// Of quads: what each of the four points, which lie in the quarters about the corners, gives.
    bool has_quarters = false;
    std::array<double, 4> quarter_whole{};
    std::array<double, 4> quarter_visible{};
    void add(const Sums& other);
  };
  using Blockers = std::span<const Blocker* const>;

  [[nodiscard]] Sums apply_rule(const PairView& view, const ConvexPolygon& piece,
                                PairBlockers& between);
  [[nodiscard]] Sums look_at_part(const PairView& view, const ConvexPolygon& part,
                                  Blockers candidates, std::size_t depth);
  /// Adds a piece, of which `blockers` are left, by its quarters.
  void add_parts(const PairView& view, const ConvexPolygon& piece, Blockers blockers,
                 const Sums& coarse, double goal, std::size_t depth, Sums& sums);

  Options options_;
  std::array<PairBlockers, kMostQuarterings> between_;  // of a part and the target, by depth
  ShadowCutter cutter_;
  int points_left_ = 0;        // before a pair has to do with what it has
  double part_tolerance_ = 0;  // of the same pair: see kPartKernel
};

}  // namespace radiosity
