#pragma once

#include <string>
#include <vector>

#include "apps/validation/plot/plot.h"

namespace apps::validation {

/// The middle value, or the mean of the two in the middle. `values` must not be empty.
double median(std::vector<double> values);

/// Exponent p of y = c x^p, by least squares of the logarithms. At least two points, all above 0,
/// not all x alike.
double fitted_order(const std::vector<double>& x, const std::vector<double>& y);

/// How often values fall into bins from -5 to 5, those beyond counted in the outermost, beside what
/// a normal distribution of variance 1 gives.
Plot normal_histogram(const std::string& title, const std::string& label,
                      const std::vector<double>& values);

}  // namespace apps::validation
