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

/// True if the solver of a state uses V-cycles (multigrid.h): if the Lamé modulus and ρgr are at most 100 times the
/// shear modulus.
bool uses_cycles(const FigureState& state);
/// True if a body of this size is factorised after V-cycles have failed.
bool is_small(const BallSpace& space);

/// The solver for a state of an octant whose mesh has `n_refinements` refinements. It uses V-cycles if `uses_cycles`,
/// or if several ranks share the body, which must not be small. Otherwise, and if V-cycles fail for a small body, it
/// uses a factorisation (modes/parity_sector.h). `held` has the meaning of TangentProblem. The objects to which `state`
/// refers, and `*held`, must outlive the result. If several ranks share the body, all functions are collective.
std::unique_ptr<TangentSolver> make_tangent_solver(const FigureState& state, const HeldDirection* held,
                                                   int n_refinements);

}  // namespace pseudorigid::continuum
