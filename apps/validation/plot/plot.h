#pragma once

#include <string>
#include <vector>

namespace apps::validation {

/// Numbers that belong together in a plot: point k is (x[k], y[k]).
struct Series {
  enum class Style {
    markers,
    line,
    dashed,
    line_and_markers,
    bars  ///< from 0 up to y, centred at x, as wide as the x are apart; linear axes only
  };
  std::string label;  ///< in the legend; empty: not in it
  Style style = Style::line_and_markers;
  std::vector<double> x{};
  std::vector<double> y{};
};

/// What an axis shows.
struct Axis {
  enum class Scale { linear, logarithmic };
  std::string label;
  Scale scale = Scale::linear;
};

/// A line or scatter plot, or a histogram. Points that an axis cannot show (not finite, or not
/// above 0 on a logarithmic one) are left out of the drawing.
struct Plot {
  std::string title;
  Axis x;
  Axis y;
  std::vector<Series> series;
};

}  // namespace apps::validation
