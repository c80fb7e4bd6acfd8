#pragma once
/// The method RATTLE (Andersen 1983; Hairer, Lubich, Wanner, Geometric Numerical Integration, VII.1.4). A substep of
/// size h for M q̈ = f + Gᵀλ, g(q) = 0, with G = Dg, is
///
///   v_{n+1/2} = v_n + (h/2) M⁻¹[f(q_n) + G(q_n)ᵀ λ_n]
///   q_{n+1}   = q_n + h v_{n+1/2},                             g(q_{n+1}) = 0
///   v_{n+1}   = v_{n+1/2} + (h/2) M⁻¹[f(q_{n+1}) + G(q_{n+1})ᵀ μ_n],   G(q_{n+1}) v_{n+1} = 0
///
/// The velocity projection with the multiplier μ_n changes v_{n+1} along M⁻¹G(q_{n+1})ᵀ. The next λ_{n+1} acts along
/// the same directions. If a step omits the projection, λ_{n+1} takes over the missing change. SHAKE and RATTLE
/// therefore have equal positions. `advance` omits the projection, and `project_velocity` projects at samples.
///
/// λ_n is multiplied by the sum of the half steps before and after q_n. With Λ for this product, Newton's iteration is
///
///   G(q) M⁻¹ G(q_n)ᵀ δ = −g(q),   v ← v + M⁻¹G(q_n)ᵀδ/h,   q ← q + M⁻¹G(q_n)ᵀδ,   Λ ← Λ + δ/h.
///
/// The iteration starts from an extrapolated multiplier and ends when |g| ≤ tolerance or when g consists of round-off.
///
/// If a force depends on the velocity, the first half step evaluates the force at v_n. The second half step evaluates
/// the force at v_{n+1} and is implicit:
///   v_{n+1} = v_{n+1/2} + (h/2) M⁻¹[f(q_{n+1}, v_{n+1}) + Gᵀμ_n].
/// A fixed-point iteration on the force solves this equation together with the projection. The step remains symmetric
/// and of order 2; a linear drag −cv gives Cayley's factor (1 − hc/2)/(1 + hc/2). If this iteration is slow, a linear
/// system is solved instead (linear_damping.h). Such a system exists if the force depends on v by a term −C(q)v with a
/// symmetric C. Then damping does not limit the step: an oscillator ẍ = −ω²x − cẋ is stable up to hω = 2 for every c.
/// If the iteration is already slow in the first step, the first half step is implicit as well. Otherwise an overdamped
/// body would start with a fast transient.
///
/// The increments of q and v are small compared with q and v, and are summed with compensation (vector_space.h). If the
/// system supports it (`resolves_rounding`), the constraint is solved for the sum q + q_rounding.

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "mechanics/core/constrained_system.h"
#include "mechanics/core/constraint_newton.h"
#include "mechanics/core/linear_damping.h"
#include "mechanics/core/second_order_field.h"
#include "mechanics/methods/multiplier_history.h"

namespace pseudorigid::mechanics {

struct Counters {
  long n_steps = 0, n_substeps = 0, n_force = 0, n_position_iterations = 0, n_projections = 0, n_gram_iterations = 0;
};

/// Returns a zero vector if sums of vectors are compensated (vector_space.h), otherwise an empty object.
template <class S>
typename S::Vector make_rounding(const S& system) {
  if constexpr (VectorSpace<typename S::Vector>::compensated)
    return system.make_vector();
  else
    return {};
}

/// Temporaries of the iteration on a force that depends on the velocity. They are empty for other forces.
template <class S>
struct VelocityIteration {
  /// True if a solve for multipliers is costly. Each iteration then starts from the reactions of the iterations before.
  static constexpr bool keeps_reactions = !unconstrained<S> && !VectorSpace<typename S::Vector>::dense;

  explicit VelocityIteration(const S& system)
      : half(vector_if(velocity_dependent(system), system)),
        before(vector_if(velocity_dependent(system), system)),
        free(vector_if(keeps_reactions && velocity_dependent(system), system)),
        reaction(vector_if(keeps_reactions && velocity_dependent(system), system)) {}

  typename S::Vector half;            // v_n, then v_{n+1/2}
  typename S::Vector before;          // v_{n+1} of the previous iteration
  typename S::Vector free, reaction;  // v_{n+1} before the last projection; all reactions so far

