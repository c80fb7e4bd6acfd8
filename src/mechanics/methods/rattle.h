#pragma once
/// The method RATTLE (Andersen 1983; Hairer, Lubich, Wanner, Geometric Numerical Integration, VII.1.4). A substep of
/// size h for M q̈ = f + Gᵀλ, g(q) = 0, with G = Dg, is
///
///   v_{n+1/2} = v_n + (h/2) M⁻¹[f(q_n) + G(q_n)ᵀ λ_n]
///   q_{n+1}   = q_n + h v_{n+1/2},                             g(q_{n+1}) = 0
///   v_{n+1}   = v_{n+1/2} + (h/2) M⁻¹[f(q_{n+1}) + G(q_{n+1})ᵀ μ_n],   G(q_{n+1}) v_{n+1} = 0
///
/// The velocity projection with the multiplier μ_n changes v_{n+1} along M⁻¹G(q_{n+1})ᵀ. The next λ_{n+1} acts along
/// the same directions. If a step omits the projection, λ_{n+1} includes the missing change. RATTLE without the
/// projection (SHAKE) therefore has the same positions. `advance` omits the projection unless a force depends on the
/// velocity. `project_velocity` projects at samples.
///
/// Let Λ be the product of λ_n and the length of the half steps in which λ_n acts. This length is the sum of the half
/// steps before and after q_n, or only the half step after q_n if v_n is projected. Newton's iteration for g(q_{n+1}) =
/// 0 is
///
///   G(q) M⁻¹ G(q_n)ᵀ δ = −g(q),   v ← v + M⁻¹G(q_n)ᵀδ/h,   q ← q + M⁻¹G(q_n)ᵀδ,   Λ ← Λ + δ/h.
///
/// The iteration starts from an extrapolated multiplier and ends when |g| ≤ tolerance or when g consists of round-off.
///
/// If a force depends on the velocity, the first half step evaluates the force at v_n. The second half step evaluates
/// the force at v_{n+1} and is implicit:
///   v_{n+1} = v_{n+1/2} + (h/2) M⁻¹[f(q_{n+1}, v_{n+1}) + Gᵀμ_n].
/// rattle_velocity.h solves this equation together with the projection. The step remains symmetric and of order 2. For
/// unit mass, a linear drag −cv multiplies v by Cayley's factor (1 − hc/2)/(1 + hc/2). Damping does not limit the step:
/// an oscillator ẍ = −ω²x − cẋ is stable up to hω = 2 for every c. If the fixed-point iteration for v is already slow
/// in the first step of a run, the first half step of this step is implicit as well. An explicit half step would start
/// the motion of an overdamped body with a fast transient.
///
/// The coordinates of companions move along Kepler orbits in place of straight lines (orbiting_system.h). The step then
/// resolves only the forces that disturb the orbits.
///
/// Internal variables z (relaxation.h) follow their flow for the time h between the two half steps. For this flow, the
/// strain is constant and the mean of the strains at q_n and q_{n+1}. The splitting is symmetric and of order 2. It
/// does not need additional force evaluations.
///
/// If the constraint is compliant (constrained_system.h), an energy B(g) with b = DB replaces the condition g = 0. The
/// step is then that of the discrete Lagrangian with B at the mean of g at both ends of the step:
///
///   v_{n+1/2} = v_n + (h/2) M⁻¹[f(q_n) + G(q_n)ᵀ λ],   q_{n+1} = q_n + h v_{n+1/2},   λ = −b((g_n + g_{n+1})/2),
///   v_{n+1}   = v_{n+1/2} + (h/2) M⁻¹[f(q_{n+1}) + G(q_{n+1})ᵀ λ].
///
/// The step is symplectic, symmetric and of order 2. It keeps linear and angular momentum, because it is invariant
/// under the motions of space. Only b is implicit. For linear b and small motions about λ = 0, the step is stable if
/// hω ≤ 2 for the frequencies ω of f, for every stiffness κ of B. As κ → ∞, the step becomes that of the constraint g =
/// 0. Newton's iteration for λ (compliance.h) also changes v by M⁻¹G(q_n)ᵀδ/h.
///
/// The reactions of two successive half steps act at one position. `advance` therefore leaves the second one to the
/// next step, and `project_velocity` adds it at samples.
///
/// The increments of q and v are small compared with q and v. If the type of vectors permits, they are added with
/// compensation (vector_space.h), which leaves the remainders q_rounding and v_rounding. If `resolves_rounding` is true
/// for the system (constrained_system.h), the constraint is solved for the sum q + q_rounding.

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "mechanics/core/orbiting_system.h"
#include "mechanics/core/relaxation.h"
#include "mechanics/methods/compliance.h"
#include "mechanics/methods/rattle_velocity.h"

