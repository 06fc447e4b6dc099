#include "viewer/work/iteration_record.h"

#include <fmt/format.h>

#include <algorithm>

namespace viewer {
namespace {

// So many steps are all kept; beyond, each is further from the last by this factor.
constexpr int kFirstSteps = 40;
constexpr double kGrowth = 1.08;
// What all frames may take, bytes.
constexpr double kMemory = 400e6;

/// "1 shot", "3 shots".
std::string counted(int n, std::string_view what) {
  return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

}  // namespace

std::string_view method_title(radiosity::Method method) {
  switch (method) {
    case radiosity::Method::conjugate_gradients:
      return "conjugate gradients";
    case radiosity::Method::jacobi:
      return "Jacobi";
    case radiosity::Method::gauss_seidel:
      return "Gauss-Seidel";
    case radiosity::Method::southwell:
      return "Southwell";
    case radiosity::Method::chebyshev:
      return "Chebyshev";
    case radiosity::Method::external:
      return "another program's";
  }
  return "";
}

std::string step_text(radiosity::Method method, int iteration) {
  switch (method) {
    case radiosity::Method::jacobi:
      return iteration == 0 ? "emitted light, not reflected yet"
                            : "light after " + counted(iteration, "reflection");
    case radiosity::Method::gauss_seidel:
      return "after " + counted(iteration, "sweep");
    case radiosity::Method::southwell:
      return "after " + counted(iteration, "shot");
    case radiosity::Method::conjugate_gradients:
    case radiosity::Method::chebyshev:
    case radiosity::Method::external:
      break;
  }
  return "after " + counted(iteration, "step");
}

IterationRecorder::IterationRecorder(radiosity::Method method, const Eigen::VectorXd& area,
                                     const Eigen::MatrixXd& exitance)
    : area_(area), emitted_((exitance.transpose() * area).sum()) {
  const double frame_bytes = 2.0 * sizeof(float) * static_cast<double>(exitance.size());
  most_frames_ = static_cast<std::size_t>(std::max(4.0, kMemory / std::max(frame_bytes, 1.0)));
  record_.method = method;
}

void IterationRecorder::add(const radiosity::SolveStep& step) {
  if (record_.work.empty()) first_products_ = step.products;
  record_.work.push_back(work_of(step.products));
  record_.bounds.push_back(step.error_bound);
  const bool is_due = record_.frames.empty() || step.iteration < kFirstSteps ||
                      step.iteration >= kGrowth * record_.frames.back()->iteration;
  if (is_due && record_.frames.size() + 1 < most_frames_) {
    add_frame(step.iteration, work_of(step.products), step.radiosity(), step.unshot());
  }
}

void IterationRecorder::finish(const radiosity::Solution& solution) {
  record_.is_complete = true;
  if (!record_.frames.empty() && record_.frames.back()->iteration >= solution.iterations) return;
  const Eigen::MatrixXd left =
      solution.exitance + solution.passed_on(solution.irradiance) - solution.radiosity;
  const double work = record_.work.empty() ? work_of(solution.products) : record_.work.back();
  add_frame(solution.iterations, work, solution.radiosity, left);
}

void IterationRecorder::add_frame(int iteration, double work, const Eigen::MatrixXd& radiosity,
                                  const Eigen::MatrixXd& unshot) {
  const double power = (unshot.cwiseAbs().transpose() * area_).sum();
  auto frame = std::make_shared<IterationFrame>(
      IterationFrame{.iteration = iteration,
                     .work = work,
                     .radiosity = radiosity.cast<float>(),
                     .unshot = unshot.cast<float>(),
                     .unshot_share = emitted_ > 0 ? power / emitted_ : 0});
  const bool is_shooting = record_.method == radiosity::Method::southwell && !record_.is_complete;
  if (is_shooting && unshot.rows() > 0) {
    radiosity::Index shooter = 0;
    unshot.cwiseAbs().rowwise().sum().cwiseProduct(area_).maxCoeff(&shooter);
    frame->shooter = shooter;
  }
  record_.frames.push_back(std::move(frame));
}

}  // namespace viewer
