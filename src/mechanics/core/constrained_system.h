#pragma once
/// The generalized Newton law in constrained form (Oliva, Geometric Mechanics, 5.3–5.4):
///
///   M q̈ = f(t, q, q̇) + G(q)ᵀ λ,   g(q) = 0,   G = Dg,                                            (5.24)–(5.29)
///
/// on a vector space with a constant mass operator M and perfect holonomic constraints g. The second derivative of
/// g(q(t)) = 0 gives the multiplier of the motion,
///
///   G M⁻¹ Gᵀ λ = −D²g(q̇, q̇) − G M⁻¹ f.
///
/// A system is an immutable object. Everything that changes is in the state and in the workspace.

#include <cmath>
#include <concepts>
#include <utility>

#include "mechanics/core/status.h"
#include "mechanics/core/vector_space.h"

namespace pseudorigid::mechanics {

/// Value of the member n_constraints of a system if the number of constraints is known only at run time.
inline constexpr int dynamic_constraints = -1;

/// A system in constrained form, with any number of constraints or none. q, v, f have the type S::Vector, and λ, g, r
/// the type S::Multiplier. Functions that can fail return a Status or a SolveReport. Examples of failures are a
/// deformation gradient F with det F ≤ 0, a number that is not finite, and a solve without convergence.
template <class S>
concept ConstrainedSystem = requires(const S s, double t, const typename S::Vector q, const typename S::Vector v,
                                     typename S::Vector f, const typename S::Multiplier lambda,
                                     typename S::Multiplier r, typename S::Workspace w) {
  { S::n_constraints } -> std::convertible_to<int>;    // 0, 1, 2, 6, … or dynamic_constraints
  { s.force(t, q, v, w, f) } -> std::same_as<Status>;  // f = −dV + loads, with the potential V
  s.apply_inverse_mass(f, f);                          // (f, a): a = M⁻¹ f; f and a may be the same vector
  { s.constraint(q, r) } -> std::same_as<Status>;      // r = g(q)
  s.constraint_rate(q, v, r);                          // r = G(q) v
  s.constraint_curvature(q, v, r);                     // r = D²g(q)(v, v)
  s.add_reaction(q, lambda, f);                        // f += G(q)ᵀ λ
  { s.solve_gram(q, q, lambda, w, r) } -> std::same_as<SolveReport>;  // (q₁, q₀, b, w, x): solves G(q₁)M⁻¹G(q₀)ᵀ x = b
  { s.constraint_tolerance() } -> std::convertible_to<double>;  // |g|_∞ and |G v|_∞ up to this bound count as zero
  { s.make_vector() } -> std::same_as<typename S::Vector>;      // zero vector of the right size
  { s.make_multiplier() } -> std::same_as<typename S::Multiplier>;
  { s.make_workspace() } -> std::same_as<typename S::Workspace>;
};

/// True if the system has no constraints; methods then omit all work on constraints.
template <class S>
inline constexpr bool unconstrained = S::n_constraints == 0;

/// A system whose constraint can be compliant. The condition g = 0 then gives way to an energy B(g):
///
///   M q̈ = f − G(q)ᵀ b(g(q)),   b = DB.
///
/// B is convex with the stiffness κ, so b ≈ κg for small g. The force of B is the reaction of the multiplier λ =
/// −b(g(q)). If κ is large, explicit methods would need small steps.
template <class S>
concept Compliant = requires(const S s, const typename S::Multiplier g, typename S::Multiplier b,
                             typename S::Workspace w) {
  { s.constraint_stiffness() } -> std::convertible_to<double>;  // κ; infinite if the constraint is g = 0
  s.constraint_force(g, b);                                     // b = DB(g)
  w.gram_shift;  // σ ≥ 0: solve_gram then solves (G(q₁)M⁻¹G(q₀)ᵀ + σ) x = b
};
/// True if an energy B(g) replaces the condition g = 0.
template <class S>
bool is_compliant([[maybe_unused]] const S& system) {
  if constexpr (Compliant<S>) return std::isfinite(system.constraint_stiffness());
  return false;
}
/// Sets lambda to −b(g(q)) for a compliant constraint. Fails if the constraint cannot be evaluated.
template <Compliant S>
Status multiplier_of_compliance(const S& system, const typename S::Vector& q, typename S::Multiplier& lambda) {
  auto g = system.make_multiplier();
  if (Status status = system.constraint(q, g); !status) return status;
  system.constraint_force(g, lambda);
  scale(-1.0, lambda);
  return {};
}
/// True if the system has constraints and must satisfy them exactly.
template <class S>
bool is_constrained(const S& system) {
  return !unconstrained<S> && !is_compliant(system);
}

/// True if the force evaluations of pilot runs and of frequency estimates take noticeable time. The search for the step
/// (step_search.h) then makes shorter pilot runs. By default, only systems with distributed vectors have a costly
/// force. A member `has_costly_force` of the system overrides this default.
template <class S>
inline constexpr bool has_costly_force = [] {
  if constexpr (requires { S::has_costly_force; }) return S::has_costly_force;
  return !VectorSpace<typename S::Vector>::dense;
}();

/// A system with `force_with_reaction(t, q, v, lambda, w, f)`, which sets f to the force plus G(q)ᵀλ. Such a system
/// computes this sum faster than the two terms separately.
template <class S>
concept FindsForceWithReaction = requires(const S s, const typename S::Vector q, typename S::Vector f,
                                          const typename S::Multiplier lambda, typename S::Workspace w) {
  { s.force_with_reaction(0.0, q, q, lambda, w, f) } -> std::same_as<Status>;
};

/// True if a system has `constraint(q, q_rounding, r)`, which sets r = g(q + q_rounding). Here q_rounding is the
/// remainder of the compensated sum of q (vector_space.h). The result is more accurate than the round-off of q permits.
/// Methods then satisfy the constraint at q + q_rounding.
template <class S>
inline constexpr bool resolves_rounding = VectorSpace<typename S::Vector>::compensated&& requires(
    const S s, const typename S::Vector q, const typename S::Vector q_rounding, typename S::Multiplier r) {
  { s.constraint(q, q_rounding, r) } -> std::same_as<Status>;
};

/// The state of a system: time t, position q and velocity v. Systems with the same type of vector have the same type of
/// state. An example is a constrained system and its field ExplicitMultiplier (explicit_multiplier.h).
template <class Vector>
struct VectorState {
  double t = 0;
  Vector q, v;
};
template <class S>
using State = VectorState<typename S::Vector>;

/// Sets lambda to the multiplier λ of the motion at a state: G M⁻¹Gᵀ λ = −D²g(v, v) − G M⁻¹ f(t, q, v). Iterative
/// refinement makes λ exact to round-off. Observables use this λ, because the multipliers of a step have the error of
/// the method. Fails if the force or a Gram solve fails. Without constraints, the function does nothing and succeeds.
/// If the constraint is compliant, this λ is that of the slow motion, without the fast oscillation of g about it.
template <ConstrainedSystem S>
Status multiplier_of_motion(const S& system, const State<S>& state, typename S::Workspace& workspace,
                            typename S::Multiplier& lambda) {
  if constexpr (!unconstrained<S>) {
    auto a = system.make_vector();
    if (Status status = system.force(state.t, state.q, state.v, workspace, a); !status) return status;
    system.apply_inverse_mass(a, a);
    auto rhs = system.make_multiplier(), residual = rhs, delta = rhs;
    system.constraint_rate(state.q, a, rhs);
    system.constraint_curvature(state.q, state.v, residual);
    axpy(1.0, residual, rhs);
    scale(-1.0, rhs);

    scale(0.0, lambda);
    residual = rhs;
    constexpr int max_refinements = 8;
    constexpr double round_off = 1e-14;
    const double enough = round_off * max_norm(rhs);
    double before = HUGE_VAL;
    for (int i = 0; i < max_refinements; ++i) {
      const double norm = max_norm(residual);
      // A residual that did not halve is round-off as well. One that is not finite fails in the Gram solve.
      if ((norm <= enough && std::isfinite(norm)) || norm > 0.5 * before) break;
      before = norm;
      if (SolveReport report = system.solve_gram(state.q, state.q, residual, workspace, delta); !report.status)
        return std::move(report.status);
      axpy(1.0, delta, lambda);
      scale(0.0, a);
      system.add_reaction(state.q, lambda, a);
      system.apply_inverse_mass(a, a);
      system.constraint_rate(state.q, a, residual);
      scale(-1.0, residual);
      axpy(1.0, rhs, residual);
    }
  }
  return {};
}

}  // namespace pseudorigid::mechanics
