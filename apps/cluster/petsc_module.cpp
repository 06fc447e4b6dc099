#include "apps/cluster/petsc_module.h"

#include <petscksp.h>

#include <exception>
#include <memory>
#include <sstream>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "radiosity/base/error.h"

namespace apps {
namespace {

using radiosity::LinearSolution;
using radiosity::LinearSystem;

static_assert(std::is_same_v<PetscScalar, double>, "PETSc of real numbers: libpetsc-real-dev");

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

/// Whether a word is an option and not the value of one, which may be a negative number.
bool is_option(std::string_view word) {
  return word.size() > 1 && word[0] == '-' && word.find_first_of("0123456789.") != 1;
}

/// What PETSc's functions leave behind: the first of its messages, or what a product threw.
struct Trouble {
  std::string message;
  std::exception_ptr thrown;

  /// Throws if `code` is an error.
  void check(PetscErrorCode code) {
    if (code == 0) return;
    if (thrown) std::rethrow_exception(std::exchange(thrown, nullptr));
    throw radiosity::SolveError("PETSc: " + std::exchange(message, ""));
  }
};

PetscErrorCode keep_message(MPI_Comm /*of*/, int /*line*/, const char* /*function*/,
                            const char* /*file*/, PetscErrorCode code, PetscErrorType type,
                            const char* message, void* trouble) {
  std::string& kept = static_cast<Trouble*>(trouble)->message;
  if (type == PETSC_ERROR_INITIAL && message != nullptr) kept = message;
  return code;
}

/// A PETSc object that ends with its scope.
template <typename Object, PetscErrorCode (*destroy)(Object*)>
struct Owned {
  Owned() = default;
  ~Owned() { destroy(&object); }
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  Object object = nullptr;
};

struct Shell {
  const LinearSystem& system;
  Trouble& trouble;
};

/// y = A x, or Aᵀ x.
template <auto product>
PetscErrorCode multiply(Mat matrix, Vec x, Vec y) {
  void* context = nullptr;
  if (const PetscErrorCode code = MatShellGetContext(matrix, &context)) return code;
  const Shell& shell = *static_cast<const Shell*>(context);
  const auto n = shell.system.right_side.size();
  const PetscScalar* from = nullptr;
  PetscScalar* to = nullptr;
  if (const PetscErrorCode code = VecGetArrayRead(x, &from)) return code;
  if (const PetscErrorCode code = VecGetArrayWrite(y, &to)) return code;
  PetscErrorCode result = 0;
  try {
    // Not through PETSc's frames, which are C.
    Eigen::Map<Eigen::VectorXd>(to, n) =
        (shell.system.*product)(Eigen::Map<const Eigen::VectorXd>(from, n));
  } catch (...) {
    shell.trouble.thrown = std::current_exception();
    result = PETSC_ERR_USER;
  }
  if (const PetscErrorCode code = VecRestoreArrayRead(x, &from)) return code;
  if (const PetscErrorCode code = VecRestoreArrayWrite(y, &to)) return code;
  return result;
}

void prepare(KSP solver, Trouble& trouble) {
  PC preconditioner = nullptr;
  trouble.check(KSPGetPC(solver, &preconditioner));
  // The others want entries, which an operator in parts does not have at hand.
  trouble.check(PCSetType(preconditioner, PCNONE));
}

LinearSolution solve_by_petsc(const LinearSystem& system, Trouble& trouble) {
  const auto n = static_cast<PetscInt>(system.right_side.size());
  Shell shell{system, trouble};
  Owned<Mat, MatDestroy> matrix;
  Owned<Vec, VecDestroy> right_side;
  Owned<Vec, VecDestroy> unknowns;
  Owned<KSP, KSPDestroy> solver;
  trouble.check(MatCreateShell(PETSC_COMM_SELF, n, n, n, n, &shell, &matrix.object));
  trouble.check(MatShellSetOperation(
      matrix.object, MATOP_MULT,
      reinterpret_cast<void (*)()>(multiply<&LinearSystem::apply>)));  // as PETSc wants it
  trouble.check(MatShellSetOperation(
      matrix.object, MATOP_MULT_TRANSPOSE,
      reinterpret_cast<void (*)()>(multiply<&LinearSystem::apply_transposed>)));
  trouble.check(
      MatSetOption(matrix.object, MAT_SYMMETRIC, system.is_symmetric ? PETSC_TRUE : PETSC_FALSE));
  trouble.check(
      VecCreateSeqWithArray(PETSC_COMM_SELF, 1, n, system.right_side.data(), &right_side.object));
  LinearSolution solution{Eigen::VectorXd::Zero(n), 0};
  trouble.check(
      VecCreateSeqWithArray(PETSC_COMM_SELF, 1, n, solution.unknowns.data(), &unknowns.object));
  trouble.check(KSPCreate(PETSC_COMM_SELF, &solver.object));
  trouble.check(KSPSetOperators(solver.object, matrix.object, matrix.object));
  trouble.check(KSPSetTolerances(solver.object, system.tolerance, PETSC_DEFAULT, PETSC_DEFAULT,
                                 system.max_products));
  prepare(solver.object, trouble);
  trouble.check(KSPSetFromOptions(solver.object));
  trouble.check(KSPSolve(solver.object, right_side.object, unknowns.object));
  PetscInt iterations = 0;
  trouble.check(KSPGetIterationNumber(solver.object, &iterations));
  solution.iterations = static_cast<int>(iterations);
  return solution;
}

struct Petsc {
  std::vector<std::string> words;
  std::vector<char*> arguments;  // which PETSc refers to until its end
  Trouble trouble;

