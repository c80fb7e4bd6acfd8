#pragma once
/// Krylov iterations, by deal.II. The entries of the vectors are distributed over the ranks of a communicator. On one
/// rank, the iterations do not start MPI, which would take 0.2 s.

#include <functional>
#include <span>
#include <vector>

#include "continuum/parallel/ranks.h"
#include "mechanics/core/status.h"

namespace pseudorigid::continuum {

/// A function that sets `out` to the product of an operator with `in`. Both contain the entries of this rank. On
/// several ranks, the function must not fail.
using LinearOperator = std::function<mechanics::Status(std::span<const double> in, std::span<double> out)>;

/// Solves A x = b by GMRES from x = 0, until |b − A x| is at most `relative` times |b|, or at most `absolute`. Fails if
/// the residual is larger after `max_iterations` iterations, or if a product fails. Collective.
mechanics::SolveReport solve_by_gmres(const LinearOperator& A, const std::vector<double>& b, double relative,
                                      double absolute, int max_iterations, std::vector<double>& x,
                                      MPI_Comm communicator = MPI_COMM_SELF);

/// The largest eigenvalue of a symmetric positive semidefinite operator, estimated from below by `n_steps` steps of the
/// Lanczos iteration (conjugate gradients) from `start`. Fails if a product fails or the estimate is not positive.
/// Collective.
mechanics::Status estimate_largest_eigenvalue(const LinearOperator& A, const std::vector<double>& start, int n_steps,
                                              double& value, MPI_Comm communicator = MPI_COMM_SELF);

}  // namespace pseudorigid::continuum
