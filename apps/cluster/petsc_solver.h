#pragma once

#include <memory>
#include <string>

#include "radiosity/base/ranks.h"
#include "radiosity/solve/linear_solver.h"

namespace apps {

/// Krylov solvers of PETSc (KSP) for the transport operator, which they get as a shell matrix. They
/// run on the first rank alone; of the products all ranks make their shares, so what is found does
/// not depend on how many there are. PETSc lives as long as this: make it once, after MPI.
class PetscSolver {
 public:
  /// `options` are PETSc's own, such as "-ksp_type gmres -ksp_rtol 1e-10"; what they leave open is
  /// PETSc's choice, but for no preconditioner and the tolerance that the system asks for. What
  /// PETSc tells goes to stderr. All ranks call this together. Throws SolveError of options that
  /// KSP does not know, and if PETSc was not there when this was built; on the others
  /// FirstRankFailed.
  PetscSolver(radiosity::Ranks& ranks, const std::string& options);
  ~PetscSolver();
  PetscSolver(const PetscSolver&) = delete;
  PetscSolver& operator=(const PetscSolver&) = delete;

  /// What all ranks call together. Refers to this. Throws SolveError with what PETSc tells.
  [[nodiscard]] radiosity::LinearSolver solver();

 private:
  struct Implementation;
  radiosity::Ranks& ranks_;
  std::unique_ptr<Implementation> implementation_;  // on the first rank only
};

}  // namespace apps