  explicit Petsc(const std::string& options)
      : words(words_of("radiosity-mpi -no_signal_handler " + options)) {
    constexpr std::size_t kOurs = 2;
    if (words.size() > kOurs && !is_option(words[kOurs])) {
      throw radiosity::SolveError("--ksp: found '" + words[kOurs] +
                                  "', expected PETSc's options, such as '-ksp_type gmres'");
    }
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    auto count = static_cast<int>(words.size());
    char** given = arguments.data();
    // The others are no part of it.
    PETSC_COMM_WORLD = MPI_COMM_SELF;
    trouble.check(PetscInitialize(&count, &given, nullptr, nullptr));
    PETSC_STDOUT = stderr;  // which PetscInitialize sets, too
    trouble.check(PetscPushErrorHandler(keep_message, &trouble));
    try {
      try_options();
    } catch (...) {
      PetscFinalize();
      throw;
    }
  }
  ~Petsc() { PetscFinalize(); }
  Petsc(const Petsc&) = delete;
  Petsc& operator=(const Petsc&) = delete;

  /// Finds out before the long work what KSP would refuse or not see.
  void try_options() {
    Owned<KSP, KSPDestroy> solver;
    trouble.check(KSPCreate(PETSC_COMM_SELF, &solver.object));
    prepare(solver.object, trouble);
    trouble.check(KSPSetFromOptions(solver.object));
    for (const std::string& word : words) {
      if (!is_option(word) || !word.starts_with("-ksp_")) continue;
      PetscBool is_used = PETSC_FALSE;
      trouble.check(PetscOptionsUsed(nullptr, word.c_str() + 1, &is_used));
      if (is_used == PETSC_TRUE) continue;
      throw radiosity::SolveError("--ksp: this solver of PETSc has no option " + word);
    }
  }
};

void* begin(const std::string& options) { return std::make_unique<Petsc>(options).release(); }

LinearSolution solve(void* petsc, const LinearSystem& system) {
  return solve_by_petsc(system, static_cast<Petsc*>(petsc)->trouble);
}

void end(void* petsc) { const std::unique_ptr<Petsc> ended(static_cast<Petsc*>(petsc)); }

}  // namespace
}  // namespace apps

extern "C" const apps::PetscModule radiosity_petsc_module;
const apps::PetscModule radiosity_petsc_module = {apps::begin, apps::solve, apps::end};
