#include "radiosity/compressed/block_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

namespace radiosity {

BlockFit fit_block(const ClusterPolynomials& polynomials, const std::vector<std::int32_t>& order,
                   std::int32_t a, std::int32_t b, DegreePair degrees,
                   std::span<const DensitySample> samples, bool are_all) {
  const int n = n_coefficients(polynomials.counts(a), polynomials.counts(b), degrees);
  const auto n_samples = static_cast<Index>(samples.size());
  Eigen::MatrixXd functions(n, n_samples);
  Eigen::VectorXd wanted(n_samples);
  std::array<double, ClusterPolynomials::kMost> of_a{};
  std::array<double, ClusterPolynomials::kMost> of_b{};
  double total = 0;
  for (Index s = 0; s < n_samples; ++s) {
    const DensitySample& sample = samples[s];
    polynomials.evaluate(a, order[sample.row], degrees.a, of_a.data());
    polynomials.evaluate(b, order[sample.column], degrees.b, of_b.data());
    const double root = std::sqrt(sample.weight);
    total += sample.weight;
    int row = 0;
    for_each_function(polynomials.counts(a), polynomials.counts(b), degrees, [&](int k, int count) {
      for (int l = 0; l < count; ++l) {
        functions(row++, s) = root * of_a[k] * of_b[l];
      }
    });
    wanted[s] = root * sample.density;
  }
  BlockFit fit;
  Eigen::VectorXd solution;
  if (n == 1) {
    solution.resize(1);
    solution[0] = functions.row(0).dot(wanted) / total;
  } else {
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(n, n);
    normal.selfadjointView<Eigen::Lower>().rankUpdate(functions);
    // A combination that the samples hardly see stays small. What that takes from the others is
    // given back by a second step. (Tikhonov, iterated)
    constexpr double kRegular = 1e-3;
    normal.diagonal().array() += kRegular * total;
    const auto solver = normal.selfadjointView<Eigen::Lower>().ldlt();
    solution = solver.solve(functions * wanted);
    solution += solver.solve(functions * (wanted - functions.transpose() * solution));
  }
  const Eigen::VectorXd fitted = functions.transpose() * solution;
  const double freedom = are_all ? 1.0
                                 : static_cast<double>(n_samples) /
                                       static_cast<double>(std::max<Index>(n_samples - n, 1));
  fit.error = std::sqrt((fitted - wanted).squaredNorm() / total * freedom);
  fit.lowest = 0;
  for (Index s = 0; s < n_samples; ++s) {
    fit.lowest = std::min(fit.lowest, fitted[s] / std::sqrt(samples[s].weight));
  }
  fit.coefficients.assign(solution.data(), solution.data() + n);
  return fit;
}

}  // namespace radiosity
