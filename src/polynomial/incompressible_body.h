#pragma once
/// The incompressible polynomial body of degree N as a constrained system of the mechanics core. The coefficients q of
/// the position and the forces f without reactions satisfy
///
///   q̈ = f + Gᵀλ,   g_b(q) = ∫ψ_b ln J dX = 0,   ψ_b ∈ P_{N−1}               (generalized Newton law, Oliva 5.3–5.4)
///
/// with the L²-orthonormal basis ψ_b of the multipliers, J = det F and G = Dg. P_N is the space of polynomials of
/// degree at most N. The multiplier λ = Σλ_bψ_b is the Kirchhoff pressure Jp, with the pressure p of the body. The
/// constraint balances a uniform pressure on the surface. Therefore this load is not a force of the system. The
/// divergence maps (P_N)³ onto P_{N−1}. Therefore small motions have zero divergence at every point.
///
/// With a projected bulk term B (polynomial_body.h) the body is nearly incompressible. The energy ∫B(Σ g_b ψ_b) dX then
/// replaces the condition g = 0, and a pressure on the surface is a load (mechanics::Compliant).

#include <cmath>

#include "mechanics/core/constraint_newton.h"
#include "polynomial/constraint.h"
#include "polynomial/gram_solver.h"
#include "polynomial/polynomial_body.h"

namespace pseudorigid::polynomial {

class IncompressibleBody : public PolynomialBody {
 public:
  using Multiplier = Eigen::VectorXd;
  struct Workspace {
    GramSolver gram;
    /// Residual of solve_gram that is sufficient for the caller, in the Euclidean norm. A caller with a bound of the
    /// maximum norm can use this bound, because the maximum norm is at most the Euclidean norm. If 0, only the relative
    /// bound of GramSolver::solve applies.
    double residual_sought = 0;
    /// If null, the contact with the planes acts. Otherwise springs replace the contact
    /// (PolynomialBody::applied_force), and `held_at` has the coefficients of the position at which the springs have no
    /// force.
    const Vector* held_at = nullptr;
    double gram_shift = 0;  ///< σ of solve_gram (GramSolver::solve)

    template <class Visit>
    void visit_memory(Visit&& visit) {
      gram.visit_memory(visit);
    }
  };
  static constexpr int n_constraints = mechanics::dynamic_constraints;

  explicit IncompressibleBody(BodySetup setup) : PolynomialBody(without_pressure(setup)) {}

  /// Sets f to all forces without the reactions. Fails if q is not an admissible deformation.
  mechanics::Status force(double t, const Vector& q, const Vector& v, Workspace& workspace, Vector& f) const {
    return applied_force(t, q, v, workspace.held_at, f);
  }
  /// Sets g to the constraint at q. Fails if the least det F at the quadrature points is not positive and finite.
  mechanics::Status constraint(const Vector& q, Multiplier& g) const {
    const double least = polynomial::constraint(space(), q, g);
    return least > 0 && std::isfinite(least) ? mechanics::Status() : inadmissible(q);
  }
  void constraint_rate(const Vector& q, const Vector& v, Multiplier& r) const {
    polynomial::constraint_rate(space(), q, v, r);
  }
  void constraint_curvature(const Vector& q, const Vector& v, Multiplier& r) const {
    polynomial::constraint_curvature(space(), q, v, r);
  }
  void add_reaction(const Vector& q, const Multiplier& lambda, Vector& f) const {
    polynomial::add_reaction(space(), q, lambda, f);
  }
  void add_reaction_rate(const Vector& q, const Vector& v, const Multiplier& lambda, Vector& f) const {
    polynomial::add_reaction_rate(space(), q, v, lambda, f);
  }
  /// κ of the energy that replaces the constraint (mechanics::Compliant); infinite if the body is incompressible.
  double constraint_stiffness() const { return projected_bulk() > 0 ? projected_bulk() : HUGE_VAL; }
  void constraint_force(const Multiplier& g, Multiplier& b) const { bulk(space(), projected_bulk(), g, b); }
  /// Solves (G(q1) G(q0)ᵀ + σ) λ = r with σ = workspace.gram_shift, up to the residual of GramSolver::solve. Fails if
  /// GramSolver::solve fails.
  mechanics::SolveReport solve_gram(const Vector& q1, const Vector& q0, const Multiplier& r, Workspace& workspace,
                                    Multiplier& lambda) const {
    return workspace.gram.solve(q1, q0, r, workspace.residual_sought, workspace.gram_shift, lambda);
  }
  /// Largest |g|_∞ and |Gv|_∞ that count as zero, a few units of the round-off of the sums over the points.
  double constraint_tolerance() const { return 1e-15 * multiplier_scale(); }
  /// The square root of the volume. The absolute value of the mean of ln J is at most |g|_∞ / multiplier_scale().
  double multiplier_scale() const { return std::sqrt(space().volume()); }

  Multiplier make_multiplier() const { return Multiplier::Zero(space().n_pressures()); }
  Workspace make_workspace() const { return {GramSolver(space()), 0}; }

  /// (1/m̄) ∫Jp dX for the pressure p and the multiplier λ at q, with m̄ = tr E₀/3 and E₀ = ∫ρXXᵀ dX. With
  /// self-gravity, λ contains ρ(φ − φ̄) in addition to the Kirchhoff pressure Jp (fields.h). The integral Ê/3 of this
  /// term is subtracted from ∫λ dX, with the energy Ê of self-gravity. The finite-element model has the same
  /// definition.
  double mean_multiplier(const Vector& q, const Multiplier& lambda) const {
    const double of_gravity = gravity() ? gravity()->energy(q) / 3 : 0;
    const int constant = space().pressure_place(0);
    return (lambda[constant] * std::sqrt(space().volume()) - of_gravity) / (space().inertia().sum() / 3);
  }

 private:
  static BodySetup without_pressure(BodySetup setup) {
    if (setup.projected_bulk == 0) setup.loads = loads::at_constant_volume(setup.loads);
    return setup;
  }
};

}  // namespace pseudorigid::polynomial
