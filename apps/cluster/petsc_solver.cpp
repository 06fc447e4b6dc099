#include "apps/cluster/petsc_solver.h"

#include <dlfcn.h>

#include <filesystem>

#include "apps/cluster/petsc_module.h"
#include "radiosity/base/error.h"
#include "radiosity/solve/led_solver.h"

namespace apps {
namespace {

/// The module beside the program, or where it is installed. Throws SolveError if it is not there or
/// does not load.
const PetscModule& load_module() {
  constexpr const char* kName = "radiosity-petsc.so";
  const auto folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  std::filesystem::path file = folder / kName;
  if (!std::filesystem::exists(file)) file = folder.parent_path() / "libexec/radiosity" / kName;
  if (!std::filesystem::exists(file)) {
    throw radiosity::SolveError(
        "--ksp: this radiosity-mpi was built without PETSc; 'tools/setup --mpi' installs it");
  }
  // For as long as the program lives, for MPI knows of it until its own end.
  void* const library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  const void* const module =
      library != nullptr ? ::dlsym(library, "radiosity_petsc_module") : nullptr;
  if (module == nullptr) throw radiosity::SolveError(std::string("--ksp: ") + ::dlerror());
  return *static_cast<const PetscModule*>(module);
}

}  // namespace

struct PetscSolver::Implementation {
  const PetscModule& module;
  void* petsc;

  explicit Implementation(const std::string& options)
      : module(load_module()), petsc(module.begin(options)) {}
  ~Implementation() { module.end(petsc); }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;
};

PetscSolver::PetscSolver(radiosity::Ranks& ranks, const std::string& options) : ranks_(ranks) {
  on_first_rank(&ranks_, [&] { implementation_ = std::make_unique<Implementation>(options); });
}

PetscSolver::~PetscSolver() = default;

radiosity::LinearSolver PetscSolver::solver() {
  return led_by_first_rank(ranks_, [this](const radiosity::LinearSystem& system) {
    return implementation_->module.solve(implementation_->petsc, system);
  });
}

}  // namespace apps
