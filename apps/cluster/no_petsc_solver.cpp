#include "apps/cluster/petsc_solver.h"
#include "radiosity/base/error.h"

namespace apps {

struct PetscSolver::Implementation {};

PetscSolver::PetscSolver(radiosity::Ranks& ranks, const std::string& /*options*/) : ranks_(ranks) {
  on_first_rank(&ranks_, [] {
    throw radiosity::SolveError(
        "--ksp: this radiosity-mpi was built without PETSc; 'tools/setup --mpi' installs it");
  });
}

PetscSolver::~PetscSolver() = default;

radiosity::LinearSolver PetscSolver::solver() { return {}; }

}  // namespace apps
