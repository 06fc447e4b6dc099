#pragma once

#include "radiosity/base/ranks.h"
#include "radiosity/solve/linear_solver.h"

namespace radiosity {

/// The solver on the first rank alone, while the others make their shares of its products: its
/// sums, and so its bits, do not depend on how many ranks there are. All ranks call it together,
/// and have the solution. Where it throws on the first, the others throw FirstRankFailed.
LinearSolver led_by_first_rank(Ranks& ranks, LinearSolver solver);

}  // namespace radiosity
