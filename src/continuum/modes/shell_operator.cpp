#include "continuum/modes/shell_operator.h"

#include <algorithm>
#include <string>

#include "continuum/parallel/petsc_session.h"

namespace pseudorigid::continuum {
namespace {

/// The objects of PETSc that one solution allocates.
struct Solution {
  KSP solver = nullptr;
  Vec right = nullptr, solution = nullptr;
  ~Solution() {
    VecDestroy(&right);
    VecDestroy(&solution);
    KSPDestroy(&solver);
  }
};

PetscErrorCode run(Solution& s, Mat matrix, const std::vector<double>& b, double relative, double absolute,
                   int max_iterations, std::vector<double>& x) {
  const auto n = static_cast<PetscInt>(b.size());
  PetscCall(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, n, b.data(), &s.right));
  PetscCall(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, n, x.data(), &s.solution));
  PetscCall(KSPCreate(PETSC_COMM_SELF, &s.solver));
  PetscCall(KSPSetOperators(s.solver, matrix, matrix));
  PetscCall(KSPSetType(s.solver, KSPGMRES));
  PetscCall(KSPGMRESSetRestart(s.solver, max_iterations));
  PC none;
  PetscCall(KSPGetPC(s.solver, &none));
  PetscCall(PCSetType(none, PCNONE));
  PetscCall(KSPSetTolerances(s.solver, relative, absolute, PETSC_DEFAULT, max_iterations));
  PetscCall(KSPSolve(s.solver, s.right, s.solution));
  return 0;
}

}  // namespace

PetscErrorCode ShellOperator::multiply(Mat matrix, Vec in, Vec out) {
  void* context;
  PetscCall(MatShellGetContext(matrix, &context));
  const PetscScalar* x;
  PetscScalar* y;
  PetscInt n;
  PetscCall(VecGetLocalSize(in, &n));
  PetscCall(VecGetArrayRead(in, &x));
  PetscCall(VecGetArray(out, &y));
  auto& self = *static_cast<ShellOperator*>(context);
  const std::span<double> product{y, static_cast<std::size_t>(n)};
  if (self.status_) self.status_ = self.apply_({x, static_cast<std::size_t>(n)}, product);
  if (!self.status_) std::ranges::fill(product, 0.0);
  PetscCall(VecRestoreArrayRead(in, &x));
  PetscCall(VecRestoreArray(out, &y));
  return 0;
}

ShellOperator::ShellOperator(const LinearOperator& apply, std::size_t size) : apply_(apply) {
  start_petsc();
  const auto n = static_cast<PetscInt>(size);
  if (MatCreateShell(PETSC_COMM_SELF, n, n, n, n, this, &matrix_) != 0 ||
      MatShellSetOperation(matrix_, MATOP_MULT, reinterpret_cast<void (*)()>(multiply)) != 0)
    status_ = mechanics::Status::failure("PETSc reports an error");
}

mechanics::SolveReport solve_by_gmres(const LinearOperator& A, const std::vector<double>& b, double relative,
                                      double absolute, int max_iterations, std::vector<double>& x) {
  x.assign(b.size(), 0);
  if (std::ranges::all_of(b, [](double entry) { return entry == 0; })) return {};
  ShellOperator shell(A, b.size());
  Solution solution;
  const bool fine = shell.status() && run(solution, shell.matrix(), b, relative, absolute, max_iterations, x) == 0;
  if (!shell.status()) return {shell.status()};
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  PetscInt n_iterations = 0;
  if (!fine || KSPGetConvergedReason(solution.solver, &reason) != 0 ||
      KSPGetIterationNumber(solution.solver, &n_iterations) != 0)
    return {mechanics::Status::failure("PETSc reports an error")};
  if (reason > 0) return {{}, static_cast<int>(n_iterations)};
  return {
      mechanics::Status::failure("GMRES does not converge within " + std::to_string(max_iterations) + " iterations")};
}

}  // namespace pseudorigid::continuum
