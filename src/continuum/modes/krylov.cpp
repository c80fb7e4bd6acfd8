#include "continuum/modes/krylov.h"

#include <deal.II/lac/la_parallel_vector.h>
#include <deal.II/lac/precondition.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_gmres.h>

#include <algorithm>
#include <memory>
#include <string>

namespace pseudorigid::continuum {
namespace {

using Distributed = dealii::LinearAlgebra::distributed::Vector<double>;

/// The vector with these entries on this rank. Collective.
Distributed distributed(const std::vector<double>& values, MPI_Comm communicator) {
  Distributed result;
  if (n_ranks(communicator) == 1)
    result.reinit(values.size());
  else
    result.reinit(
        dealii::Utilities::MPI::create_ascending_partitioning(communicator, values.size())[this_rank(communicator)],
        communicator);
  std::ranges::copy(values, result.begin());
  return result;
}

/// The operator in the form that deal.II needs. After a product has failed, all products are 0.
struct Products {
  const LinearOperator& apply;
  mutable mechanics::Status status{};

  void vmult(Distributed& out, const Distributed& in) const {
    if (status) status = apply({in.begin(), in.locally_owned_size()}, {out.begin(), out.locally_owned_size()});
    if (!status) out = 0;
  }
};

}  // namespace

mechanics::SolveReport solve_by_gmres(const LinearOperator& A, const std::vector<double>& b, double relative,
                                      double absolute, int max_iterations, std::vector<double>& x,
                                      MPI_Comm communicator) {
  const Distributed right = distributed(b, communicator);
  Distributed solution;
  solution.reinit(right);
  Products products{A};
  const auto n_most = static_cast<unsigned int>(max_iterations);
  dealii::SolverControl control(n_most, std::max(relative * right.l2_norm(), absolute), false, false);
  using Gmres = dealii::SolverGMRES<Distributed>;
  Gmres gmres(control, Gmres::AdditionalData(n_most + 2));
  std::string failure;
  try {
    gmres.solve(products, solution, right, dealii::PreconditionIdentity());
  } catch (const dealii::SolverControl::NoConvergence&) {
    failure = "GMRES does not converge within " + std::to_string(max_iterations) + " iterations";
  }
  x.assign(solution.begin(), solution.end());
  if (!products.status) return {products.status};
  if (!failure.empty()) return {mechanics::Status::failure(failure)};
  return {{}, static_cast<int>(control.last_step())};
}

mechanics::Status estimate_largest_eigenvalue(const LinearOperator& A, const std::vector<double>& start, int n_steps,
                                              double& value, MPI_Comm communicator) {
  const Distributed right = distributed(start, communicator);
  Distributed solution;
  solution.reinit(right);
  const Products products{A};
  dealii::IterationNumberControl control(static_cast<unsigned int>(n_steps), 1e-10 * right.l2_norm());
  dealii::SolverCG<Distributed> gradients(control);
  value = 0;
  gradients.connect_eigenvalues_slot([&](const std::vector<double>& ascending) {
    if (!ascending.empty()) value = ascending.back();
  });
  try {
    gradients.solve(products, solution, right, dealii::PreconditionIdentity());
  } catch (const dealii::SolverControl::NoConvergence&) {  // of a residual that is not a number
  }
  if (!products.status) return products.status;
  return value > 0 ? mechanics::Status() : mechanics::Status::failure("the stiffness has no positive eigenvalue");
}

}  // namespace pseudorigid::continuum
