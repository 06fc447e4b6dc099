#include "radiosity/polygon/gauss.h"

#include <Eigen/Eigenvalues>
#include <cassert>
#include <vector>

namespace radiosity {
namespace {

/// Rule for the weight x^beta on [0, 1], beta 0 or 1, from the eigenvalues of the Jacobi matrix.
/// (Golub & Welsch 1969; recurrence of the Jacobi polynomials P^(0,beta))
std::vector<GaussPoint> make_rule(int n, int beta) {
  Eigen::VectorXd diagonal(n);
  Eigen::VectorXd below(std::max(n - 1, 0));
  for (int k = 0; k < n; ++k) {
    const double m = 2.0 * k + beta;
    diagonal[k] = beta == 0 ? 0 : 1 / (m * (m + 2));
    if (k > 0) below[k - 1] = beta == 0 ? k / std::sqrt(m * m - 1) : std::sqrt(k * (k + 1.0)) / m;
  }
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(diagonal, below);
  std::vector<GaussPoint> rule(n);
  for (int k = 0; k < n; ++k) {
    const double first = solver.eigenvectors()(0, k);
    rule[k] = {(1 + solver.eigenvalues()[k]) / 2, first * first / (1 + beta)};
  }
  return rule;
}

std::vector<std::vector<GaussPoint>> make_rules(int beta) {
  std::vector<std::vector<GaussPoint>> rules(1);
  for (int n = 1; n <= kMaxGaussOrder; ++n) rules.push_back(make_rule(n, beta));
  return rules;
}

}  // namespace

std::span<const GaussPoint> gauss_rule(int n) {
  assert(n >= 1 && n <= kMaxGaussOrder);
  static const auto rules = make_rules(0);
  return rules[n];
}

std::span<const GaussPoint> gauss_jacobi_rule(int n) {
  assert(n >= 1 && n <= kMaxGaussOrder);
  static const auto rules = make_rules(1);
  return rules[n];
}

}  // namespace radiosity
