#include "continuum/modes/shell_operator.h"

#include <algorithm>
#include <span>

#include "continuum/parallel/petsc_session.h"

namespace pseudorigid::continuum {
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

}  // namespace pseudorigid::continuum
