#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "radiosity/solve/solution.h"

namespace viewer {

/// A moment of an iteration.
struct IterationFrame {
  int iteration = 0;          ///< steps so far; of Southwell: shots
  Eigen::MatrixXf radiosity;  ///< W/m², n x b
  Eigen::MatrixXf unshot;     ///< light that has arrived and is not passed on yet, W/m², n x b
  double unshot_share = 0;    ///< Σ A |unshot| / Σ A M_e
};

/// How an iteration went, to step through. Has a frame for each of its first steps, then for ever
/// fewer, and the last.
struct IterationRecord {
  radiosity::Method method = radiosity::Method::jacobi;
  std::vector<std::shared_ptr<const IterationFrame>> frames;
  std::vector<double> steps;   ///< of the curve: iteration
  std::vector<double> bounds;  ///< of the curve: bound on the relative error, or relative residual
  bool is_complete = false;
};

/// Builds the record of one solve from its steps (`SolveOptions::on_step`).
class IterationRecorder {
 public:
  /// `area` of the patches, m²; `exitance` of the solve, n x b.
  IterationRecorder(radiosity::Method method, const Eigen::VectorXd& area,
                    const Eigen::MatrixXd& exitance);

  void add(const radiosity::SolveStep& step);
  [[nodiscard]] const IterationRecord& record() const { return record_; }
  /// Adds the last step, if it has no frame yet.
  void finish(const radiosity::Solution& solution);

 private:
  void add_frame(int iteration, const Eigen::MatrixXd& radiosity, const Eigen::MatrixXd& unshot);

  Eigen::VectorXd area_;
  double emitted_;
  std::size_t most_frames_;
  IterationRecord record_;
};

}  // namespace viewer
