#include "continuum/constraint/two_level_gram.h"

#include <deal.II/base/index_set.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_tools.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>

#include "continuum/kernels/cell_products.h"
#include "continuum/kernels/kernel_table.h"
#include "continuum/kernels/node_gradients.h"
#include "continuum/parallel/ghost_values.h"
#include "continuum/parallel/petsc_session.h"
#include "continuum/parallel/ranks.h"

namespace pseudorigid::continuum {
namespace {

using Eigen::MatrixXd;

/// Degree m of the coarse functions for elements of degree k = `degree`. A higher m needs fewer iterations, but each
/// iteration takes longer. In measurements with k = 6, a step took the time of 44 force evaluations with m = 2, and of
/// 71 with m = 3.
int coarse_degree(int degree) { return degree <= 4 ? 1 : 2; }

/// The quadrature weights of the nodes of one cell. A weight is the Gauss–Lobatto weight of the node times det ∂X/∂ξ.
Eigen::VectorXd node_weights(const BallSpace& space, unsigned int cell) {
  const ReferenceCell& ref = space.reference_cell();
  const Eigen::Matrix3Xd X = nodal_values(space, space.reference_positions(), cell);
  const int n = ref.n;
  Eigen::VectorXd weights(X.cols());
  for (int i = 0; i < X.cols(); ++i)
    weights[i] = ref.node_weights[i % n] * ref.node_weights[i / n % n] * ref.node_weights[i / n / n] *
                 reference_gradient(ref, X, i).determinant();
  return weights;
}

/// Four tables at the nodes of a cell, with entry (node, i): N_i, ∂N_i/∂ξ_1, ∂N_i/∂ξ_2 and ∂N_i/∂ξ_3. The N_i are the
/// Lagrange polynomials on the tensor grid whose one-dimensional nodes are `functions`.
std::vector<MatrixXd> tables_at_nodes(const ReferenceCell& ref, const std::vector<double>& functions) {
  const auto n = static_cast<std::size_t>(ref.n), m = functions.size();
  std::vector<MatrixXd> tables(4, MatrixXd(n * n * n, m * m * m));
  for (std::size_t q = 0; q < n * n * n; ++q)
    for (std::size_t i = 0; i < m * m * m; ++i) {
      const double xi[] = {ref.nodes[q % n], ref.nodes[q / n % n], ref.nodes[q / n / n]};
      const std::size_t a[] = {i % m, i / m % m, i / m / m};
      for (int t = 0; t < 4; ++t) {
        double product = 1;
        for (int d = 0; d < 3; ++d)
          product *= d == t - 1 ? lagrange_derivative(functions, a[d], xi[d]) : lagrange(functions, a[d], xi[d]);
        tables[t](q, i) = product;
      }
    }
  return tables;
}

/// The matrix of one cell in `matrices`, which contains the matrices of all cells one after the other.
Eigen::Map<Eigen::MatrixXf> cell_matrix(std::vector<float>& matrices, unsigned int cell, std::size_t n_rows,
                                        Eigen::Index n_columns) {
  return {&matrices[cell * n_rows * static_cast<std::size_t>(n_columns)], static_cast<Eigen::Index>(n_rows), n_columns};
}

/// Sets an option of PETSc unless the user has set it.
void set_default_option(const char* name, const char* value) {
  PetscBool is_set = PETSC_FALSE;
  PetscOptionsHasName(nullptr, nullptr, name, &is_set);
  if (!is_set) PetscOptionsSetValue(nullptr, name, value);
}

}  // namespace

TwoLevelGram::TwoLevelGram(const BallSpace& space, const CellKernels& kernels)
    : space_(space),
      kernels_(kernels),
      coarse_degree_(coarse_degree(space.degree())),
      element_(coarse_degree_),
      dof_handler_(space.mesh().triangulation()),
      n_functions_(element_.dofs_per_cell),
      n_rows_((space.n_pressure() + rows_together - 1) / rows_together * rows_together),
      multipliers_(2 * n_rows_),
      of_functions_(n_functions_) {
  start_petsc();
  dof_handler_.distribute_dofs(element_);
  number_functions();
  project_functions();
  make_coarse_matrix();
  make_coarse_solver();
}

TwoLevelGram::~TwoLevelGram() {
  VecDestroy(&coarse_in_);
  VecDestroy(&coarse_out_);
  KSPDestroy(&coarse_solver_);
}

void TwoLevelGram::number_functions() {
  const dealii::IndexSet on_own_cells = dealii::DoFTools::extract_locally_active_dofs(dof_handler_);
  const auto partitioner = std::make_shared<dealii::Utilities::MPI::Partitioner>(dof_handler_.locally_owned_dofs(),
                                                                                 on_own_cells, space_.communicator());
  restricted_.reinit(partitioner);
  correction_.reinit(partitioner);

  const dealii::IndexSet surface =
      dealii::DoFTools::extract_boundary_dofs(dof_handler_, dealii::ComponentMask(), {BallMesh::surface_id});
  on_surface_.assign(partitioner->locally_owned_size() + partitioner->n_ghost_indices(), false);
  for (const auto function : surface)
    if (partitioner->in_local_range(function) || partitioner->is_ghost_entry(function))
      on_surface_[partitioner->global_to_local(function)] = true;

  const auto hierarchic = dealii::FETools::lexicographic_to_hierarchic_numbering<3>(coarse_degree_);
  std::vector<dealii::types::global_dof_index> indices(n_functions_);
  for (const auto& cell : dof_handler_.active_cell_iterators()) {
    if (!cell->is_locally_owned()) continue;
    cell->get_dof_indices(indices);
    auto& functions = cell_functions_.emplace_back(n_functions_);
    for (unsigned int i = 0; i < n_functions_; ++i) {
      functions[i] = indices[hierarchic[i]];
      local_functions_.push_back(partitioner->global_to_local(functions[i]));
    }
  }
}

/// Computes P_ji = ∫ψ_j N_i dX by Gauss–Lobatto quadrature at the nodes, with the orthonormal basis ψ_j of the
/// multipliers. Sets P_ji to 0 for the Lagrange functions of nodes on the free surface, because they are not coarse
/// functions.
void TwoLevelGram::project_functions() {
  tables_ = tables_at_nodes(space_.reference_cell(), ReferenceCell(coarse_degree_).nodes);
  const unsigned int n_pressure = space_.n_pressure(), n_nodes = space_.nodes_per_cell();
  projections_.assign(space_.n_cells() * n_rows_ * n_functions_, 0);
  MatrixXd P(n_pressure, n_functions_);
  kernels_.pressure_basis_at_nodes([&](unsigned int cell, std::span<const double> values) {
    const Eigen::Map<const MatrixXd> psi(values.data(), n_nodes, n_pressure);
    P.noalias() = psi.transpose() * node_weights(space_, cell).asDiagonal() * tables_[0];
    for (unsigned int i = 0; i < n_functions_; ++i)
      if (on_surface_[local_functions_[cell * n_functions_ + i]]) P.col(i).setZero();
    cell_matrix(projections_, cell, n_rows_, n_functions_).topRows(n_pressure) = P.cast<float>();
  });
}

void TwoLevelGram::make_coarse_matrix() {
  const dealii::IndexSet relevant = dealii::DoFTools::extract_locally_relevant_dofs(dof_handler_);
  dealii::DynamicSparsityPattern pattern(relevant);
  for (const auto& functions : cell_functions_)
    for (const auto i : functions) pattern.add_entries(i, functions.begin(), functions.end());
  const dealii::IndexSet& own = dof_handler_.locally_owned_dofs();
  dealii::SparsityTools::distribute_sparsity_pattern(pattern, own, space_.communicator(), relevant);
  K_ = std::make_unique<dealii::PETScWrappers::MPI::SparseMatrix>();
  K_->reinit(own, own, pattern, space_.communicator());
}

void TwoLevelGram::make_coarse_solver() {
  const MPI_Comm communicator = space_.communicator();
  const auto n_own = static_cast<PetscInt>(restricted_.locally_owned_size());
  VecCreateMPIWithArray(communicator, 1, n_own, PETSC_DECIDE, nullptr, &coarse_in_);
  VecCreateMPIWithArray(communicator, 1, n_own, PETSC_DECIDE, nullptr, &coarse_out_);
  KSPCreate(communicator, &coarse_solver_);
  KSPSetOptionsPrefix(coarse_solver_, "gram_coarse_");
  KSPSetType(coarse_solver_, KSPPREONLY);
  PC preconditioner;
  KSPGetPC(coarse_solver_, &preconditioner);
  PCSetType(preconditioner, PCGAMG);
  set_default_option("-gram_coarse_pc_gamg_aggressive_coarsening",
                     "0");  // aggressive coarsening needs 1.5 times the iterations
  // One sweep of the smoother is faster than two. For k = 4 a second sweep reduces the number of iterations by a tenth,
  // but each iteration takes a fifth more time.
  set_default_option("-gram_coarse_mg_levels_ksp_max_it", "1");
  KSPSetFromOptions(coarse_solver_);
  PetscObjectTypeCompare(reinterpret_cast<PetscObject>(coarse_solver_), KSPPREONLY, &applies_preconditioner_);
}

/// Computes the coarse matrix K at the positions x. For Lagrange functions of nodes on the free surface, the rows and
/// columns of K are 0 except for a positive diagonal. K is therefore regular.
void TwoLevelGram::assemble_coarse_matrix(const Vector& x, double shift) {
  const unsigned int n_nodes = space_.nodes_per_cell();
  MatrixXd gradients(3 * n_nodes, n_functions_), values(n_nodes, n_functions_), K_cell(n_functions_, n_functions_);
  *K_ = 0;
  for (unsigned int cell = 0; cell < space_.n_cells(); ++cell) {
    const Eigen::Matrix3Xd x_cell = nodal_values(space_, x, cell);
    const Eigen::VectorXd weights = node_weights(space_, cell);
    for (unsigned int q = 0; q < n_nodes; ++q) {
      const Eigen::Matrix3d to_current =
          reference_gradient(space_.reference_cell(), x_cell, static_cast<int>(q)).inverse();
      for (int c = 0; c < 3; ++c)
        gradients.row(3 * q + c) =
            std::sqrt(weights[q]) * (to_current(0, c) * tables_[1].row(q) + to_current(1, c) * tables_[2].row(q) +
                                     to_current(2, c) * tables_[3].row(q));
      values.row(q) = std::sqrt(weights[q]) * tables_[0].row(q);
    }
    K_cell.noalias() = gradients.transpose() * gradients;
    if (shift > 0) K_cell.noalias() += shift * (values.transpose() * values);
    for (unsigned int i = 0; i < n_functions_; ++i)
      if (on_surface_[local_functions_[cell * n_functions_ + i]]) {
        K_cell.row(i).setZero();
        K_cell.col(i).setZero();
        K_cell(i, i) = 1;
      }
    const auto& functions = cell_functions_[cell];
    for (unsigned int i = 0; i < n_functions_; ++i) {
      const Eigen::VectorXd row = K_cell.row(i);
      K_->add(functions[i], n_functions_, functions.data(), row.data(), false);
    }
  }
  K_->compress(dealii::VectorOperation::add);
}

/// Computes the inverses (S_cc + σ)⁻¹ of the blocks of all cells at the positions x. Returns false if a block of this
/// rank is not positive definite.
bool TwoLevelGram::invert_blocks(const Vector& x, double shift) {
  const Eigen::Index n = space_.n_pressure(), n_columns = 3 * space_.nodes_per_cell();
  inverse_blocks_.assign(space_.n_cells() * n_rows_ * space_.n_pressure(), 0);
  bool regular = true;
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  kernels_.constraint_rows(x, [&](unsigned int cell, std::span<const double> rows) {
    Eigen::VectorXd inverse_mass(n_columns);
    for (Eigen::Index k = 0; k < n_columns; ++k)
      inverse_mass[k] = space_.inverse_mass().local_element(3 * space_.cell_nodes(cell)[k / 3] + k % 3);
    const RowMajor scaled =
        Eigen::Map<const RowMajor>(rows.data(), n, n_columns) * inverse_mass.cwiseSqrt().asDiagonal();
    MatrixXd block = shift * MatrixXd::Identity(n, n);
    block.selfadjointView<Eigen::Lower>().rankUpdate(scaled);
    const Eigen::LLT<MatrixXd> cholesky(block);
    regular = regular && cholesky.info() == Eigen::Success;
    cell_matrix(inverse_blocks_, cell, n_rows_, n).topRows(n) = cholesky.solve(MatrixXd::Identity(n, n)).cast<float>();
  });
  return regular;
}

mechanics::Status TwoLevelGram::renew(const Vector& x, double shift) {
  const GhostValues ghosts(x);
  const bool regular = invert_blocks(x, shift);
  assemble_coarse_matrix(x, shift);
  const Mat matrix = *K_;
  // Without this reset, the smoothers use bounds of the spectrum of an earlier matrix. If these bounds are too small,
  // the V-cycle can be indefinite.
  KSPReset(coarse_solver_);
  const bool set_up = KSPSetOperators(coarse_solver_, matrix, matrix) == 0 && KSPSetUp(coarse_solver_) == 0 &&
                      KSPSetUpOnBlocks(coarse_solver_) == 0;
  if (dealii::Utilities::MPI::min(static_cast<int>(regular && set_up), space_.communicator())) return {};
  return mechanics::Status::failure("the Gram operator of the incompressibility constraint is singular");
}

/// Applies the inverse of the coarse matrix K. If the solver only applies its preconditioner, this function calls the
/// preconditioner directly, because KSPSolve would communicate with all ranks after each call.
void TwoLevelGram::solve_coarse() const {
  if (!applies_preconditioner_) {
    KSPSolve(coarse_solver_, coarse_in_, coarse_out_);
    return;
  }
  PC preconditioner;
  KSPGetPC(coarse_solver_, &preconditioner);
  PCApply(preconditioner, coarse_in_, coarse_out_);
}

void TwoLevelGram::apply(Vector& result, const Vector& r) const {
  const KernelTable& products = *chosen_kernels().table;
  const unsigned int n = space_.n_pressure();
  float *in = multipliers_.data(), *out = in + n_rows_, *of_cell = of_functions_.data();
  restricted_ = 0.0;
  for (unsigned int cell = 0; cell < space_.n_cells(); ++cell) {
    std::copy_n(r.begin() + cell * n, n, in);
    products.multiply_transposed(&projections_[cell * n_rows_ * n_functions_], n_rows_, n_functions_, in, of_cell);
    for (unsigned int i = 0; i < n_functions_; ++i)
      restricted_.local_element(local_functions_[cell * n_functions_ + i]) += of_cell[i];
  }
  restricted_.compress(dealii::VectorOperation::add);
  correction_.zero_out_ghost_values();
  VecPlaceArray(coarse_in_, restricted_.begin());
  VecPlaceArray(coarse_out_, correction_.begin());
  solve_coarse();
  VecResetArray(coarse_in_);
  VecResetArray(coarse_out_);
  correction_.update_ghost_values();
  for (unsigned int cell = 0; cell < space_.n_cells(); ++cell) {
    for (unsigned int i = 0; i < n_functions_; ++i)
      of_cell[i] = static_cast<float>(correction_.local_element(local_functions_[cell * n_functions_ + i]));
    std::copy_n(r.begin() + cell * n, n, in);
    std::fill_n(out, n_rows_, 0.0f);
    products.add_product(&projections_[cell * n_rows_ * n_functions_], n_rows_, n_functions_, of_cell, out);
    products.add_product(&inverse_blocks_[cell * n_rows_ * n], n_rows_, n, in, out);
    std::copy_n(out, n, result.begin() + cell * n);
  }
}

std::size_t TwoLevelGram::memory() const {
  return (projections_.size() + inverse_blocks_.size()) * sizeof(float) +
         local_functions_.size() * (sizeof(unsigned int) + sizeof(dealii::types::global_dof_index)) +
         K_->n_nonzero_elements() / n_ranks(space_.communicator()) * (sizeof(double) + sizeof(PetscInt));
}

}  // namespace pseudorigid::continuum
