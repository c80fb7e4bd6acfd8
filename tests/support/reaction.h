#pragma once
/// The reactive force of perfect constraints as an observable (Oliva, Geometric Mechanics, 5.4), in two ways:
///
///   R = Gᵀλ,   λ the multiplier of the motion                                                     (5.24)–(5.25)
///   R(v) = μ[B(v, v) − (μ⁻¹F)^⊥]                                                                  (5.29)
///
/// with the orthogonal projection and the second fundamental form of N = {g = 0} in the metric μ = M,
///
///   x^⊥ = M⁻¹Gᵀ(G M⁻¹Gᵀ)⁻¹ G x,   B(v, v) = −M⁻¹Gᵀ(G M⁻¹Gᵀ)⁻¹ D²g(v, v).

#include <utility>

#include "mechanics/core/conservative_system.h"

namespace pseudorigid::mechanics {

/// R = Gᵀλ at a state.
template <ConstrainedSystem S>
Status reaction_from_multiplier(const S& system, const State<S>& state, typename S::Workspace& workspace,
                                typename S::Vector& R) {
  auto lambda = system.make_multiplier();
  if (Status status = multiplier_of_motion(system, state, workspace, lambda); !status) return status;
  R = system.make_vector();
  system.add_reaction(state.q, lambda, R);
  return {};
}

// Below, Gram solves must be direct: the number of constraints is known at compile time.
template <class S>
concept DirectlyConstrained = ConstrainedSystem<S> && S::n_constraints >
0;

/// x = M⁻¹Gᵀν with G M⁻¹Gᵀν = r: the normal vector with G x = r.
template <DirectlyConstrained S>
Status normal_vector(const S& system, const typename S::Vector& q, const typename S::Multiplier& r,
                     typename S::Workspace& workspace, typename S::Vector& x) {
  auto nu = system.make_multiplier();
  if (SolveReport report = system.solve_gram(q, q, r, workspace, nu); !report.status) return std::move(report.status);
  x = system.make_vector();
  system.add_reaction(q, nu, x);
  system.apply_inverse_mass(x, x);
  return {};
}

/// x^⊥
template <DirectlyConstrained S>
Status normal_part(const S& system, const typename S::Vector& q, const typename S::Vector& x,
                   typename S::Workspace& workspace, typename S::Vector& normal) {
  auto r = system.make_multiplier();
  system.constraint_rate(q, x, r);
  return normal_vector(system, q, r, workspace, normal);
}

/// B(v, v) for a tangent vector v.
template <DirectlyConstrained S>
Status second_fundamental_form(const S& system, const typename S::Vector& q, const typename S::Vector& v,
                               typename S::Workspace& workspace, typename S::Vector& B) {
  auto r = system.make_multiplier();
  system.constraint_curvature(q, v, r);
  scale(-1.0, r);
  return normal_vector(system, q, r, workspace, B);
}

/// R = μ[B(v, v) − (μ⁻¹F)^⊥] at a state.
template <DirectlyConstrained S>
requires ConservativeSystem<S> Status reaction_from_second_fundamental_form(const S& system, const State<S>& state,
                                                                            typename S::Workspace& workspace,
                                                                            typename S::Vector& R) {
  auto f = system.make_vector(), B = f, f_normal = f;
  if (Status status = system.force(state.t, state.q, state.v, workspace, f); !status) return status;
  system.apply_inverse_mass(f, f);
  if (Status status = normal_part(system, state.q, f, workspace, f_normal); !status) return status;
  if (Status status = second_fundamental_form(system, state.q, state.v, workspace, B); !status) return status;
  axpy(-1.0, f_normal, B);
  system.apply_mass(B, R);
  return {};
}

}  // namespace pseudorigid::mechanics
