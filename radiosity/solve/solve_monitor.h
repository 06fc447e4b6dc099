#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <functional>
#include <limits>

#include "radiosity/solve/solution.h"

namespace radiosity {

/// What SolveStep offers to work out.
struct StepFields {
  std::function<Eigen::MatrixXd()> radiosity;
  std::function<Eigen::MatrixXd()> unshot;
};

/// Counts products, tells watcher and progress bar, and learns when to stop. Of one solve.
class SolveMonitor {
 public:
  explicit SolveMonitor(const SolveOptions& options) : options_(options) {}

  /// Counts work outside the iteration proper (products).
  void spend(double products) { products_ += products; }
  /// Counts one or more steps of the method that cost `products` and left the relative bound
  /// `error_bound`, reports and shows them. Throws Interrupted if asked to stop.
  void step(int steps, double products, double error_bound, const StepFields& fields);
  /// Shows the watcher where the iteration stands `steps` and `products` after what is counted.
  void show(int steps, double products, double error_bound, const StepFields& fields) const;
  [[nodiscard]] bool is_watched() const { return static_cast<bool>(options_.on_step); }
  /// Throws Interrupted if asked to stop.
  void check() const { options_.progress.check(); }

  /// Whether `products` more are allowed and sensible: an iteration whose bound has not improved by
  /// 1 % during the latter half of its products has met the rounding errors.
  [[nodiscard]] bool may_spend(double products) const {
    const bool is_stuck = products_ > 2 * best_products_ + kPatience;
    return products_ + products <= options_.max_products && !is_stuck;
  }
  /// Products that are left, at least one.
  [[nodiscard]] int products_left() const {
    return std::max(1, options_.max_products - static_cast<int>(products_));
  }
  [[nodiscard]] const Eigen::MatrixXd& start() const { return options_.start; }
  [[nodiscard]] const Eigen::MatrixXd& incident() const { return options_.incident; }
  [[nodiscard]] const Eigen::SparseMatrix<double>& transmission() const {
    return options_.transmission;
  }
  [[nodiscard]] bool has_sinks() const { return options_.has_sinks; }
  [[nodiscard]] double tolerance() const { return options_.tolerance; }
  [[nodiscard]] double products() const { return products_; }
  [[nodiscard]] int iterations() const { return iterations_; }

 private:
  static constexpr double kPatience = 100;  ///< products
  const SolveOptions& options_;
  double products_ = 0;
  int iterations_ = 0;
  double first_products_ = 0;
  double first_bound_ = 0;
  double best_products_ = 0;
  double best_bound_ = std::numeric_limits<double>::infinity();
};

}  // namespace radiosity
