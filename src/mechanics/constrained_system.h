#pragma once
/// The generalized Newton law in constrained form (Oliva, Geometric Mechanics, 5.3–5.4):
///
///   M q̈ = f(t, q, q̇) + G(q)ᵀ λ,   g(q) = 0,   G = Dg,                                            (5.24)–(5.29)
///
/// on a vector space with a constant mass operator M and perfect holonomic constraints g. Differentiating g twice gives
/// the multiplier of the motion,
///
///   G M⁻¹ Gᵀ λ = −D²g(q̇, q̇) − G M⁻¹ f.
///
/// A system is an immutable object; everything that changes lives in the state and in the workspace.

#include <concepts>

#include "mechanics/status.h"
#include "mechanics/vector_space.h"

namespace pseudorigid::mechanics {

/// n_constraints of a system whose number of constraints is known only at run time.
inline constexpr int dynamic_constraints = -1;

/// q, v, f are S::Vector; λ, g, r are S::Multiplier. Failures are values: J ≤ 0, a number that is not finite, a solve
/// that does not converge.
template <class S>
concept ConstrainedSystem = requires(const S s, double t, const typename S::Vector q, const typename S::Vector v,
                                     typename S::Vector f, const typename S::Multiplier lambda,
                                     typename S::Multiplier r, typename S::Workspace w) {
  { S::n_constraints } -> std::convertible_to<int>;                   // 0, 1, 2, 6, … or dynamic_constraints
  { s.force(t, q, v, w, f) } -> std::same_as<Status>;                 // f = −dV + loads
  s.apply_inverse_mass(f, f);                                         // a = M⁻¹ f, in place allowed
  { s.constraint(q, r) } -> std::same_as<Status>;                     // g(q)
  s.constraint_rate(q, v, r);                                         // G(q) v
  s.constraint_curvature(q, v, r);                                    // D²g(q)(v, v)
  s.add_reaction(q, lambda, f);                                       // f += G(q)ᵀ λ
  { s.solve_gram(q, q, lambda, w, r) } -> std::same_as<SolveReport>;  // G(q₁) M⁻¹ G(q₀)ᵀ λ = r
  { s.constraint_tolerance() } -> std::convertible_to<double>;        // |g|_∞, |G v|_∞ that count as zero
  { s.make_vector() } -> std::same_as<typename S::Vector>;            // zero, of the right size
  { s.make_multiplier() } -> std::same_as<typename S::Multiplier>;
  { s.make_workspace() } -> std::same_as<typename S::Workspace>;
};

/// True where the system has no constraint at all; methods then leave out everything that concerns constraints.
template <class S>
inline constexpr bool unconstrained = S::n_constraints == 0;

/// Position and velocity at a time: the whole state of a mechanical system.
template <class S>
struct State {
  double t = 0;
  typename S::Vector q, v;
};

/// Multiplier of the motion at a state: G M⁻¹Gᵀ λ = −D²g(v, v) − G M⁻¹ f(t, q, v). Observables use this one, never a
/// step's own multipliers, which belong to no instant. Failure: of the force or of the Gram solve.
template <ConstrainedSystem S>
Status multiplier_of_motion(const S& system, const State<S>& state, typename S::Workspace& workspace,
                            typename S::Multiplier& lambda) {
  if constexpr (!unconstrained<S>) {
    auto a = system.make_vector();
    if (Status status = system.force(state.t, state.q, state.v, workspace, a); !status) return status;
    system.apply_inverse_mass(a, a);
    auto r = system.make_multiplier(), curvature = system.make_multiplier();
    system.constraint_rate(state.q, a, r);
    system.constraint_curvature(state.q, state.v, curvature);
    axpy(1.0, curvature, r);
    scale(-1.0, r);
    return system.solve_gram(state.q, state.q, r, workspace, lambda).status;
  } else {
    return {};
  }
}

}  // namespace pseudorigid::mechanics
