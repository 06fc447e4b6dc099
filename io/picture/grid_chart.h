#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "io/picture/color_map.h"
#include "io/picture/map_color.h"
#include "radiosity/picture/measured_grid.h"
#include "radiosity/picture/point_grid.h"

namespace io {

/// Values on a grid, as a picture shows them.
struct GridChart {
  radiosity::PointGrid grid;
  std::vector<radiosity::PointPlace> places;  ///< per point: only what is open has a value
  Eigen::VectorXd values;                     ///< per point
  std::string title;                          ///< "desks: illuminance, lx"
};

/// The scale of a chart's values, from its least to its greatest open one, to round numbers.
ColorScale chart_scale(const GridChart& chart);

/// A number for a label: "0.25", "7.5", "320".
std::string value_text(double value);

/// A line of equal value within a triangle between three points, in columns and rows of the grid
/// from its corner: point 0 is at (0.5, 0.5).
struct ChartLine {
  double value = 0;
  std::array<Eigen::Vector2d, 2> ends;
};

/// Lines of these values, where all points of a triangle are open.
std::vector<ChartLine> chart_lines(const GridChart& chart, const std::vector<double>& levels);

/// The values that lines are drawn of: the scale's ticks but for its ends.
std::vector<double> chart_levels(const ColorScale& scale);

/// The chart as an SVG picture that needs nothing else: cells in colours, lines of equal value with
/// their numbers, values at as many points as there is room for, the least and the greatest marked,
/// and a bar. Points in solids and outside are grey. The grid is seen from where its planes look.
std::string grid_svg(const GridChart& chart, ColorMap map = ColorMap::viridis);

}  // namespace io
