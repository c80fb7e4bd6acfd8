#include "continuum/dense_gram.h"

#include <deal.II/lac/lapack_full_matrix.h>

#include <Eigen/SparseCore>
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
  Eigen::SparseMatrix<double, Eigen::RowMajor> G(n_rows, 3 * static_cast<Eigen::Index>(space.n_nodes()));
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

mechanics::Status DenseGram::renew(const Vector& x) {
  const Eigen::SparseMatrix<double, Eigen::RowMajor> G = scaled_constraint_matrix(*space_, *kernels_, x);
  const Eigen::SparseMatrix<double> S = G * G.transpose();
  const auto n = static_cast<std::size_t>(S.rows());
  dealii::LAPACKFullMatrix<double> inverse(n, n);
  for (Eigen::Index column = 0; column < S.outerSize(); ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(S, column); entry; ++entry)
      inverse(entry.row(), entry.col()) = entry.value();
  inverse.set_property(dealii::LAPACKSupport::symmetric);
  try {
    inverse.compute_cholesky_factorization();
  } catch (const dealii::LACExceptions::ExcSingular&) {
    return mechanics::Status::failure("the Gram operator of the incompressibility constraint is singular");
  }
  inverse.invert();
  inverse_ = PackedSymmetric(&inverse(0, 0), n);
  n_iterations_fresh_ = -1;
  n_iterations_lost_ = 0;
  return {};
}

bool DenseGram::stale_after(int n_iterations) {
  if (n_iterations_fresh_ < 0) n_iterations_fresh_ = n_iterations;
  n_iterations_lost_ += std::max(0, n_iterations - n_iterations_fresh_);
  // What making it anew costs, n³ operations and the rows of G, in iterations (measured for 80 … 1800 multipliers).
  const double n = space_->n_cells() * space_->n_pressure();
  return n_iterations_lost_ > 20 + 3e-4 * n * n;
}

}  // namespace pseudorigid::continuum
