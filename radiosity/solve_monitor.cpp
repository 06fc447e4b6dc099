#include "radiosity/solve_monitor.h"

#include <algorithm>
#include <cmath>

namespace radiosity {

void SolveMonitor::step(int steps, double products, double error_bound) {
  const double whole_before = std::floor(products_);
  products_ += products;
  iterations_ += steps;
  if (error_bound < 0.99 * best_bound_) {
    best_bound_ = error_bound;
    best_products_ = products_;
  }
  if (options_.observer && std::floor(products_) > whole_before) {
    options_.observer(static_cast<int>(products_), error_bound);
  }
  if (options_.progress.report && std::isfinite(error_bound) && error_bound > 0) {
    if (first_bound_ == 0) {
      first_bound_ = error_bound;
      first_products_ = products_;
    }
    const double decades_done = std::log(first_bound_ / error_bound);
    const double decades = std::log(first_bound_ / options_.tolerance);
    const double spent = products_ - first_products_;
    const double total = decades_done > 0
                             ? first_products_ + spent * std::max(1., decades / decades_done)
                             : static_cast<double>(options_.max_products);
    options_.progress.report("solve", products_, total, "products");
  }
  check();
}

}  // namespace radiosity
