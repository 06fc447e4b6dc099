#include "radiosity/compressed/block_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace radiosity {

void BlockFitter::start(std::int32_t a, std::int32_t b, int most_degree) {
  a_ = a;
  b_ = b;
  most_degree_ = most_degree;
  had_all_ = false;
  of_a_.clear();
  of_b_.clear();
}

/// The polynomials at the samples that came since.
void BlockFitter::evaluate(std::span<const DensitySample> samples) {
  const std::size_t n_a = polynomials_.counts(a_)[most_degree_];
  const std::size_t n_b = polynomials_.counts(b_)[most_degree_];
  const std::size_t first = of_a_.size() / n_a;
  of_a_.resize(samples.size() * n_a);
  of_b_.resize(samples.size() * n_b);
  for (std::size_t s = first; s < samples.size(); ++s) {
    polynomials_.evaluate(a_, order_[samples[s].row], most_degree_, &of_a_[s * n_a]);
    polynomials_.evaluate(b_, order_[samples[s].column], most_degree_, &of_b_[s * n_b]);
  }
}

Eigen::VectorXd BlockFitter::least_squares(DegreePair degrees, const Eigen::VectorXd& wanted,
                                           const Eigen::VectorXd& roots, double total) {
  const auto& counts_a = polynomials_.counts(a_);
  const auto& counts_b = polynomials_.counts(b_);
  const Index n = n_coefficients(counts_a, counts_b, degrees);
  functions_.resize(n, wanted.size());
  for (Index s = 0; s < wanted.size(); ++s) {
    const double* of_a = &of_a_[s * counts_a[most_degree_]];
    const double* of_b = &of_b_[s * counts_b[most_degree_]];
    double* value = functions_.col(s).data();
    for_each_function(counts_a, counts_b, degrees, [&](int k, int count) {
      const double factor = roots[s] * of_a[k];
      for (int l = 0; l < count; ++l) *value++ = factor * of_b[l];
    });
  }
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(n, n);
  normal.selfadjointView<Eigen::Lower>().rankUpdate(functions_);
  // A combination that the samples hardly see stays small. What that takes from the others is
  // given back by a second step. (Tikhonov, iterated)
  constexpr double kRegular = 1e-3;
  normal.diagonal().array() += kRegular * total;
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> solver(normal);
  Eigen::VectorXd solution = solver.solve(functions_ * wanted);
  solution += solver.solve(functions_ * (wanted - functions_.transpose() * solution));
  return solution;
}

BlockFit BlockFitter::fit(DegreePair degrees, std::span<const DensitySample> samples,
                          bool are_all) {
  if (are_all && !had_all_) {
    of_a_.clear();
    of_b_.clear();
    had_all_ = true;
  }
  const auto n_samples = static_cast<Index>(samples.size());
  Eigen::VectorXd wanted(n_samples);
  Eigen::VectorXd roots(n_samples);
  double total = 0;
  for (Index s = 0; s < n_samples; ++s) {
    roots[s] = std::sqrt(samples[s].weight);
    wanted[s] = roots[s] * samples[s].density;
    total += samples[s].weight;
  }
  BlockFit fit;
  Eigen::VectorXd fitted;
  if (degrees.a == 0 && degrees.b == 0) {
    fit.coefficients = {roots.dot(wanted) / total};
    fitted = fit.coefficients[0] * roots;
  } else {
    evaluate(samples);
    const Eigen::VectorXd solution = least_squares(degrees, wanted, roots, total);
    fit.coefficients.assign(solution.data(), solution.data() + solution.size());
    fitted = functions_.transpose() * solution;
  }
  const auto n = static_cast<Index>(fit.coefficients.size());
  const double freedom = are_all ? 1.0
                                 : static_cast<double>(n_samples) /
                                       static_cast<double>(std::max<Index>(n_samples - n, 1));
  fit.error = std::sqrt((fitted - wanted).squaredNorm() / total * freedom);
  fit.lowest = std::min(0.0, fitted.cwiseQuotient(roots).minCoeff());
  return fit;
}

}  // namespace radiosity
