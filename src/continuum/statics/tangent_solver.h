#pragma once
/// Solvers for small displacements about a figure of equilibrium:
///
///   (K + E) u − Gᵀλ = f,   G u = h,
///
/// without λ and h for a compressible ball (tangent_problem.h).

#include <memory>

#include "continuum/statics/tangent_problem.h"

namespace pseudorigid::continuum {

class TangentSolver {
 public:
  virtual ~TangentSolver() = default;
  /// Prepares the solutions. Fails if the stiffness cannot be factorised.
  virtual mechanics::Status factorize() = 0;
  /// True if `factorize` takes less time than a few solutions.
  virtual bool factors_are_cheap() const = 0;
  /// Sets u and λ to the solution. The tolerance is relative. Components of f and u that a plane of the octant fixes
  /// are 0. Fails if GMRES does not converge.
  virtual mechanics::SolveReport solve(const Vector& f, const Vector& h, double tolerance, Vector& u,
                                       Vector& lambda) = 0;
};

/// The solver for a state of an octant whose mesh has `n_refinements` refinements. It uses V-cycles (multigrid.h) if
/// the Lamé modulus and ρgr are at most 100 times the shear modulus. It uses a factorisation (modes/parity_sector.h)
/// for other bodies, and if V-cycles fail for a body of at most 25,000 unknowns. `held` has the meaning of
/// TangentProblem. The objects to which `state` refers, and `*held`, must outlive the result.
std::unique_ptr<TangentSolver> make_tangent_solver(const FigureState& state, const HeldDirection* held,
                                                   int n_refinements);

}  // namespace pseudorigid::continuum
