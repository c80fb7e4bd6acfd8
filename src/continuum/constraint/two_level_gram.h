#pragma once
/// A preconditioner of the Gram operator S = G M⁻¹Gᵀ whose quality depends little on mesh size and degree, for meshes
/// of any size on any number of ranks:
///
///   B = Σ_cells R_cᵀ S_cc⁻¹ R_c + P K⁻¹ Pᵀ
///
/// S_cc: the block of S of one cell. P: the L²-projections onto the multipliers of the continuous functions N_i ∈ Q_m,
/// m = 1 for k ≤ 4 and 2 beyond, that vanish on the free surface; K_ij = ∫ρ⁻¹ F⁻ᵀ∇N_i · F⁻ᵀ∇N_j dX, since S is the weak
/// form of −div(ρ⁻¹ grad) in current coordinates, with λ = 0 on the free surface. The matrices of the cells are in
/// single precision. Iterations until the residual has fallen by 10⁻⁴ (octant, one to three refinements, at rest and
/// sheared): 7–10 for k = 2, 14–19 for k = 4, 16–21 for k = 6.
///
/// K⁻¹ is a KSP of PETSc with the options' prefix gram_coarse_: by default one V-cycle of its algebraic multigrid
/// (GAMG).

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/lac/petsc_sparse_matrix.h>
#include <petscksp.h>

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "continuum/constraint/gram_preconditioner.h"
#include "continuum/kernels/cell_kernels.h"
#include "continuum/mesh/ball_space.h"

namespace pseudorigid::continuum {

class TwoLevelGram final : public GramPreconditioner {
 public:
  TwoLevelGram(const BallSpace& space, const CellKernels& kernels);
  ~TwoLevelGram() override;
  TwoLevelGram(const TwoLevelGram&) = delete;
  TwoLevelGram& operator=(const TwoLevelGram&) = delete;

  mechanics::Status renew(const Vector& x) override;
  void apply(Vector& result, const Vector& r) const override;
  double renewal_cost() const override { return 30; }  // measured
  std::size_t memory() const override;

 private:
  void number_functions();
  void project_functions();
  void make_coarse_matrix();
  void assemble_coarse_matrix(const Vector& x);
  void make_coarse_solver();
  void solve_coarse() const;
  bool invert_blocks(const Vector& x);

  const BallSpace& space_;
  const CellKernels& kernels_;
  int coarse_degree_;
  dealii::FE_Q<3> element_;
  dealii::DoFHandler<3> dof_handler_;
  unsigned int n_functions_;                                                  ///< N_i of a cell
  std::vector<std::vector<dealii::types::global_dof_index>> cell_functions_;  ///< N_i of each cell, global numbers
  std::vector<unsigned int> local_functions_;                                 ///< likewise, local numbers, all cells
  std::vector<bool> on_surface_;                                              ///< of the local numbers
  std::vector<Eigen::MatrixXd> tables_;  ///< values of N_i and ∂N_i/∂ξ_d at the nodes of a cell, [node, i]
  std::size_t n_rows_;                   ///< rows of the matrices of the cells: the multipliers, padded by zeros
  std::vector<float> projections_;       ///< P, one matrix a cell: [function of ψ + n_rows · i]
  std::vector<float> inverse_blocks_;    ///< S_cc⁻¹, one matrix a cell: [i + n_rows · j]
  std::unique_ptr<dealii::PETScWrappers::MPI::SparseMatrix> K_;  ///< its constructor requires that PETSc has started
  KSP coarse_solver_ = nullptr;
  PetscBool applies_preconditioner_ = PETSC_FALSE;  ///< and nothing else
  Vec coarse_in_ = nullptr, coarse_out_ = nullptr;
  mutable Vector restricted_, correction_;
  mutable std::vector<float> multipliers_, of_functions_;  ///< of one cell
};

}  // namespace pseudorigid::continuum
