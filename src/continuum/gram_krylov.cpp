#include "continuum/gram_krylov.h"

#include <algorithm>

#include "continuum/petsc_session.h"

namespace pseudorigid::continuum {

GramKrylov::GramKrylov(const Vector& like, Operator multiply_by, Operator precondition_by)
    : multiply_{std::move(multiply_by), like, like}, precondition_{std::move(precondition_by), like, like} {
  start_petsc();
  const MPI_Comm communicator = like.get_mpi_communicator();
  const auto n = static_cast<PetscInt>(like.locally_owned_size());
  MatCreateShell(communicator, n, n, PETSC_DECIDE, PETSC_DECIDE, &multiply_, &matrix_);
  MatShellSetOperation(matrix_, MATOP_MULT, reinterpret_cast<void (*)()>(multiply));
  VecCreateMPIWithArray(communicator, 1, n, PETSC_DECIDE, nullptr, &r_);
  VecCreateMPIWithArray(communicator, 1, n, PETSC_DECIDE, nullptr, &lambda_);
  make(symmetric_, KSPCG);
  make(mixed_, KSPGMRES);
}

GramKrylov::~GramKrylov() {
  KSPDestroy(&symmetric_);
  KSPDestroy(&mixed_);
  VecDestroy(&r_);
  VecDestroy(&lambda_);
  MatDestroy(&matrix_);
}

void GramKrylov::make(KSP& solver, KSPType type) {
  KSPCreate(PetscObjectComm(reinterpret_cast<PetscObject>(matrix_)), &solver);
  KSPSetOptionsPrefix(solver, "gram_");
  KSPSetOperators(solver, matrix_, matrix_);
  KSPSetType(solver, type);
  KSPSetNormType(solver, KSP_NORM_UNPRECONDITIONED);
  KSPSetPCSide(solver, type == std::string(KSPGMRES) ? PC_RIGHT : PC_LEFT);
  PC preconditioner;
  KSPGetPC(solver, &preconditioner);
  PCSetType(preconditioner, PCSHELL);
  PCShellSetContext(preconditioner, &precondition_);
  PCShellSetApply(preconditioner, precondition);
  KSPSetFromOptions(solver);
}

PetscErrorCode GramKrylov::apply(Bound& bound, Vec in, Vec out) {
  const PetscScalar* x;
  PetscScalar* y;
  PetscCall(VecGetArrayRead(in, &x));
  std::copy_n(x, bound.in.locally_owned_size(), bound.in.begin());
  PetscCall(VecRestoreArrayRead(in, &x));
  bound.apply(bound.out, bound.in);
  PetscCall(VecGetArrayWrite(out, &y));
  std::copy_n(bound.out.begin(), bound.out.locally_owned_size(), y);
  PetscCall(VecRestoreArrayWrite(out, &y));
  return 0;
}

PetscErrorCode GramKrylov::multiply(Mat matrix, Vec in, Vec out) {
  void* bound;
  PetscCall(MatShellGetContext(matrix, &bound));
  return apply(*static_cast<Bound*>(bound), in, out);
}

PetscErrorCode GramKrylov::precondition(PC preconditioner, Vec in, Vec out) {
  void* bound;
  PetscCall(PCShellGetContext(preconditioner, &bound));
  return apply(*static_cast<Bound*>(bound), in, out);
}

mechanics::SolveReport GramKrylov::solve(bool symmetric, const Vector& r, double reduction, Vector& lambda) {
  constexpr PetscInt n_iterations_at_most = 200;
  const KSP solver = symmetric ? symmetric_ : mixed_;
  KSPSetTolerances(solver, reduction, 0, PETSC_DEFAULT, n_iterations_at_most);
  VecPlaceArray(r_, r.begin());
  VecPlaceArray(lambda_, lambda.begin());
  const bool ran = KSPSolve(solver, r_, lambda_) == 0;
  VecResetArray(r_);
  VecResetArray(lambda_);
  KSPConvergedReason reason;
  PetscInt n_iterations;
  KSPGetConvergedReason(solver, &reason);
  KSPGetIterationNumber(solver, &n_iterations);
  if (ran && reason > 0) return {{}, static_cast<int>(n_iterations)};
  return {mechanics::Status::failure("the multiplier's Gram system does not converge; use a smaller step"),
          static_cast<int>(n_iterations)};
}

}  // namespace pseudorigid::continuum
