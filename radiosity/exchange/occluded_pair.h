#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <span>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/exchange/shadowed_quadrature.h"
#include "radiosity/exchange/visible_fraction.h"
#include "radiosity/visibility/blocker.h"
#include "radiosity/visibility/segment_bundle.h"
#include "radiosity/visibility/visibility.h"

namespace radiosity {

/// Exchange area of a pair that something may block, m².
struct PairEstimate {
  double value = 0;
  double error = 0;                    ///< one sigma; 0 if `blocking` is a proof
  Blocking blocking = Blocking::some;  ///< none and all are proofs
  bool is_partial = false;             ///< found to be partly hidden
  int rays = 0;
};

struct OccludedPairOptions {
  double tolerance = 1e-3;         ///< relative error of all exchange areas together aimed at
  double mean_area = 0;            ///< exchange area of a pair on average, m²
  double budget = 2;               ///< relative error, in tolerances, of a pair of this size
  double thickness = 0;            ///< how far off a plane a point may be and count as on it, m
  double kernel_tolerance = 1e-9;  ///< relative error of the kernel where visibility is proved
};

/// Estimates exchange areas of pairs given all blockers between them. Blockers are first proved
/// away, as seen from the smaller polygon. What is left is a matter of cost: see `allowed_share` in
/// the source for how much error a pair may have, and `choose_method` for which of rays, exact cuts
/// of shadows and sampled shadows gets there soonest. Not to be shared by threads.
class OccludedPairEstimator {
 public:
  OccludedPairEstimator(const Visibility& visibility, const OccludedPairOptions& options)
      : visibility_(visibility), options_(options) {}

  /// `unoccluded` gives the exchange area without blockers, m²; it is called where needed.
  PairEstimate estimate(const SampledPair& pair, std::span<const Blocker* const> candidates,
                        const std::function<double()>& unoccluded, std::uint64_t seed);

 private:
  enum class Method { rays, cuts, points };
  /// What is kept of a pair, and of the parts into which it is divided, at each depth.
  struct Level {
    std::vector<const Blocker*> blockers;
    std::vector<Shadow> shadows;        ///< of the blockers; empty where it depends on the point
    std::vector<std::size_t> dividing;  ///< blockers with a plane that divides the source
    const HalfSpace* source_divider = nullptr;  ///< a face's plane that cuts the polygon
    const HalfSpace* target_divider = nullptr;
    /// As source_divider, of a blocker that stands on the source: what it covers ends there.
    const HalfSpace* border = nullptr;
  };
  /// A pair as seen from its smaller polygon.
  struct View {
    explicit View(const SampledPair& pair);
    bool from_i;
    const ConvexPolygon* source;
    const ConvexPolygon* target;
    Vec3 source_normal;
    double source_area;  ///< m²
    double distance;     ///< of their middles, m
    bool is_near;
  };
  /// Sums over points of the source, per area of the kernel.
  struct PointSums {
    double whole = 0;
    double visible = 0;
    double variance = 0;
    bool is_proved = false;
    /// Of quads: what each of the four points, which lie in the quarters about the corners, gives.
    bool has_quarters = false;
    std::array<double, 4> quarter_whole{};
    std::array<double, 4> quarter_visible{};
    void add(const PointSums& other);
  };

  PairEstimate estimate(const SampledPair& pair, std::span<const Blocker* const> candidates,
                        const std::function<double()>& unoccluded, std::uint64_t seed,
                        std::size_t depth);
  /// Keeps the candidates that are not proved away, and their shadows.
  Blocking find_shadows(const ConvexPolygon& source, const ConvexPolygon& target,
                        std::span<const Blocker* const> candidates, Level& level) const;
  PairEstimate estimate_unproved(const SampledPair& pair, const View& view, double whole,
                                 std::uint64_t seed, std::size_t depth);
  [[nodiscard]] double allowed_share(const View& view, double whole) const;
  [[nodiscard]] bool suits_rays(const View& view) const;
  [[nodiscard]] Method choose_method(const View& view, const Level& level, double error) const;
  PairEstimate divide(const SampledPair& pair, bool divides_i,
                      std::span<const ConvexPolygon> pieces, std::size_t depth, std::uint64_t seed);
  [[nodiscard]] PairEstimate cut_shadows(const View& view, std::span<const Shadow> shadows,
                                         double whole, double error);
  [[nodiscard]] PairEstimate cast_rays(const SampledPair& pair, const View& view, double whole,
                                       double error, std::uint64_t seed) const;
  /// From points of the source, with the shadows that each of them sees.
  [[nodiscard]] PairEstimate sample_points(const View& view, double whole, double error,
                                           std::size_t depth);
  [[nodiscard]] PointSums apply_rule(const View& view, const ConvexPolygon& piece, Level& level);
  [[nodiscard]] PointSums look_at_part(const View& view, const ConvexPolygon& part,
                                       std::size_t depth);
  void add_parts(const View& view, const ConvexPolygon& piece, const PointSums& coarse, double goal,
                 std::size_t depth, std::size_t last_depth, PointSums& sums);

  const Visibility& visibility_;
  OccludedPairOptions options_;
  std::deque<Level> levels_;
  ShadowedQuadrature quadrature_;
  ShadowCutter cutter_;
  int points_left_ = 0;        // before a pair has to do with what it has
  double part_tolerance_ = 0;  // of the same pair: see kPartKernel
};

}  // namespace radiosity
