#pragma once

#include <functional>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/polygon/convex_polygon.h"
#include "radiosity/scene/luminous_opening.h"

namespace radiosity {

/// A mean over a luminous opening, and what its last refinement changed, which is more than it is
/// off.
struct OpeningMean {
  double value = 0;
  double error = 0;
};

/// How exact a mean shall be.
struct OpeningRule {
  double tolerance = 0;   ///< of the mean
  double negligible = 0;  ///< in the unit of the function
  bool is_near = true;    ///< closer than some sizes of the opening
};

/// Convex polygons that an opening consists of, their corners relative to `point`, m; of an ellipse
/// eight sectors of four edges, which have its area: with n edges its second moments are off by
/// 2/45 (π/n)⁴ of them, 4e-6.
std::vector<ConvexPolygon> polygons_of(const LuminousOpening& opening, const Vec3& point);

/// ∫ f dA over convex polygons of `whole` m² in all, over that area. Polygons are divided in four
/// until Gauss rules of 3 and 4 points a direction differ by `tolerance` of the mean at most,
/// shared by area, or eight times.
OpeningMean mean_over_parts(const std::vector<ConvexPolygon>& parts, double whole, double tolerance,
                            const std::function<double(const Vec3&)>& f);

/// The mean of a function of points of an opening that is costly. First a rule of degree 5 against
/// one of degree 3 (Stroud 1971, of discs S2 5-1), or against two if f is of something near, for
/// one may agree by chance; the opening is divided in four until they differ by `tolerance` of the
/// mean or by `negligible` at most, shared by area, or twice.
OpeningMean mean_over_opening(const LuminousOpening& opening, const OpeningRule& rule,
                              const std::function<double(const Vec3&)>& f);

}  // namespace radiosity
