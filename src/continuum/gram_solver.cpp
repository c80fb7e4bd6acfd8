#include "continuum/gram_solver.h"

#include <deal.II/lac/solver_control.h>
#include <deal.II/lac/solver_gmres.h>
#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pseudorigid::continuum {
namespace {

/// G M^{-1/2} as a sparse matrix: one row a multiplier function, one column a position component.
Eigen::SparseMatrix<double, Eigen::RowMajor> scaled_constraint_matrix(const BallSpace& space,
                                                                      const CellKernels& kernels, const Vector& x) {
  const unsigned int n_columns_per_row = 3 * space.nodes_per_cell();
  const Eigen::Index n_rows = static_cast<Eigen::Index>(space.n_cells()) * space.n_pressure();
  Eigen::SparseMatrix<double, Eigen::RowMajor> G(n_rows, 3 * space.n_nodes());
  G.resizeNonZeros(n_rows * n_columns_per_row);
  for (Eigen::Index row = 0; row <= n_rows; ++row) G.outerIndexPtr()[row] = static_cast<int>(row * n_columns_per_row);

  std::vector<unsigned int> column(n_columns_per_row), order(n_columns_per_row);
  kernels.constraint_rows(x, [&](unsigned int cell, std::span<const double> rows) {
    const auto& nodes = space.cell_nodes(cell);
    for (unsigned int k = 0; k < n_columns_per_row; ++k) column[k] = 3 * nodes[k / 3] + k % 3;
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](unsigned int a, unsigned int b) { return column[a] < column[b]; });
    for (unsigned int j = 0; j < space.n_pressure(); ++j) {
      const std::size_t offset = (static_cast<std::size_t>(cell) * space.n_pressure() + j) * n_columns_per_row;
      for (unsigned int k = 0; k < n_columns_per_row; ++k) {
        const unsigned int c = column[order[k]];
        G.innerIndexPtr()[offset + k] = static_cast<int>(c);
        G.valuePtr()[offset + k] = rows[static_cast<std::size_t>(j) * n_columns_per_row + order[k]] *
                                   std::sqrt(space.inverse_mass().local_element(c));
      }
    }
  });
  return G;
}

}  // namespace

GramSolver::GramSolver(const BallSpace& space, const CellKernels& kernels)
    : space_(&space), kernels_(&kernels), factor_(std::make_unique<Cholesky>()), reaction_(space.make_vector()) {}

mechanics::Status GramSolver::factorize(const Vector& x) {
  const Eigen::SparseMatrix<double, Eigen::RowMajor> G = scaled_constraint_matrix(*space_, *kernels_, x);
  const Eigen::SparseMatrix<double> S = G * G.transpose();
  const bool first = n_factorizations_++ == 0;
  factor_entries_ = S.nonZeros();
  bool regular;
  if (S.rows() <= n_dense) {
    const Eigen::LLT<Eigen::MatrixXd> cholesky{Eigen::MatrixXd(S)};
    dense_inverse_ = cholesky.solve(Eigen::MatrixXd::Identity(S.rows(), S.rows()));
    regular = cholesky.info() == Eigen::Success;
  } else {
    if (first) factor_->analyzePattern(S);  // the pattern is that of the mesh and does not change
    factor_->factorize(S);
    regular = factor_->info() == Eigen::Success;
  }
  stale_ = !regular;
  if (regular) return {};
  return mechanics::Status::failure("the Gram operator of the incompressibility constraint is singular");
}

void GramSolver::apply_factor(Vector& result, const Vector& r) const {
  const Eigen::Index n = static_cast<Eigen::Index>(r.locally_owned_size());
  const Eigen::Map<const Eigen::VectorXd> in(r.begin(), n);
  Eigen::Map<Eigen::VectorXd> out(result.begin(), n);
  if (n <= n_dense)
    out.noalias() = dense_inverse_ * in;
  else
    out = factor_->solve(in);
}

mechanics::SolveReport GramSolver::iterate(const Vector& q1, const Vector& q0, const Vector& r, Vector& lambda) {
  struct MixedGram {
    GramSolver& self;
    const Vector &q1, &q0;
    void vmult(Vector& result, const Vector& multiplier) const {
      self.reaction_ = 0.0;
      self.kernels_->add_reaction(q0, multiplier, self.reaction_);
      self.reaction_.scale(self.space_->inverse_mass());
      self.kernels_->constraint_rate(q1, self.reaction_, result);
    }
  };
  struct Preconditioner {
    const GramSolver& self;
    void vmult(Vector& result, const Vector& r) const { self.apply_factor(result, r); }
  };
  lambda = 0.0;
  const double norm = r.l2_norm();
  if (norm == 0) return {};
  if (!std::isfinite(norm)) return {mechanics::Status::failure("the constraint's residual is not finite"), 0};
  dealii::SolverControl control(40, reduction * norm, false, false);
  dealii::SolverGMRES<Vector> gmres(control, dealii::SolverGMRES<Vector>::AdditionalData(42, true));
  try {
    gmres.solve(MixedGram{*this, q1, q0}, lambda, r, Preconditioner{*this});
  } catch (const dealii::SolverControl::NoConvergence&) {
    return {mechanics::Status::failure("the multiplier's Gram system does not converge; use a smaller step"),
            static_cast<int>(control.last_step())};
  }
  return {{}, static_cast<int>(control.last_step())};
}

mechanics::SolveReport GramSolver::solve(const Vector& q1, const Vector& q0, const Vector& r, Vector& lambda) {
  if (stale_)
    if (mechanics::Status status = factorize(q0); !status) return {std::move(status), 0};
  mechanics::SolveReport report = iterate(q1, q0, r, lambda);
  if (!report.status) {
    if (mechanics::Status status = factorize(q1); !status) return {std::move(status), report.iterations};
    mechanics::SolveReport second = iterate(q1, q0, r, lambda);
    second.iterations += report.iterations;
    return second;
  }
  stale_ = report.iterations > n_iterations_of_stale_factor;
  return report;
}

}  // namespace pseudorigid::continuum
