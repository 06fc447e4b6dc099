#pragma once

#include <Eigen/Core>
#include <functional>

namespace radiosity {

/// The radiosity equation of one column as a system A x = b of n unknowns, for a solver from
/// elsewhere: x = (A_i ρ_i)^½ ΔH_i and
///
///     A = I - R F̂ R,   F̂ = A^-½ G A^-½,   R = ρ^½,
///
/// symmetric, positive definite where light dies out. Where light is passed on to other patches
/// (SolveOptions::transmission) x = A_i^½ ΔH_i and A = I - F̂ A^½ (ρ + T) A^-½, which is not
/// symmetric. Norms of b - A x are energy norms.
struct LinearSystem {
  Eigen::VectorXd right_side;  ///< b, n
  bool is_symmetric = true;
  /// ‖b - A x‖ / ‖b‖ that gives what is asked of the solution.
  double tolerance = 0;
  int max_products = 0;  ///< that there may be, of A or its transpose
  /// A u, of n values. Throws Interrupted.
  std::function<Eigen::VectorXd(const Eigen::VectorXd& u)> apply;
  /// Aᵀ u.
  std::function<Eigen::VectorXd(const Eigen::VectorXd& u)> apply_transposed;
};

struct LinearSolution {
  Eigen::VectorXd unknowns;  ///< x, n, as good as it got
  int iterations = 0;
};

using LinearSolver = std::function<LinearSolution(const LinearSystem&)>;

}  // namespace radiosity
