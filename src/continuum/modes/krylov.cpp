#include "continuum/modes/krylov.h"

#include <deal.II/lac/precondition.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_gmres.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <string>

namespace pseudorigid::continuum {
namespace {

/// The operator in the form that deal.II needs. After a product has failed, all products are 0.
struct Products {
  const LinearOperator& apply;
  mutable mechanics::Status status{};

  void vmult(dealii::Vector<double>& out, const dealii::Vector<double>& in) const {
    if (status) status = apply({in.begin(), in.size()}, {out.begin(), out.size()});
    if (!status) out = 0;
  }
};

}  // namespace

mechanics::SolveReport solve_by_gmres(const LinearOperator& A, const std::vector<double>& b, double relative,
                                      double absolute, int max_iterations, std::vector<double>& x) {
  const dealii::Vector<double> right(b.begin(), b.end());
  dealii::Vector<double> solution(static_cast<unsigned int>(b.size()));
  Products products{A};
  const auto n_most = static_cast<unsigned int>(max_iterations);
  dealii::SolverControl control(n_most, std::max(relative * right.l2_norm(), absolute), false, false);
  using Gmres = dealii::SolverGMRES<dealii::Vector<double>>;
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
                                              double& value) {
  const dealii::Vector<double> right(start.begin(), start.end());
  dealii::Vector<double> solution(right.size());
  const Products products{A};
  dealii::IterationNumberControl control(static_cast<unsigned int>(n_steps), 1e-10 * right.l2_norm());
  dealii::SolverCG<dealii::Vector<double>> gradients(control);
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
