#pragma once
/// The problem of small motions of the ball about rest (parity_sector.h). Self-gravity adds its second variation K_g,
/// which couples all nodes of the surface. On the sphere, K_g is
///
///   uᵀK_g u = ρg [∮(u·e)² dS − Σ_nm c_n (∮(u·e) Y_nm dS)²],   g = (4/3)πGρr,   c_0 = 1, c_n = 3/(2n + 1) for n > 0.
///
/// e is the outward normal, the Y_nm are the orthonormal spherical harmonics, and G in the formula for g is Newton's
/// constant. The first term is a spring at each point of the surface, and the stiffness of the cells contains these
/// springs. The second term, for the harmonics that the mesh resolves, is the operator E. The omitted harmonics of
/// higher degree n would reduce the stiffness of the springs by a fraction of at most 3/(2n + 1). E is a matrix if the
/// surface has few unknowns. On finer meshes, about ten iterations of the conjugate gradients
/// (parity_sector.h) are sufficient for every strength of gravity. Compared with K_g, the surface integrals of
/// gravity/surface_gravity.h, which motions use, have larger errors: 1e-6 to 1e-5 in the Love number l of a tide.

#include "continuum/modes/cell_stiffness.h"
#include "continuum/modes/parity_sector.h"

namespace pseudorigid::continuum {

struct RestProblem final : LinearProblem {
  /// `space` must be that of an octant in one process. The self-gravity K_g is that of an incompressible body.
  /// `gravity_constant` is Newton's constant in internal units, in which ρ = r = 1. The shift s is the shear modulus. E
  /// is a matrix if the surface has at most `most_coupled` unknowns.
  RestProblem(const BallSpace& space, const CellKernels& kernels, const StoredEnergy& stored, bool incompressible,
              double gravity_constant = 0, std::size_t most_coupled = 3000);
  BeyondCells beyond_cells(const ParitySector& sector) const override;

  RestElasticity elasticity;
  double weight_of_density;  ///< product ρg of density and gravity at the surface

 private:
  bool factorises_gravity_ = false;  ///< true if E is a matrix
};

}  // namespace pseudorigid::continuum
