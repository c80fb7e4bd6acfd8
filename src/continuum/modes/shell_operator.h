#pragma once
/// A linear operator of one process, given by a function that PETSc and SLEPc call.

#include <petscmat.h>

#include "continuum/modes/krylov.h"
#include "mechanics/core/status.h"

namespace pseudorigid::continuum {

/// A square operator as a matrix of PETSc. Functions that PETSc calls cannot return a mechanics::Status. If `apply`
/// fails, this product and all later products are therefore 0, and status() has the reason. `apply` must outlive this
/// object.
class ShellOperator {
 public:
  ShellOperator(const LinearOperator& apply, std::size_t size);
  ~ShellOperator() { MatDestroy(&matrix_); }
  ShellOperator(const ShellOperator&) = delete;
  ShellOperator& operator=(const ShellOperator&) = delete;

  Mat matrix() const { return matrix_; }
  const mechanics::Status& status() const { return status_; }

 private:
  static PetscErrorCode multiply(Mat matrix, Vec in, Vec out);

  const LinearOperator& apply_;
  mechanics::Status status_{};
  Mat matrix_ = nullptr;
};

}  // namespace pseudorigid::continuum
