#include "radiosity/solve/solve.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>

#include "radiosity/solve/conjugate_gradients.h"
#include "radiosity/solve/external_solver.h"
#include "radiosity/solve/irradiance_system.h"
#include "radiosity/solve/jacobi.h"
#include "radiosity/solve/relaxation.h"
#include "radiosity/solve/solution_error.h"

namespace radiosity {
namespace {

std::string shape(const Eigen::MatrixXd& matrix) {
  return std::to_string(matrix.rows()) + " x " + std::to_string(matrix.cols());
}

/// Throws SolveError at the first value outside [0, largest]; NaN is outside.
void require_range(const Eigen::MatrixXd& values, const std::string& name, double largest,
                   const std::string& expected) {
  for (Index c = 0; c < values.cols(); ++c) {
    for (Index i = 0; i < values.rows(); ++i) {
      if (values(i, c) >= 0 && values(i, c) <= largest) continue;
      throw SolveError(name + " of patch " + std::to_string(i) + ", column " + std::to_string(c) +
                       " is " + std::to_string(values(i, c)) + "; expected " + expected);
    }
  }
}

/// Row sums of ρ + T that rounding may leave above 1.
constexpr double kAboveOne = 1e-12;

void require_valid_extras(const SolveOptions& options, const Eigen::MatrixXd& exitance,
                          const Eigen::MatrixXd& reflectance) {
  if (options.incident.size() > 0) {
    if (options.incident.rows() != exitance.rows() || options.incident.cols() != exitance.cols()) {
      throw SolveError("incident is " + shape(options.incident) + " and exitance " +
                       shape(exitance) + "; expected the same shape");
    }
    require_range(options.incident, "incident", std::numeric_limits<double>::max(),
                  "a finite value of at least 0 W/m²");
  }
  const Eigen::SparseMatrix<double>& passing = options.transmission;
  if (passing.size() == 0) return;
  if (passing.rows() != exitance.rows() || passing.cols() != exitance.rows()) {
    throw SolveError("transmission is " + std::to_string(passing.rows()) + " x " +
                     std::to_string(passing.cols()) + ", but there are " +
                     std::to_string(exitance.rows()) +
                     " patches; expected one row and column each");
  }
  if (passing.nonZeros() == 0) return;
  if (options.method == Method::gauss_seidel || options.method == Method::southwell) {
    throw SolveError("light that passes through sheets cannot be solved for by " +
                     std::string(method_name(options.method)) +
                     "; expected cg, jacobi or chebyshev");
  }
  const Eigen::VectorXd sums = passing * Eigen::VectorXd::Ones(passing.cols());
  for (Index i = 0; i < sums.size(); ++i) {
    if (sums[i] >= 0 && sums[i] + reflectance.row(i).maxCoeff() <= 1 + kAboveOne) continue;
    throw SolveError("reflectance and transmission of patch " + std::to_string(i) + " sum to " +
                     std::to_string(sums[i] + reflectance.row(i).maxCoeff()) +
                     "; expected at most 1");
  }
}

void require_valid_start(const Eigen::MatrixXd& start, const Eigen::MatrixXd& exitance) {
  if (start.size() == 0) return;
  if (start.rows() != exitance.rows() || start.cols() != exitance.cols()) {
    throw SolveError("start is " + shape(start) + " and exitance " + shape(exitance) +
                     "; expected the same shape, or no start");
  }
  if (!start.allFinite()) {
    throw SolveError("start has a value that is not finite; expected irradiance, W/m²");
  }
}

void require_valid(const Transport& transport, const Eigen::MatrixXd& exitance,
                   const Eigen::MatrixXd& reflectance, const SolveOptions& options) {
  const std::string n = std::to_string(transport.size());
  if (transport.size() == 0) throw SolveError("there are no patches to solve for");
  if (exitance.rows() != transport.size()) {
    throw SolveError("exitance is " + shape(exitance) + ", but the transport has " + n +
                     " patches; expected one row per patch");
  }
  if (reflectance.rows() != transport.size()) {
    throw SolveError("reflectance is " + shape(reflectance) + ", but the transport has " + n +
                     " patches; expected one row per patch");
  }
  if (exitance.cols() == 0 || reflectance.cols() == 0 ||
      exitance.cols() % reflectance.cols() != 0) {
    throw SolveError("exitance is " + shape(exitance) + " and reflectance " + shape(reflectance) +
                     "; expected the columns of exitance to be a multiple of those of reflectance");
  }
  if (options.has_sinks) {
    if (!exitance.allFinite()) throw SolveError("exitance has a value that is not finite");
  } else {
    require_range(exitance, "exitance", std::numeric_limits<double>::max(),
                  "a finite value of at least 0 W/m²");
  }
  require_range(reflectance, "reflectance", 1, "a value in [0, 1]");
  if (options.method == Method::external && !options.solver) {
    throw SolveError(
        "the method is external, but there is no solver; expected SolveOptions::solver");
  }
}

Iterate iterate_with(const SolveOptions& options, const IrradianceSystem& system,
                     SolveMonitor& monitor) {
  switch (options.method) {
    case Method::conjugate_gradients:
      return conjugate_gradients(system, monitor);
    case Method::jacobi:
      return jacobi(system, monitor);
    case Method::gauss_seidel:
      return gauss_seidel(system, monitor);
    case Method::southwell:
      return southwell(system, monitor);
    case Method::chebyshev:
      return chebyshev(system, monitor);
    case Method::external:
      return solve_externally(system, options.solver, monitor);
  }
  throw SolveError("unknown solution method");
}

EnergyBalance energy_balance(const IrradianceSystem& system, const Eigen::MatrixXd& b,
                             const Eigen::MatrixXd& gathered) {
  const Eigen::VectorXd& area = system.transport->area();
  // What lies on a solid's face and looks into it shines on that face alone, and backs take what
  // they meet.
  const AssemblyReport& report = system.transport->report();
  Eigen::VectorXd taken = Eigen::VectorXd::Zero(b.rows());
  for (const Eigen::VectorXd* shares : {&report.covered, &report.backs}) {
    if (shares->size() == b.rows()) taken += area.cwiseProduct(*shares);
  }
  const Eigen::VectorXd leak =
      area.cwiseProduct(Eigen::VectorXd::Ones(b.rows()) - system.row_sums) - taken;
  EnergyBalance energy;
  energy.emitted = system.exitance.transpose() * area;
  energy.incident = Eigen::VectorXd::Zero(b.cols());
  energy.escaped = b.transpose() * leak;
  energy.absorbed.resize(b.cols());
  if (system.incident.size() > 0) energy.incident = system.incident.transpose() * area;
  for (Index c = 0; c < b.cols(); ++c) {
    const Eigen::ArrayXd kept = 1 - system.passed_share.col(system.band(c)).array();
    energy.absorbed[c] =
        (area.array() * kept * gathered.col(c).array()).sum() + taken.dot(b.col(c));
  }
  return energy;
}

/// Largest ‖ρ (F B - H)‖ / ‖M_e + ρ H_0‖ (energy norm) over the columns with light.
double relative_residual(const IrradianceSystem& system, const Iterate& iterate) {
  const Eigen::VectorXd& area = system.transport->area();
  double largest = 0;
  for (Index c = 0; c < system.n_columns(); ++c) {
    const Eigen::VectorXd residual =
        system.passed_on(c, iterate.gathered.col(c) - iterate.irradiance.col(c));
    const double emitted = area.dot(system.source(c).cwiseAbs2());
    if (emitted > 0) {
      largest = std::max(largest, std::sqrt(area.dot(residual.cwiseAbs2()) / emitted));
    }
  }
  return largest;
}

/// Largest bound over the columns; infinite if one column has light but no proof that it dies out.
double proved_bound(const IrradianceSystem& system, const Iterate& iterate) {
  const Eigen::VectorXd bounds = system.error_bounds(iterate);
  double largest = 0;
  for (Index c = 0; c < bounds.size(); ++c) {
    const bool is_proved = bounds[c] == 0 || system.has_bound(c);
    largest = std::max(largest, is_proved ? bounds[c] : std::numeric_limits<double>::infinity());
  }
  return largest;
}

}  // namespace

std::string_view method_name(Method method) {
  switch (method) {
    case Method::conjugate_gradients:
      return "cg";
    case Method::jacobi:
      return "jacobi";
    case Method::gauss_seidel:
      return "gauss-seidel";
    case Method::southwell:
      return "southwell";
    case Method::chebyshev:
      return "chebyshev";
    case Method::external:
      return "external";
  }
  return "unknown";
}

std::span<const Method> all_methods() {
  static constexpr std::array kMethods = {Method::conjugate_gradients, Method::jacobi,
                                          Method::gauss_seidel, Method::southwell,
                                          Method::chebyshev};
  return kMethods;
}

std::optional<Method> method_named(std::string_view name) {
  for (const Method method : all_methods()) {
    if (method_name(method) == name) return method;
  }
  return std::nullopt;
}

Solution solve(const Transport& transport, const Eigen::MatrixXd& exitance,
               const Eigen::MatrixXd& reflectance, const SolveOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  require_valid(transport, exitance, reflectance, options);
  require_valid_extras(options, exitance, reflectance);
  require_valid_start(options.start, exitance);
  SolveMonitor monitor(options);
  const IrradianceSystem system = make_irradiance_system(transport, exitance, reflectance, monitor);
  const Iterate iterate = iterate_with(options, system, monitor);

  Solution solution;
  solution.method = options.method;
  solution.iterations = monitor.iterations();
  solution.products = monitor.products();
  solution.radiosity = system.radiosity(iterate.irradiance);
  solution.irradiance = iterate.gathered;
  solution.exitance = exitance;
  solution.incident = options.incident;
  solution.transmission = options.transmission;
  solution.reflectance = reflectance.replicate(1, exitance.cols() / reflectance.cols());
  solution.energy = energy_balance(system, solution.radiosity, iterate.gathered);
  solution.residual = relative_residual(system, iterate);
  solution.error_bound = proved_bound(system, iterate);
  solution.converged = solution.error_bound <= options.tolerance;
  solution.transport_error_bound = transport_error_bound(system);
  solution.radiosity_error = options.estimates_errors
                                 ? radiosity_error(system, iterate, options.progress)
                                 : Eigen::MatrixXd::Zero(exitance.rows(), exitance.cols()).eval();
  solution.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return solution;
}

}  // namespace radiosity
