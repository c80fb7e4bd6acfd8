#include "continuum/constraint/dense_gram.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pseudorigid::continuum {
namespace {

/// Returns the columns of `rows` for the given nodes. `nodes` contains their numbers in the cell. Each node has three
/// columns.
dealii::LAPACKFullMatrix<double> columns_of(const dealii::LAPACKFullMatrix<double>& rows,
                                            const std::vector<unsigned int>& nodes) {
  dealii::LAPACKFullMatrix<double> columns(rows.m(), 3 * nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) std::copy_n(&rows(0, 3 * nodes[i]), 3 * rows.m(), &columns(0, 3 * i));
  return columns;
}

}  // namespace

DenseGram::DenseGram(const BallSpace& space, const CellKernels& kernels) : space_(&space), kernels_(&kernels) {
  struct Place {
    unsigned int cell, node;
  };
  std::vector<std::vector<Place>> places(space.n_nodes());
  for (unsigned int cell = 0; cell < space.n_cells(); ++cell)
    for (unsigned int i = 0; i < space.nodes_per_cell(); ++i) places[space.cell_nodes(cell)[i]].push_back({cell, i});
  for (const auto& of_node : places)
    for (std::size_t b = 1; b < of_node.size(); ++b)
      for (std::size_t a = 0; a < b; ++a) {
        SharedNodes& shared = shared_nodes_[{of_node[a].cell, of_node[b].cell}];
        shared.in_a.push_back(of_node[a].node);
        shared.in_b.push_back(of_node[b].node);
      }
}

std::vector<DenseGram::Block> DenseGram::scaled_constraint_rows(const Vector& x) const {
  const unsigned int n_p = space_->n_pressure(), n_columns = 3 * space_->nodes_per_cell();
  std::vector<Block> G(space_->n_cells());
  kernels_->constraint_rows(x, [&](unsigned int cell, std::span<const double> rows) {
    G[cell].reinit(n_p, n_columns);
    const auto& nodes = space_->cell_nodes(cell);
    for (unsigned int k = 0; k < n_columns; ++k) {
      const double scale = std::sqrt(space_->inverse_mass().local_element(3 * nodes[k / 3] + k % 3));
      for (unsigned int j = 0; j < n_p; ++j) G[cell](j, k) = scale * rows[j * n_columns + k];
    }
  });
  return G;
}

mechanics::Status DenseGram::renew(const Vector& x, double shift) {
  const std::vector<Block> G = scaled_constraint_rows(x);
  const unsigned int n_p = space_->n_pressure(), n = space_->n_cells() * n_p;
  Block S(n, n), product(n_p, n_p);
  // Only blocks on and below the diagonal are set, because LAPACK reads only the lower triangle.
  const auto set_block = [&](unsigned int row, unsigned int column) {
    for (unsigned int j = 0; j < n_p; ++j) std::copy_n(&product(0, j), n_p, &S(row * n_p, column * n_p + j));
  };
  for (unsigned int a = 0; a < G.size(); ++a) {
    G[a].mTmult(product, G[a]);
    set_block(a, a);
  }
  for (const auto& [cells, shared] : shared_nodes_) {
    const auto& [a, b] = cells;
    columns_of(G[b], shared.in_b).mTmult(product, columns_of(G[a], shared.in_a));
    set_block(b, a);
  }
  for (unsigned int i = 0; i < n; ++i) S(i, i) += shift;
  S.set_property(dealii::LAPACKSupport::symmetric);
  try {
    S.compute_cholesky_factorization();
  } catch (const dealii::LACExceptions::ExcSingular&) {
    return mechanics::Status::failure("the Gram operator of the incompressibility constraint is singular");
  }
  S.invert();
  inverse_ = SymmetricMatrix(&S(0, 0), n);
  return {};
}

double DenseGram::renewal_cost() const {
  // For n multipliers, a renewal computes the rows of G and makes about n³ operations. The unit of cost is the time of
  // one iteration, which is about proportional to n. With these constants, run times were shortest for n = 80 … 640.
  // Larger problems were not measured.
  const double n = space_->n_cells() * space_->n_pressure();
  return 40 + 6e-4 * n * n;
}

std::size_t DenseGram::memory() const {
  std::size_t n_shared = 0;
  for (const auto& [cells, shared] : shared_nodes_) n_shared += shared.in_a.size() + shared.in_b.size();
  return inverse_.memory() + n_shared * sizeof(unsigned int);
}

}  // namespace pseudorigid::continuum