namespace pseudorigid::mechanics {

struct Rattle {
  static constexpr const char* name = "rattle";
  static constexpr const char* documentation = "RATTLE: symplectic, symmetric, one force a step";
  static constexpr int order = 2;
  static constexpr int n_stages = 1;
  static constexpr bool symplectic = true, symmetric = true;
  static constexpr bool adaptive = false, chosen_by_auto = true, takes_any_vector = true, takes_compliance = true;
  /// Largest hω of the harmonic oscillator for which the step is stable.
  static constexpr double stability_limit = 2.0;

  template <class S>
  using Workspace = RattleWorkspace<S>;
  template <class S>
  static constexpr bool fits = ConstrainedSystem<S>;

  /// Never fails: RATTLE accepts every constrained system.
  template <ConstrainedSystem S>
  static Status accepts(const S&) {
    return {};
  }

  /// Makes one step of size h. The final projection of the velocity is omitted unless a force depends on the velocity.
  /// Fails if the force, the constraint or a Gram solve fails, or if the iteration for the constraint or for the
  /// velocity does not converge. After a failure the state is not valid.
  template <ConstrainedSystem S>
  static Status advance(const S& system, double h, State<S>& state, RattleWorkspace<S>& w) {
    if (Status status = kick(system, h, state, w); !status) return status;
    if (relaxes(system) || has_companions(system)) w.q_start = state.q;
    if (Status status = move_on_constraint(system, h, state, w); !status) return status;
    if constexpr (Orbiting<S>)
      if (has_companions(system)) drift_companions(system, h, w.q_start, state.q, state.v);
    if constexpr (Relaxing<S>)
      if (relaxes(system)) system.relax(h, w.q_start, state.q, state.v);
    return kick_again(system, h, state, w);
  }

  /// Projects v onto G v = 0, which completes the step of RATTLE (rattle_velocity.h). Fails if a Gram solve fails or
  /// the projection does not converge.
  template <ConstrainedSystem S>
  static Status project_velocity(const S& system, State<S>& state, RattleWorkspace<S>& w) {
    return RattleVelocity::project_velocity(system, state, w);
  }

  /// Sets w.acceleration to M⁻¹f at the state, unless it is known. Fails if the force fails.
  template <ConstrainedSystem S>
  static Status ensure_acceleration(const S& system, const State<S>& state, RattleWorkspace<S>& w) {
    return RattleVelocity::ensure_acceleration(system, state, w);
  }

 private:
  /// Makes the second half step. If a force depends on the velocity, the iteration for the implicit equation starts
  /// from the guess 2 v_{n+1/2} − v_n, and w.settling.half becomes v_{n+1/2}. Fails if the force fails or the iteration
  /// does not converge.
  template <ConstrainedSystem S>
  static Status kick_again(const S& system, double h, State<S>& state, RattleWorkspace<S>& w) {
    state.t += h;
    w.acceleration_known = false;
    if constexpr (Damped<S>) w.damping.rest_known = false;
    w.pending_weight = h / 2;
    ++w.counters.n_substeps;
    if (velocity_dependent(system)) {
      if (is_compliant(system))
        if (Status status = project_velocity(system, state, w); !status) return status;
      scale(-1.0, w.settling.half);
      axpy(2.0, state.v, w.settling.half);
      std::swap(w.settling.half, state.v);
      return RattleVelocity::settle_velocity(system, h, state, w);
    }
    if (Status status = ensure_acceleration(system, state, w); !status) return status;
    add(h / 2, w.acceleration, state.v, w.v_rounding);
    return {};
  }

