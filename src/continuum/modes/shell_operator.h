#pragma once
/// A linear operator of one process, given by a function that PETSc and SLEPc call, and the solution of linear
/// equations with this operator.

#include <functional>
#include <span>
#include <vector>

#include <petscksp.h>

#include "mechanics/core/status.h"

namespace pseudorigid::continuum {

/// Sets `out` to the product of the operator with `in`. A failure ends the iteration that uses the operator.
using LinearOperator = std::function<mechanics::Status(std::span<const double> in, std::span<double> out)>;

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

/// Solves A x = b by GMRES from x = 0, until |b − A x| is at most `relative` times |b|, or at most `absolute`. Fails if
/// the residual is larger after `max_iterations` iterations, if a product fails, or if PETSc reports an error.
mechanics::SolveReport solve_by_gmres(const LinearOperator& A, const std::vector<double>& b, double relative,
                                      double absolute, int max_iterations, std::vector<double>& x);

}  // namespace pseudorigid::continuum
