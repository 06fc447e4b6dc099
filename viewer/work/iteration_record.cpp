#include "viewer/work/iteration_record.h"

#include <algorithm>

namespace viewer {
namespace {

// So many steps are all kept; beyond, each is further from the last by this factor.
constexpr int kFirstSteps = 40;
constexpr double kGrowth = 1.08;
// What all frames may take, bytes.
constexpr double kMemory = 400e6;

}  // namespace

IterationRecorder::IterationRecorder(radiosity::Method method, const Eigen::VectorXd& area,
                                     const Eigen::MatrixXd& exitance)
    : area_(area), emitted_((exitance.transpose() * area).sum()) {
  const double frame_bytes = 2.0 * sizeof(float) * static_cast<double>(exitance.size());
  most_frames_ = static_cast<std::size_t>(std::max(4.0, kMemory / std::max(frame_bytes, 1.0)));
  record_.method = method;
}

void IterationRecorder::add(const radiosity::SolveStep& step) {
  record_.steps.push_back(step.iteration);
  record_.bounds.push_back(step.error_bound);
  const bool is_due = record_.frames.empty() || step.iteration < kFirstSteps ||
                      step.iteration >= kGrowth * record_.frames.back()->iteration;
  if (is_due && record_.frames.size() + 1 < most_frames_) {
    add_frame(step.iteration, step.radiosity(), step.unshot());
  }
}

void IterationRecorder::finish(const radiosity::Solution& solution) {
  record_.is_complete = true;
  if (!record_.frames.empty() && record_.frames.back()->iteration >= solution.iterations) return;
  const Eigen::MatrixXd left = solution.exitance +
                               solution.reflectance.cwiseProduct(solution.irradiance) -
                               solution.radiosity;
  add_frame(solution.iterations, solution.radiosity, left);
}

void IterationRecorder::add_frame(int iteration, const Eigen::MatrixXd& radiosity,
                                  const Eigen::MatrixXd& unshot) {
  const double power = (unshot.cwiseAbs().transpose() * area_).sum();
  record_.frames.push_back(std::make_shared<IterationFrame>(
      IterationFrame{.iteration = iteration,
                     .radiosity = radiosity.cast<float>(),
                     .unshot = unshot.cast<float>(),
                     .unshot_share = emitted_ > 0 ? power / emitted_ : 0}));
}

}  // namespace viewer
