#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "radiosity/base/geometry.h"
#include "radiosity/solve/solution.h"

namespace viewer {

/// A moment of an iteration.
struct IterationFrame {
  int iteration = 0;          ///< steps so far; of Southwell: shots
  double work = 0;            ///< operator products that these cost; n shots count as one
  Eigen::MatrixXf radiosity;  ///< W/m², n x b
  Eigen::MatrixXf unshot;     ///< light that has arrived and is not passed on yet, W/m², n x b
  double unshot_share = 0;    ///< Σ A |unshot| / Σ A M_e
  /// Of Southwell: the patch that shoots next, which has the most unshot power; none at the end.
  std::optional<radiosity::Index> shooter = {};
};

/// How an iteration went, to step through. Has a frame for each of its first steps, then for ever
/// fewer, and the last.
struct IterationRecord {
  radiosity::Method method = radiosity::Method::jacobi;
  std::vector<std::shared_ptr<const IterationFrame>> frames;
  std::vector<double> work;    ///< of the curve: operator products, by which methods compare
  std::vector<double> bounds;  ///< of the curve: bound on the relative error, or relative residual
  bool is_complete = false;
};

/// "conjugate gradients", "Jacobi"...
std::string_view method_title(radiosity::Method method);
/// What the light after so many steps is: "light after 3 reflections", "after 120 shots".
std::string step_text(radiosity::Method method, int iteration);

/// Builds the record of one solve from its steps (`SolveOptions::on_step`).
class IterationRecorder {
 public:
  /// `area` of the patches, m²; `exitance` of the solve with what it reflects of light from
  /// without, n x b.
  IterationRecorder(radiosity::Method method, const Eigen::VectorXd& area,
                    const Eigen::MatrixXd& exitance);

  void add(const radiosity::SolveStep& step);
  [[nodiscard]] const IterationRecord& record() const { return record_; }
  /// Adds the last step, if it has no frame yet.
  void finish(const radiosity::Solution& solution);

 private:
  /// The work of which `products` is the solver's count: without what all methods begin with.
  [[nodiscard]] double work_of(double products) const { return products - first_products_; }
  void add_frame(int iteration, double work, const Eigen::MatrixXd& radiosity,
                 const Eigen::MatrixXd& unshot);

  Eigen::VectorXd area_;
  double emitted_;
  std::size_t most_frames_;
  double first_products_ = 0;
  IterationRecord record_;
};

}  // namespace viewer
