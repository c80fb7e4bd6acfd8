#pragma once
/// A solver for small displacements of the finite-element ball in one octant, without a factorisation of the whole
/// stiffness:
///
///   (K + E) u − Gᵀλ = f,   G u = h,
///
/// without λ and h for a compressible ball. K is the stiffness of the cells, and G is the derivative of the constraint.
/// E has the terms of gravity, of the drive and of a held direction (tangent_problem.h). The numbers of K and G have
/// single precision. GMRES solves the equations with the block-triangular preconditioner
///
///   u = V f,   λ = (2μ + κ)(h − G u).
///
/// Here μ is the shear modulus and κ the stiffness of the volumetric stabilisation. V is one V-cycle for K u = f. Its
/// levels are elements of the degrees k, ⌈k/2⌉, …, 1 on the cells of the body, and then elements of degree 1 on meshes
/// with one refinement less each (multigrid_level.h). The cycle ends at the first coarser level with at most 400
/// unknowns, or with the four cells of the octant. The stiffness of this level is factorised. Under self-gravity, the
/// levels have the stiffness of the cells and of the springs that tangent_problem.h describes. The functions ψ of the
/// multiplier are orthonormal, so their mass matrix is the identity. In an infinite body at rest, G K⁻¹Gᵀ is this
/// matrix over 2μ + κ.
///
/// The cells of the body may be distributed over ranks. The levels on the mesh of the body are then distributed in the
/// same way, except the last level. Each rank has all cells of the other levels.

#include <memory>
#include <vector>

#include "continuum/modes/parity_sector.h"
#include "continuum/statics/multigrid_level.h"
#include "continuum/statics/tangent_solver.h"

namespace pseudorigid::continuum {

class Multigrid final : public TangentSolver {
 public:
  /// The mesh of the octant has `n_refinements` refinements. `held` has the meaning of TangentProblem. The objects to
  /// which `state` refers, and `*held`, must outlive this object. Collective, as are all functions.
  Multigrid(const FigureState& state, const HeldDirection* held, int n_refinements);
  ~Multigrid() override;

  /// Computes K and G, prepares the smoothers, and factorises the stiffness of the coarsest level. Fails if this
  /// stiffness is not positive definite.
  mechanics::Status factorize() override;
  bool factors_are_cheap() const override { return true; }
  mechanics::SolveReport solve(const Vector& f, const Vector& h, double tolerance, Vector& u, Vector& lambda) override;
  /// u = V f
  void cycle(const Vector& f, Vector& u) const { cycle(0, f, u); }
  /// f = (K + E) u
  void product(const Vector& u, Vector& f) const;

 private:
  struct Coarsest;
  void cycle(std::size_t level, const Vector& f, Vector& u) const;

  FigureState state_;
  const HeldDirection* held_;
  double bulk_;  ///< 2μ + κ
  std::vector<std::unique_ptr<MultigridLevel>> levels_;
  std::vector<MultigridTransfer> transfers_;  ///< between a level and the next coarser one
  std::unique_ptr<Coarsest> coarsest_;
  std::unique_ptr<StiffnessTangent> whole_;        ///< K, if the levels have another stiffness; otherwise null
  std::unique_ptr<ConstraintTangent> constraint_;  ///< G; null for a compressible body
};

}  // namespace pseudorigid::continuum
