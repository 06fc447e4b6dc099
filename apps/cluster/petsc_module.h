#pragma once

#include <string>

#include "radiosity/solve/linear_solver.h"

namespace apps {

/// What the module radiosity-petsc.so offers by the name `radiosity_petsc_module`. It is a file of
/// its own, since PETSc brings seventy libraries, which only who asks for it shall load.
struct PetscModule {
  /// Begins with PETSc's options. Throws SolveError of those that KSP does not know.
  void* (*begin)(const std::string& options);
  /// Throws SolveError with what PETSc tells, and whatever a product throws.
  radiosity::LinearSolution (*solve)(void* petsc, const radiosity::LinearSystem& system);
  void (*end)(void* petsc);
};

}  // namespace apps