  /// Makes the first half step. If a force depends on the velocity, also sets w.settling.half to v_n. The first half
  /// step of a run is implicit if the system is damped and the fixed-point iteration is slow. Fails if the force fails,
  /// or if the equation of the implicit half step is not solved.
  template <ConstrainedSystem S>
  static Status kick(const S& system, double h, State<S>& state, RattleWorkspace<S>& w) {
    if (velocity_dependent(system)) w.settling.half = state.v;
    if constexpr (Damped<S>)
      if (velocity_dependent(system) && !std::exchange(w.begun, true)) {
        const typename S::Vector start = state.v, rounding = w.v_rounding;
        if (Status status = RattleVelocity::settle_velocity(system, h, state, w); !status) return status;
        w.settling.half = start;
        if (w.stiff) {
          system.add_taken(taken_beyond_power(system, h / 2, state, start, w.damping), state.v);
          return {};
        }
        state.v = start;
        w.v_rounding = rounding;
      }
    if (Status status = ensure_acceleration(system, state, w); !status) return status;
    add(h / 2, w.acceleration, state.v, w.v_rounding);
    return {};
  }

  /// Returns the correction of the dissipated energy after an implicit half step of length s from the velocity v_0
  /// (`start`) to v (`state.v`). This half step dissipates ½s (v_0 + v)ᵀS v, but the system has counted s vᵀS v. S is
  /// the operator of the secant (damping.h).
  template <Damped S>
  static double taken_beyond_power(const S& system, double s, const State<S>& state, const typename S::Vector& start,
                                   DampingTemporaries<S>& w) {
    scale(0.0, w.force);
    system.add_damping(state, state.v, Linearization::secant, w.force);
    return 0.5 * s * (dot(state.v, w.force) - dot(start, w.force));
  }

  /// Adds h v to q, with v corrected along M⁻¹G(q_n)ᵀ such that g(q) = 0 at the new q. Also records the multiplier λ_n
  /// for later guesses. Without constraints, v does not change. Fails if the constraint or a Gram solve fails, or if
  /// the iteration does not converge.
  template <ConstrainedSystem S>
  static Status move_on_constraint(const S& system, double h, State<S>& state, RattleWorkspace<S>& w) {
    if constexpr (unconstrained<S>) {
      add(h, state.v, state.q, w.q_rounding);
      return {};
    } else {
      w.q_start = state.q;
      if constexpr (Compliant<S>)
        if (is_compliant(system)) return move_against_compliance(system, h, state, w);
      const double weight = w.pending_weight + h / 2;
      w.history.guess(state.t, w.impulse);
      scale(weight, w.impulse);
      w.constraint.direction_known = false;
      detail::set_reaction(system, w.q_start, w.impulse, w.system, w.constraint);
      add(1.0, w.constraint.reaction, state.v, w.v_rounding);
      add(h, state.v, state.q, w.q_rounding);
      const auto apply = [&] {
        axpy(1 / h, w.constraint.delta, w.impulse);
        // The increment of q must be exactly h times the increment of v. If v had the rounded factor fl(1/h) and q the
        // factor 1, every step would violate symplecticity by the same number h fl(1/h) − 1.
        scale(1 / h, w.constraint.reaction);
        add(1.0, w.constraint.reaction, state.v, w.v_rounding);
        add(h, w.constraint.reaction, state.q, w.q_rounding);
        ++w.counters.n_position_iterations;
      };
      Status status = detail::meet_position_constraint(system, position_tolerance(w), state.q, w.q_rounding, w.q_start,
                                                       w.system, w.constraint, apply);
      w.counters.n_gram_iterations += std::exchange(w.constraint.n_gram_iterations, 0);
      if (!status) return status;
      record_multiplier(state.t, weight, h, w);
      return {};
    }
  }