 private:
  static typename S::Vector vector_if(bool wanted, const S& system) {
    return wanted ? system.make_vector() : typename S::Vector{};
  }
};

/// Temporaries, cached values and initial guesses of one integration.
template <ConstrainedSystem S>
struct RattleWorkspace {
  explicit RattleWorkspace(const S& system)
      : system(system.make_workspace()),
        acceleration(system.make_vector()),
        q_start(system.make_vector()),
        settling(system),
        damping(system, velocity_dependent(system)),
        q_rounding(make_rounding(system)),
        v_rounding(make_rounding(system)),
        constraint(system),
        impulse(system.make_multiplier()),
        history(system),
        constraint_tolerance(system.constraint_tolerance()) {}

  typename S::Workspace system;
  typename S::Vector acceleration, q_start;  // M⁻¹f at the state (symmetric_multistep.h adds a reaction); q_n
  VelocityIteration<S> settling;
  [[no_unique_address]] DampingTemporaries<S> damping;
  typename S::Vector q_rounding, v_rounding;  // remainders of the compensated sums of q and v
  detail::ConstraintTemporaries<S> constraint;
  typename S::Multiplier impulse;  // Λ
  MultiplierHistory<S> history;
  double constraint_tolerance;   // permitted |g|_∞ and |G v|_∞; the default is that of the system
  double pending_weight = 0;     // length of the last half step, if its reaction is not yet in v; otherwise 0
  double acceleration_time = 0;  // time of `acceleration`
  bool acceleration_known = false;
  bool begun = false;  ///< true after the first step of a linearly damped system
  bool stiff = false;  ///< true if the fixed-point iteration on the damping is slow and a linear system is solved
  Counters counters;

  /// Passes each member that a checkpoint must contain to `visit`. A resumed run computes the other members again.
  template <class Visit>
  void visit_memory(Visit&& visit) {
    if constexpr (requires { system.visit_memory(visit); }) system.visit_memory(visit);
    history.visit_memory(visit);
    visit(pending_weight);
    if constexpr (LinearlyDamped<S>) {
      visit(begun);
      visit(stiff);
    }
    if constexpr (VectorSpace<typename S::Vector>::compensated) {
      visit(q_rounding);
      visit(v_rounding);
    }
  }
};

struct Rattle {
  static constexpr const char* name = "rattle";
  static constexpr const char* documentation = "RATTLE: symplectic, symmetric, one force a step";
  static constexpr int order = 2;
  static constexpr int n_stages = 1;
  static constexpr bool symplectic = true, symmetric = true;
  static constexpr bool adaptive = false, chosen_by_auto = true, takes_any_vector = true;
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

  /// Makes one substep, without the final velocity projection unless a force depends on the velocity.
  template <ConstrainedSystem S>
  static Status advance(const S& system, double h, State<S>& state, RattleWorkspace<S>& w) {
    if (Status status = kick(system, h, state, w); !status) return status;
    if (Status status = move_on_constraint(system, h, state, w); !status) return status;
    state.t += h;
    w.acceleration_known = false;
    w.pending_weight = h / 2;
    ++w.counters.n_substeps;
    if (velocity_dependent(system)) {
      scale(-1.0, w.settling.half);
      axpy(2.0, state.v, w.settling.half);
      std::swap(w.settling.half, state.v);
      return settle_velocity(system, h, state, w);
    }
    if (Status status = ensure_acceleration(system, state, w); !status) return status;
    add(h / 2, w.acceleration, state.v, w.v_rounding);
    return {};
  }

  /// v ← v − M⁻¹Gᵀ(G M⁻¹Gᵀ)⁻¹ G v, until G v is below the tolerance or round-off. This completes the step of RATTLE.
  template <ConstrainedSystem S>
  static Status project_velocity(const S& system, State<S>& state, RattleWorkspace<S>& w) {
    if constexpr (!unconstrained<S>) {
      w.constraint.direction_known = false;
      const auto apply = [&] {
        add(1.0, w.constraint.reaction, state.v, w.v_rounding);
        if (velocity_dependent(system)) w.acceleration_known = false;
      };
      Status status = detail::meet_velocity_constraint(system, w.constraint_tolerance, state.q, state.v, w.system,
                                                       w.constraint, apply);
      w.counters.n_gram_iterations += std::exchange(w.constraint.n_gram_iterations, 0);
      if (!status) return status;
      w.pending_weight = 0;
      ++w.counters.n_projections;
    }
    return {};
  }

