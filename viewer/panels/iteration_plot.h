#pragma once

#include "viewer/work/iteration_record.h"

namespace viewer {

/// Draws the error bound over the steps, logarithmic, with the current step marked. Needs an ImGui
/// window; `scale` is the size of text relative to a plain screen.
void draw_iteration_plot(const IterationRecord& record, int iteration, double scale);

}  // namespace viewer