  /// Adds h v_{n+1/2} to q, with the multiplier λ of a compliant constraint, and records λ. On entry, v is v_n +
  /// (h/2)M⁻¹f, without the reaction of the second half of the step before. Fails if the constraint or a Gram solve
  /// fails, or if the iteration does not converge.
  template <Compliant S>
  static Status move_against_compliance(const S& system, double h, State<S>& state, RattleWorkspace<S>& w) {
    if (!w.compliance.g_known)
      if (Status status = system.constraint(state.q, w.compliance.g_end); !status) return status;
    std::swap(w.compliance.g_start, w.compliance.g_end);
    w.compliance.g_known = false;
    auto& lambda = w.compliance.lambda;
    w.history.guess(state.t + h / 2, lambda);
    w.impulse = lambda;
    scale(h / 2, w.impulse);
    axpy(w.pending_weight, w.history.values[0], w.impulse);
    detail::set_reaction(system, w.q_start, w.impulse, w.system, w.constraint);
    add(1.0, w.constraint.reaction, state.v, w.v_rounding);
    add(h, state.v, state.q, w.q_rounding);
    const double per_delta = 2 / (h * h);
    const auto find_mean = [&] {
      w.compliance.mean = w.compliance.g_start;
      axpy(1.0, w.compliance.g_end, w.compliance.mean);
      scale(0.5, w.compliance.mean);
    };
    const auto apply = [&] {
      axpy(per_delta, w.constraint.delta, lambda);
      scale(1 / h, w.constraint.reaction);
      add(1.0, w.constraint.reaction, state.v, w.v_rounding);
      add(h, w.constraint.reaction, state.q, w.q_rounding);
      ++w.counters.n_position_iterations;
    };
    if (Status status = detail::meet_compliance(system, h, 0.5, per_delta, state.q, lambda, w, find_mean, apply);
        !status)
      return status;
    w.compliance.g_known = true;
    w.history.record(state.t + h / 2, lambda);
    return {};
  }

  /// Returns the tolerance of |g|_∞ in a step. If sums are not compensated, the result is w.constraint_tolerance. If
  /// sums are compensated, |g| is the largest error of a step and accumulates, so w.constraint_tolerance is too coarse.
  /// If the constraint is solved for q + q_rounding (`resolves_rounding`), the result is 1/256 of
  /// w.constraint_tolerance. Otherwise the result is 0, and g(q) is iterated to its round-off. In measurements with the
  /// tolerance w.constraint_tolerance, the energy of a pseudo-rigid body drifted by 7e-12 in 10⁶ periods. If g(q) was
  /// iterated to its round-off, the drift was 1e-12. There was no drift if |g(q + q_rounding)| was less than this
  /// round-off.
  template <ConstrainedSystem S>
  static double position_tolerance(const RattleWorkspace<S>& w) {
    if constexpr (resolves_rounding<S>)
      return 0x1p-8 * w.constraint_tolerance;
    else if constexpr (VectorSpace<typename S::Vector>::compensated)
      return 0;
    else
      return w.constraint_tolerance;
  }

  /// Divides w.impulse = Λ by `weight`, the length of the half steps in which λ acts. Records the quotient as λ(t). If
  /// consecutive substeps of a composition have opposite signs, `weight` may be nearly 0. The function then does
  /// nothing.
  template <ConstrainedSystem S>
  static void record_multiplier(double t, double weight, double h, RattleWorkspace<S>& w) {
    if (std::abs(weight) < 0.1 * std::abs(h)) return;
    scale(1 / weight, w.impulse);
    w.history.record(t, w.impulse);
  }
};

}  // namespace pseudorigid::mechanics