  /// Sets w.acceleration to M⁻¹f at the state, unless it is known.
  template <ConstrainedSystem S>
  static Status ensure_acceleration(const S& system, const State<S>& state, RattleWorkspace<S>& w) {
    // After a step the time loop sets the time again, with another round-off. A checkpoint contains this second time,
    // so a resumed run gives the same results only if the acceleration belongs to the second time.
    if (w.acceleration_known && (!time_dependent(system) || w.acceleration_time == state.t)) return {};
    if (Status status = system.force(state.t, state.q, state.v, w.system, w.acceleration); !status) return status;
    system.apply_inverse_mass(w.acceleration, w.acceleration);
    ++w.counters.n_force;
    w.acceleration_known = true;
    w.acceleration_time = state.t;
    return {};
  }

 private:
  /// Makes the first half step. If a force depends on the velocity, w.settling.half is v_n afterwards. The very first
  /// half step is implicit if the system is linearly damped and stiff.
  template <ConstrainedSystem S>
  static Status kick(const S& system, double h, State<S>& state, RattleWorkspace<S>& w) {
    if (velocity_dependent(system)) w.settling.half = state.v;
    if constexpr (LinearlyDamped<S>)
      if (velocity_dependent(system) && !std::exchange(w.begun, true)) {
        const typename S::Vector start = state.v, rounding = w.v_rounding;
        if (Status status = settle_velocity(system, h, state, w); !status) return status;
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

  /// Returns a correction of the dissipated energy. An implicit kick of length s from v_0 to v dissipates ½s (v_0 +
  /// v)ᵀC v, but the system has counted s vᵀC v.
  template <LinearlyDamped S>
  static double taken_beyond_power(const S& system, double s, const State<S>& state, const typename S::Vector& start,
                                   DampingTemporaries<S>& w) {
    scale(0.0, w.force);
    system.add_damping(state.q, state.v, w.force);
    return 0.5 * s * (dot(state.v, w.force) - dot(start, w.force));
  }

  /// Sets v to the solution of v = w.settling.half + (h/2) M⁻¹[f(v) + Gᵀμ] with G v = 0. For linear damping, a linear
  /// system replaces the fixed-point iteration if the iteration is slow.
  template <ConstrainedSystem S>
  static Status settle_velocity(const S& system, double h, State<S>& state, RattleWorkspace<S>& w) {
    if constexpr (LinearlyDamped<S>) {
      if (!w.stiff) {
        constexpr bool compensated = VectorSpace<typename S::Vector>::compensated;
        auto &guess = w.damping.solution, &rounding = w.damping.product;
        guess = state.v;
        if constexpr (compensated) rounding = w.v_rounding;
        if (Status status = iterate_velocity(system, h, state, w); !status) return status;
        if (!w.stiff) return {};
        state.v = guess;
        if constexpr (compensated) w.v_rounding = rounding;
      }
      return solve_velocity(system, h, state, w);
    } else {
      return iterate_velocity(system, h, state, w);
    }
  }

  /// Solves the equation of `settle_velocity` if the force depends linearly on v. A second solve removes the residual
  /// of the first. The system therefore computes the power of its forces at a v that is final up to this residual.
  template <LinearlyDamped S>
  static Status solve_velocity(const S& system, double h, State<S>& state, RattleWorkspace<S>& w) {
    const typename S::Vector rounding_half = w.v_rounding;
    if (Status status = project_velocity(system, state, w); !status) return status;
    for (int i = 0; i < 2; ++i) {
      w.acceleration_known = false;
      if (Status status = ensure_acceleration(system, state, w); !status) return status;
      auto& residual = w.damping.residual;
      residual = w.settling.half;
      axpy(-1.0, state.v, residual);
      if constexpr (VectorSpace<typename S::Vector>::compensated) {
        axpy(1.0, rounding_half, residual);
        axpy(-1.0, w.v_rounding, residual);
      }
      axpy(h / 2, w.acceleration, residual);
      const double round_off = std::numeric_limits<double>::epsilon() * max_norm(state.v);
      const double enough = std::max(round_off, w.constraint_tolerance / 10);
      w.constraint.direction_known = false;
      Status status = solve_damping(system, h / 2, state.q, enough, w.system, w.constraint, w.damping);
      // A product costs about as much as a force evaluation and counts as one.
      w.counters.n_force += std::exchange(w.damping.n_products, 0);
      if (!status) return status;
      add(1.0, w.damping.solution, state.v, w.v_rounding);
      status = project_velocity(system, state, w);
      if (!status) return status;
    }
    w.acceleration_known = false;  // the known acceleration is at the velocity before the last correction
    return {};
  }

  /// Solves the equation of `settle_velocity` by alternate evaluations of the force and projections, until v no longer
  /// changes. If the force is linear in v and the iteration is slow, sets w.stiff and returns without a solution.
  template <ConstrainedSystem S>
  static Status iterate_velocity(const S& system, double h, State<S>& state, RattleWorkspace<S>& w) {
    auto& [half, before, free, reaction] = w.settling;
    constexpr bool keeps_reactions = VelocityIteration<S>::keeps_reactions;
    const typename S::Vector rounding_half = w.v_rounding;
    if constexpr (keeps_reactions) scale(0.0, reaction);
    double size_before = HUGE_VAL;
    for (int i = 0; i < detail::max_constraint_iterations; ++i) {
      w.acceleration_known = false;
      if (Status status = ensure_acceleration(system, state, w); !status) return status;
      before = state.v;
      state.v = half;
      w.v_rounding = rounding_half;
      add(h / 2, w.acceleration, state.v, w.v_rounding);
      if constexpr (keeps_reactions) {
        axpy(1.0, reaction, state.v);
        free = state.v;
      }
      if (Status status = project_velocity(system, state, w); !status) return status;
      if constexpr (keeps_reactions) {
        axpy(1.0, state.v, reaction);
        axpy(-1.0, free, reaction);
      }
      axpy(-1.0, state.v, before);
      const double size = max_norm(before), round_off = 4 * std::numeric_limits<double>::epsilon() * max_norm(state.v);
      // The projection leaves a residual of G v up to the tolerance. Changes of v of this size do not indicate
      // divergence.
      const double enough = std::max(round_off / 4, w.constraint_tolerance / 10);
      const double jitter = std::max(100 * round_off, 1000 * w.constraint_tolerance);
      // If each change is c times the previous one, the sum of all further changes is size · c/(1 − c).
      const double c = size / size_before;
      if (size <= round_off || (i > 0 && c < 0.5 && size * c / (1 - c) <= enough) || (c >= 0.5 && size <= jitter)) {
        w.acceleration_known = false;  // the known acceleration is at the velocity before the last iteration
        return {};
      }
      constexpr double slow = 0.3;
      if (LinearlyDamped<S> && !(c <= slow)) {
        if (i > 0) {
          w.stiff = true;
          return {};
        }
      } else if (!(size < 2 * size_before)) {
        break;
      }
      size_before = size;
    }
    return Status::failure(
        "the iteration on a force that depends on the velocity does not converge; use a smaller step");
  }

  /// q ← q + h v, with v corrected along M⁻¹G(q_n)ᵀ such that g(q) = 0 at the new q.
  template <ConstrainedSystem S>
  static Status move_on_constraint(const S& system, double h, State<S>& state, RattleWorkspace<S>& w) {
    if constexpr (unconstrained<S>) {
      add(h, state.v, state.q, w.q_rounding);
      return {};
    } else {
      w.q_start = state.q;
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

  /// Largest |g| that a step may leave: the tolerance of the system. If sums are compensated, |g| is the largest error
  /// of a step and accumulates, so this tolerance is too coarse. It is divided by 256 if the constraint is solved for
  /// q + q_rounding (`resolves_rounding`). Otherwise 0 is returned, and g(q) is iterated to its round-off. The measured
  /// energy drift on SL(3) in 10⁶ periods is 7e-12 with the tolerance of the system, and 1e-12 if g(q) is iterated to
  /// its round-off. There is no drift if |g(q + q_rounding)| is less than this round-off.
  template <ConstrainedSystem S>
  static double position_tolerance(const RattleWorkspace<S>& w) {
    if constexpr (resolves_rounding<S>)
      return 0x1p-8 * w.constraint_tolerance;
    else if constexpr (VectorSpace<typename S::Vector>::compensated)
      return 0;
    else
      return w.constraint_tolerance;
  }

  /// Divides w.impulse = Λ by `weight`, the sum of the half steps before and after the time t. Records the quotient as
  /// λ(t). If consecutive substeps have opposite signs, `weight` may be nearly 0. The function then does nothing.
  template <ConstrainedSystem S>
  static void record_multiplier(double t, double weight, double h, RattleWorkspace<S>& w) {
    if (std::abs(weight) < 0.1 * std::abs(h)) return;
    scale(1 / weight, w.impulse);
    w.history.record(t, w.impulse);
  }
};

}  // namespace pseudorigid::mechanics
