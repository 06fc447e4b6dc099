#pragma once

#include <vector>

namespace io {

/// The smallest of 1, 2, 5 times a power of ten that is at least `value` (> 0), but for rounding.
double round_up(double value);

/// The largest of 1, 2, 5 times a power of ten that is at most `value` (> 0), but for rounding.
double round_down(double value);

/// The multiples of `step` (> 0) from `low` to `high`, both included, but for rounding; increasing.
std::vector<double> multiples_within(double low, double high, double step);

}  // namespace io
