#pragma once

#include <string>

namespace apps::validation {

/// Relative error asked of form factors where a few polygons are in the way.
inline constexpr double kOccludedTolerance = 1e-7;
/// The same where a body of many facets is.
inline constexpr double kBodyTolerance = 1e-3;

enum class FactorKind {
  polygons,  ///< nothing is in the way
  point,     ///< from an element
  occluded,  ///< polygons are in the way
  body,      ///< a body of many facets is in the way
  curved     ///< facets that stand for a round shape
};

/// A form factor, computed and known.
struct FactorComparison {
  std::string name;
  FactorKind kind = FactorKind::polygons;
  double computed = 0;
  double expected = 0;
  double tolerance = 0;  ///< relative; 0: that of its kind
};

}  // namespace apps::validation
