#pragma once

#include <span>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/exchange/pair_estimate.h"
#include "radiosity/polygon/convex_polygon.h"
#include "radiosity/visibility/segment_bundle.h"
#include "radiosity/visibility/visible_polygon.h"

namespace radiosity {

/// A source polygon, seen by the target, and the shadows that blockers throw on the target for
/// every point of the source. Both polygons lie in front of each other.
struct ShadowedPair {
  const ConvexPolygon& source;
  Vec3 source_normal;
  const ConvexPolygon& target;
  std::span<const Shadow> shadows;
  double thickness = 0;  ///< up to which lengths are contact, m
};

/// Integrates the visible fraction over the source: at each quadrature point the target without its
/// shadows is known in closed form. The source is first divided along the lines where a shadow's
/// border meets the target's, since within the pieces the integrand is analytic. (The visual events
/// of Plantinga & Dyer 1990, but for those of three edges.) Keeps its memory from call to call.
class ShadowedQuadrature {
 public:
  /// `tolerance` is the error of the fraction aimed at. If `adapts`, pieces are divided further
  /// until two rules agree; otherwise one low rule has to do. Pairs that take too many pieces for
  /// that are given up, with an error of 1.
  PairEstimate integrate(const ShadowedPair& pair, double tolerance, bool adapts);

 private:
  struct Sums {
    double whole = 0;
    double visible = 0;
    double variance = 0;
    double low = 1;  ///< least and largest visible share at a point
    double high = 0;
    bool any_visible = false;
    bool any_hidden = false;
    void add(const Sums& other);
  };
  void divide_source(const ShadowedPair& pair, std::size_t most_pieces);
  /// Strips along the edges of shadows and target that are close to the source; false if that would
  /// take too many.
  bool grade_source(const ShadowedPair& pair, double tolerance);
  void divide_pieces(const Vec3& normal, const Vec3& on_plane, const ShadowedPair& pair,
                     std::size_t most_pieces);
  [[nodiscard]] Sums apply_rule(const ShadowedPair& pair, const ConvexPolygon& piece, int order);
  void add_adaptively(const ShadowedPair& pair, const ConvexPolygon& piece, double goal, int depth,
                      Sums& sums);

  std::vector<ConvexPolygon> pieces_;
  std::vector<Shadow::Edge> edges_;
  bool is_divided_ = true;  // at all events
  ShadowCutter cutter_;
  long points_left_ = 0;  // before a pair has to do with what it has
};

}  // namespace radiosity
