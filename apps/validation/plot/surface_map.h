#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace apps::validation {

/// A polygon in the plane of its surface.
struct MapPolygon {
  std::vector<Eigen::Vector2d> corners;  ///< m, x to the right and y up
  std::optional<double> value;           ///< absent: left out of the comparison
};

/// A surface, flat on the page.
struct MapPanel {
  std::string label;
  std::vector<MapPolygon> polygons;
};

/// The surfaces of a scene side by side, at one scale, each polygon in the colour of a signed
/// value: blue below 0, white at 0, red above.
struct SurfaceMap {
  std::string title;
  std::string value_label;
  double limit = 1;  ///< values at ± this have the full colour, as those beyond
  std::vector<MapPanel> panels;
};

/// The map as an SVG element that needs nothing else, with a legend. Scales with the page.
std::string svg(const SurfaceMap& map);

}  // namespace apps::validation
