#pragma once
/// The workspace of the method energy-momentum. The state X = (q, p), with the momentum p = M v, has the values X₀, X_m
/// and X₁ at the start, the middle and the end of a step. The changes in a step are Δq and Δv. The multipliers of the
/// constraints g = 0 and γ = ġ = 0 are λ and μ. The formulas for A, B, C, P and θ are in energy_momentum.h.

#include "mechanics/core/conservative_system.h"
#include "mechanics/core/orbit_complement.h"
#include "mechanics/methods/momentum_keeper.h"
#include "mechanics/methods/rattle.h"

namespace pseudorigid::mechanics {

/// Temporaries, initial guesses and accumulated errors of one integration.
template <ConservativeSystem S>
struct EnergyMomentumWorkspace {
  using Vector = typename S::Vector;
  using Multiplier = typename S::Multiplier;

  explicit EnergyMomentumWorkspace(const S& system)
      : system(system.make_workspace()),
        dq(system.make_vector()),
        dv(dq),
        dq_before(dq),
        dv_before(dq),
        q_middle(dq),
        v_middle(dq),
        q_end(dq),
        v_end(dq),
        q_side(dq),
        v_side(dq),
        force(dq),
        A(dq),
        B(dq),
        C_q(dq),
        C_v(dq),
        P_q(dq),
        P_v(dq),
        acceleration(dq),
        q_rounding(make_rounding(system)),
        v_rounding(q_rounding),
        lambda(system.make_multiplier()),
        mu(lambda),
        residual(lambda),
        delta(lambda),
        history(system),
        orbit(system),
        momenta(system) {}

  typename S::Workspace system;
  Vector dq, dv, dq_before, dv_before;                      // Δq and Δv, and their values in the previous iteration
  Vector q_middle, v_middle, q_end, v_end, q_side, v_side;  // q and v of X_m, of X₁, and of X₀ + P/2 or X₁ − P/2
  Vector force, A, B, C_q, C_v, P_q, P_v;                   // f with its reactions; A, B, C and P of the formulas
  Vector acceleration;                                      // Δv/h of the last step
  Vector q_rounding, v_rounding;                            // remainders of the compensated sums of q and v
  Multiplier lambda, mu, residual, delta;                   // λ, μ, the residual g or γ, and δ of `react`
  MultiplierHistory<S> history;                             // multipliers λ at the middle of the steps
  OrbitComplement<S> orbit;
  MomentumKeeper<S> momenta;
  double V_start = 0, theta = 0;  // V at the start of the step; θ of the formulas
  int hold = 0;                   // the iteration changes θ and C if 0, only C if 1, neither of them if 2
  double energy_gained = 0;       // sum of the energy errors of all steps
  double first_noise = -1;        // round-off of V at the first state; negative: not yet measured
  double largest_noise = 0;       // largest round-off of V at the states so far
  Counters counters;

  /// Passes each member that a checkpoint must contain to `visit`.
  template <class Visit>
  void visit_memory(Visit&& visit) {
    if constexpr (requires { system.visit_memory(visit); }) system.visit_memory(visit);
    visit(acceleration);
    history.visit_memory(visit);
    visit(energy_gained);
    visit(first_noise);
    visit(largest_noise);
    momenta.visit_memory(visit);
    if constexpr (VectorSpace<Vector>::compensated) {
      visit(q_rounding);
      visit(v_rounding);
    }
  }
};

}  // namespace pseudorigid::mechanics
