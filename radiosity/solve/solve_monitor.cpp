#include "radiosity/solve/solve_monitor.h"

#include <algorithm>
#include <cmath>

namespace radiosity {

void SolveMonitor::show(int steps, double products, double error_bound,
                        const StepFields& fields) const {
  if (!is_watched()) return;
  options_.on_step({.iteration = iterations_ + steps,
                    .products = products_ + products,
                    .error_bound = error_bound,
                    .radiosity = fields.radiosity,
                    .unshot = fields.unshot});
}

void SolveMonitor::step(int steps, double products, double error_bound, const StepFields& fields) {
  products_ += products;
  iterations_ += steps;
  if (error_bound < 0.99 * best_bound_) {
    best_bound_ = error_bound;
    best_products_ = products_;
  }
  show(0, 0, error_bound, fields);
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
