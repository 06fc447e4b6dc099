#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <functional>
#include <optional>
#include <span>
#include <string_view>

#include "radiosity/base/progress.h"
#include "radiosity/solve/linear_solver.h"

namespace radiosity {

/// Iterations for (I - ρ F) B = M_e. Conjugate gradients on the symmetrised system is the fastest;
/// the others are there to learn from and to compare with, but for `external`: that is whatever
/// SolveOptions::solver does.
enum class Method { conjugate_gradients, jacobi, gauss_seidel, southwell, chebyshev, external };

/// "cg", "jacobi", "gauss-seidel", "southwell", "chebyshev", "external".
std::string_view method_name(Method method);
/// All that are there to choose from, not `external`, in the order of the enumeration.
std::span<const Method> all_methods();
/// Empty if none of these has that name.
std::optional<Method> method_named(std::string_view name);

/// Where an iteration stands. The fields are worked out when asked for, during the call only.
struct SolveStep {
  int iteration = 0;    ///< steps of the method so far; of Southwell: shots
  double products = 0;  ///< operator products that these cost
  double error_bound = 0;  ///< guaranteed bound on ‖ΔB‖/‖B‖ (energy norm) of `radiosity`; with 1
                           ///< for 1/(1 - q), which is no bound, where none can be proved
  /// B = M_e + ρ H, W/m², n x k. Of Southwell: shot and unshot light together.
  std::function<Eigen::MatrixXd()> radiosity;
  /// Light that has arrived and is not passed on yet, W/m², n x k: the residual M_e + ρ F B - B,
  /// which may be negative. Gauss-Seidel has it for the price of a product. Of Southwell: the part
  /// U of B that no patch has shot, so that B = M_e + ρ F (B - U); negative only after a warm
  /// start.
  std::function<Eigen::MatrixXd()> unshot;
};

struct SolveOptions {
  Method method = Method::conjugate_gradients;
  LinearSolver solver = {};  ///< for Method::external
  double tolerance = 1e-8;  ///< guaranteed bound on ‖ΔB‖/‖B‖ (energy norm) of the iteration
  bool estimates_errors = true;  ///< fill in Solution::radiosity_error; costs some tens of products
  int max_products = 100000;     ///< operator products (or the work of as many) before giving up
  /// Irradiance to start from, W/m², n x k; empty: darkness. Of a problem that is much the same,
  /// its solution's. Takes part in the first product. Unlit columns start from darkness all the
  /// same.
  Eigen::MatrixXd start = {};
  /// Irradiance that does not come from patches, of the sun or of surroundings, W/m², n x k, >= 0:
  /// H = F B + this. Empty: none.
  Eigen::MatrixXd incident = {};
  /// Light that patches pass on to others than themselves, as the two sides of a sheet do:
  /// B = M_e + (ρ + T) H with T n x n, the same in all columns; not negative, A_i T_ij = A_j T_ji,
  /// ρ + T positive semidefinite, its row sums at most 1. Empty: none. Not with Gauss-Seidel and
  /// Southwell.
  Eigen::SparseMatrix<double> transmission = {};
  /// Whether the light is heat: exitance may be negative, which is taken away, and patches that
  /// pass all they receive on to each other are refused even where none falls on them, for nothing
  /// fixes their temperatures.
  bool has_sinks = false;
  /// Called at the beginning and after each step, of Southwell after each shot. A column that has
  /// converged waits for the others.
  std::function<void(const SolveStep&)> on_step = {};
  Progress progress = {};
};

/// Where the power goes, W, one value per column of the solution. emitted + incident = absorbed +
/// escaped.
struct EnergyBalance {
  Eigen::VectorXd emitted;        ///< Σ A M_e
  Eigen::VectorXd incident = {};  ///< Σ A H_0, from without: of sun and environment
  Eigen::VectorXd absorbed;       ///< Σ A (1 - ρ - T) H, and what backs and covers take
  Eigen::VectorXd escaped;        ///< Σ A B (1 - covered - backs - row sum): leaves the scene
};

/// The radiosity of every patch, and what is known about its error. The energy norm of a field B is
/// ‖B‖ = sqrt(Σ A B²); relative figures are the largest over the columns.
struct Solution {
  Eigen::MatrixXd radiosity;        ///< B, W/m², n x k
  Eigen::MatrixXd irradiance;       ///< H = F B + H_0, W/m², n x k
  Eigen::MatrixXd exitance;         ///< M_e as given, W/m², n x k
  Eigen::MatrixXd reflectance;      ///< ρ as given, n x k
  Eigen::MatrixXd radiosity_error;  ///< one standard error of B (form factors and iteration), W/m²
  Eigen::MatrixXd incident;         ///< H_0 as given, from without, W/m², n x k; or empty
  Eigen::SparseMatrix<double> transmission;  ///< T as given, n x n; or empty
  /// What each patch is at if the light is heat, K, n (radiosity::temperatures); or empty.
  Eigen::VectorXd temperature;
  EnergyBalance energy;  ///< per column
  Method method = Method::conjugate_gradients;
  int iterations = 0;   ///< steps of the method
  double products = 0;  ///< operator products that these cost (not those for radiosity_error)
  double residual = 0;  ///< relative residual ‖r‖/‖M_e‖, r = M_e + ρ F B - B
  double error_bound = 0;  ///< guaranteed bound on ‖ΔB‖/‖B‖ of the iteration; infinite if no bound
                           ///< could be proved (closed white rooms), never NaN
  double transport_error_bound = 0;  ///< bound on ‖ΔB‖/‖B‖ from the form factors' standard errors;
                                     ///< may be infinite too
  bool converged = false;  ///< whether error_bound <= tolerance
  double seconds = 0;      ///< wall time

  /// B - H, what each patch loses by radiation (negative: gains), W/m², n x k.
  [[nodiscard]] Eigen::MatrixXd net_flux() const { return radiosity - irradiance; }
  /// (ρ + T) H, W/m², n x k, of what patches receive.
  [[nodiscard]] Eigen::MatrixXd passed_on(const Eigen::MatrixXd& received) const;
  /// (1 - ρ - T) H, what each patch absorbs, W/m², n x k.
  [[nodiscard]] Eigen::MatrixXd absorbed_flux() const { return irradiance - passed_on(irradiance); }
  /// F B = H - H_0, what patches receive from each other, W/m², n x k.
  [[nodiscard]] Eigen::MatrixXd exchanged_irradiance() const;
  /// B - M_e - (ρ + T) H_0, what they pass on of that, W/m², n x k.
  [[nodiscard]] Eigen::MatrixXd exchanged_radiosity() const;
};

}  // namespace radiosity
