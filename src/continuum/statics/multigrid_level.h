#pragma once
/// One level of the multigrid preconditioner (multigrid.h): elements of a degree on the cells of the octant, the
/// stiffness K of these elements, and a smoother. The smoother is Chebyshev's iteration for K u = f. With the diagonal
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
#include "mechanics/core/status.h"

namespace pseudorigid::continuum {

/// The numbers c of all cells.
using StiffnessCoefficients = std::vector<PointCoefficients>;

/// The stiffness of the cells with the numbers c.
std::unique_ptr<StiffnessTangent> make_stiffness(const CellKernels& kernels, const StiffnessCoefficients& c);

class MultigridLevel {
 public:
  /// The level of `degree` on the cells of the body. `smooths` is false for the coarsest level, which needs no kernels.
  MultigridLevel(const BallBody& body, const StoredEnergy& stored, int n_refinements, int degree, bool smooths);

  const BallSpace& space() const { return *space_; }
  const CellStiffness& cells() const { return cells_; }
  /// Sets K, the stiffness of the cells and of springs on the surface. Prepares the smoother if this level has one.
  /// Fails if the largest eigenvalue is not found.
  mechanics::Status set(const StiffnessCoefficients& c, std::vector<FaceSprings> springs);
  const std::vector<FaceSprings>& springs() const { return springs_; }
  /// The numbers c of this level from those of a level with more points. Each number per volume is interpolated.
  StiffnessCoefficients interpolate(const MultigridLevel& finer, const StiffnessCoefficients& c) const;
  /// The values of a nodal field of another level at the nodes of this level.
  Vector at_nodes(const MultigridLevel& other, const Vector& x) const;

  /// f = K u. Components that a plane of the octant fixes are 0.
  void product(const Vector& u, Vector& f) const;
  /// r = f − K u
  void residual(const Vector& f, const Vector& u, Vector& r) const;
  /// Applies the smoother to u. On entry, r must be f − K u. On return, r is not defined.
  void smooth(const Vector& f, Vector& r, Vector& u) const;
  /// `restrict_to` sets f to the transposed interpolation of r, a force on this level. `add_interpolated` adds the
  /// interpolation of u, a displacement on the coarser level.
  void restrict_to(const MultigridLevel& coarser, const Vector& r, Vector& f) const;
  void add_interpolated(const MultigridLevel& coarser, const Vector& u, Vector& result) const;
  /// Sets the components of f that a plane of the octant fixes to 0.
  void clear_fixed(Vector& f) const;
  Vector make_vector() const { return space_->make_vector(); }

 private:
  mechanics::Status find_largest_eigenvalue();
  /// The Lagrange polynomials of the nodes of another level at the nodes of this level, in one direction.
  Eigen::MatrixXd interpolation_from(const MultigridLevel& other) const;

  std::unique_ptr<const BallSpace> own_space_;
  std::unique_ptr<const CellKernels> own_kernels_;
  const BallSpace* space_;
  const CellKernels* kernels_;
  CellStiffness cells_;
  std::vector<double> share_;  ///< of each node, 1 over the number of its cells
  std::unique_ptr<StiffnessTangent> stiffness_;
  std::vector<FaceSprings> springs_;
  Vector inverse_diagonal_;  ///< D⁻¹; 0 for fixed components
  double largest_ = 0;       ///< b
};

}  // namespace pseudorigid::continuum
