#pragma once
/// The slow motion of a system with a compliant constraint (mechanics/core/constrained_system.h), without the fast
/// oscillation of g about it (compliance_oscillation.h). With the multiplier λ of the slow motion and the stiffness κ,
/// it has
///
///   g(q) = −λ/κ,   G(q) v = −λ̇/κ,
///
/// up to terms of the relative order (ω/Ω)². Here ω is a frequency of the slow motion, and Ω one of the oscillation.

#include "mechanics/core/constrained_system.h"
#include "mechanics/methods/compliance.h"

namespace pseudorigid::mechanics {
namespace detail {

/// Sets `rate` to −λ̇/κ at a state of the slow motion with the multiplier λ. λ̇ is a central difference over the time
/// 2τ. Fails if a force or a Gram solve fails.
template <Compliant S>
Status rate_of_slow_constraint(const S& system, const State<S>& state, const typename S::Multiplier& lambda, double tau,
                               RattleWorkspace<S>& w, typename S::Multiplier& rate) {
  auto a = system.make_vector();
  if (Status status = system.force(state.t, state.q, state.v, w.system, a); !status) return status;
  system.add_reaction(state.q, lambda, a);
  system.apply_inverse_mass(a, a);
  typename S::Multiplier there = lambda;
  scale(0.0, rate);
  for (const double side : {1.0, -1.0}) {
    State<S> moved = state;
    axpy(side * tau, state.v, moved.q);
    axpy(side * tau, a, moved.v);
    if (Status status = multiplier_of_motion(system, moved, w.system, there); !status) return status;
    axpy(-side / (2 * tau * system.constraint_stiffness()), there, rate);
  }
  return {};
}

}  // namespace detail

/// Moves `state` to the slow motion, by changes of q and v along M⁻¹Gᵀ. `h` is a time in which the slow motion changes
/// little. Fails if a force or a Gram solve fails, or if an iteration does not converge.
template <Compliant S>
Status move_to_slow_motion(const S& system, double h, State<S>& state) {
  RattleWorkspace<S> w(system);
  auto lambda = system.make_multiplier(), slow = lambda;
  if (Status status = detail::meet_rate(system, slow, state, w); !status) return status;
  if (Status status = multiplier_of_motion(system, state, w.system, lambda); !status) return status;
  axpy(-1 / system.constraint_stiffness(), lambda, slow);
  const typename S::Vector q0 = state.q;
  if (Status status = detail::meet_value(system, h, slow, q0, state, w); !status) return status;
  if (Status status = detail::rate_of_slow_constraint(system, state, lambda, h, w, slow); !status) return status;
  return detail::meet_rate(system, slow, state, w);
}

}  // namespace pseudorigid::mechanics
