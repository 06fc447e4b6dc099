#pragma once

#include <vector>

#include "viewer/work/iteration_record.h"

namespace viewer {

/// What the plot of iterations shows.
struct IterationPlot {
  /// The one that is stepped through first, then those it is compared with. None is null.
  std::vector<const IterationRecord*> records;
  double mark = 0;              ///< work of the step that is shown, products
  bool is_logarithmic = false;  ///< the axis of work
};

/// Draws the bounds on the error over the work that they cost, logarithmic, with the current step
/// marked. Needs an ImGui window; `scale` is the size of text relative to a plain screen.
void draw_iteration_plot(const IterationPlot& plot, double scale);

}  // namespace viewer
