#pragma once
/// A preconditioner B ≈ S⁻¹ of the Gram operator S = G M⁻¹Gᵀ for meshes of any size on any number of ranks. G is the
/// derivative of the constraint, and M is the mass. The number of iterations depends little on the size of the mesh,
/// and grows slowly with the degree. The preconditioner is
///
///   B = Σ_cells R_cᵀ S_cc⁻¹ R_c + P K⁻¹ Pᵀ.
///
/// R_c restricts the multipliers to one cell c, and S_cc is the block of S of this cell. The coarse functions N_i ∈ Q_m
/// are continuous and vanish on the free surface. For elements of degree k, m = 1 if k ≤ 4, and otherwise m = 2. P is
/// the L²-projection of the N_i onto the multipliers, which have the orthonormal basis ψ_j in each cell. S is a
/// discrete form of −div(ρ⁻¹ grad) in the current coordinates x, with the density ρ and λ = 0 on the free surface.
/// Therefore K_ij = ∫ρ⁻¹ F⁻ᵀ∇N_i · F⁻ᵀ∇N_j dX with F = ∂x/∂X. A shift σ adds σ to S_cc, and σ∫N_i N_j dX to K_ij. The
/// matrices S_cc⁻¹ and P of the cells have single precision. With B, a decrease of the residual by a factor of 10⁴
/// takes 7–10 iterations for k = 2. It takes 14–19 iterations for k = 4, and 16–21 for k = 6. These numbers are for an
/// octant with one to three refinements, at rest and sheared.
///
/// A KSP solver of PETSc with the options' prefix gram_coarse_ applies K⁻¹. By default the solver is one V-cycle of the
/// algebraic multigrid of PETSc (GAMG).

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

  mechanics::Status renew(const Vector& x, double shift) override;
  void apply(Vector& result, const Vector& r) const override;
  double renewal_cost() const override { return 30; }  // measured; the unit is the time of one iteration
  std::size_t memory() const override;

 private:
  void number_functions();
  void project_functions();
  void make_coarse_matrix();
  void assemble_coarse_matrix(const Vector& x, double shift);
  void make_coarse_solver();
  void solve_coarse() const;
  bool invert_blocks(const Vector& x, double shift);

  const BallSpace& space_;
  const CellKernels& kernels_;
  int coarse_degree_;
  dealii::FE_Q<3> element_;
  dealii::DoFHandler<3> dof_handler_;
  unsigned int n_functions_;  ///< number of the N_i of a cell, including those of nodes on the free surface
  std::vector<std::vector<dealii::types::global_dof_index>>
      cell_functions_;                         ///< global numbers of the N_i of each cell
  std::vector<unsigned int> local_functions_;  ///< local numbers of the N_i, cell by cell
  std::vector<bool> on_surface_;               ///< [local number]: true if the node is on the surface
  std::vector<Eigen::MatrixXd> tables_;        ///< N_i and the three ∂N_i/∂ξ_d at the nodes of a cell: (node, i)
  std::size_t n_rows_;                         ///< number of rows of the matrices of a cell: multipliers and padding
  std::vector<float> projections_;             ///< P, one matrix per cell: [j + n_rows · i] for ψ_j and N_i
  std::vector<float> inverse_blocks_;          ///< S_cc⁻¹, one matrix per cell: [i + n_rows · j]
  std::unique_ptr<dealii::PETScWrappers::MPI::SparseMatrix> K_;  ///< matrix K; constructed after the start of PETSc
  KSP coarse_solver_ = nullptr;
  PetscBool applies_preconditioner_ = PETSC_FALSE;  ///< true if the solver only applies its preconditioner
  Vec coarse_in_ = nullptr, coarse_out_ = nullptr;
  mutable Vector restricted_, correction_;
  mutable std::vector<float> multipliers_, of_functions_;  ///< work vectors of one cell
};

}  // namespace pseudorigid::continuum
