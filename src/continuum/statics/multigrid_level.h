#pragma once
/// One level of the multigrid preconditioner (multigrid.h): elements of a degree on a mesh of the octant, the stiffness
/// K of these elements, and a smoother. The smoother is Chebyshev's iteration for K u = f. With the diagonal
/// D of K and an estimate b of the largest eigenvalue of D⁻¹K, it damps the eigenvectors with eigenvalues from a = b/20
/// to b. With θ = (b + a)/2 and δ = (b − a)/2, its steps are
///
///   s₁ = D⁻¹(f − K u₀)/θ,   s_m = ρ_m ρ_{m−1} s_{m−1} + (2ρ_m/δ) D⁻¹(f − K u_{m−1}),   u_m = u_{m−1} + s_m,
///   ρ₁ = δ/θ,   ρ_m = 1/(2θ/δ − ρ_{m−1})                                                  (Saad 2003, section 12.3)

#include <memory>
#include <vector>

#include "continuum/body/ball_body.h"
#include "continuum/modes/cell_stiffness.h"
#include "continuum/modes/linear_problem.h"
#include "continuum/statics/multigrid_transfer.h"
#include "mechanics/core/status.h"

namespace pseudorigid::continuum {

/// The stiffness of the cells with the numbers c.
std::unique_ptr<StiffnessTangent> make_stiffness(const CellKernels& kernels, const StiffnessCoefficients& c);

class MultigridLevel {
 public:
  /// The finest level, with the elements of the body.
  explicit MultigridLevel(const BallBody& body);
  /// A coarser level: elements of `degree` on the sector with `n_refinements`. The ranks of the communicator share the
  /// cells. `smooths` is false for the coarsest level, which needs no kernels.
  MultigridLevel(const Sector& sector, const StoredEnergy& stored, int n_refinements, int degree, bool smooths,
                 MPI_Comm communicator);

  const BallSpace& space() const { return *space_; }
  const CellStiffness& cells() const { return cells_; }
  /// Sets K, the stiffness of the cells and of springs on the surface. Prepares the smoother if this level has one.
  /// Fails if the largest eigenvalue is not found. Collective, as are all functions below.
  mechanics::Status set(const StiffnessCoefficients& c, std::vector<FaceSprings> springs);
  const std::vector<FaceSprings>& springs() const { return springs_; }

  /// f = K u. Components that a plane of the octant fixes are 0.
  void product(const Vector& u, Vector& f) const;
  /// r = f − K u
  void residual(const Vector& f, const Vector& u, Vector& r) const;
  /// Applies the smoother to u. On entry, r must be f − K u. On return, r is not defined.
  void smooth(const Vector& f, Vector& r, Vector& u) const;
  Vector make_vector() const { return space_->make_vector(); }

 private:
  mechanics::Status find_largest_eigenvalue();

  std::unique_ptr<const BallSpace> own_space_;
  std::unique_ptr<const CellKernels> own_kernels_;
  const BallSpace* space_;
  const CellKernels* kernels_;
  CellStiffness cells_;
  std::unique_ptr<StiffnessTangent> stiffness_;
  std::vector<FaceSprings> springs_;  ///< of the faces of this rank
  bool has_springs_ = false;          ///< true if a rank has springs
  Vector inverse_diagonal_;           ///< D⁻¹; 0 for fixed components
  double largest_ = 0;                ///< b
};

}  // namespace pseudorigid::continuum
