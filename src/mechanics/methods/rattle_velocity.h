#pragma once
/// The velocity at the end of a step of RATTLE (rattle.h). The mass is M, the force f and the derivative of the
/// constraint G. With the velocity v_half after the first half step of a step h, the velocity v satisfies
///
///   v = v_half + (h/2) M⁻¹[f(q, v) + Gᵀμ],   G v = 0.
///
/// If f depends on v, a fixed-point iteration on the force solves this equation together with the projection. If the
/// iteration is slow and the force is damping, linear systems replace it (damping.h). Damping that is linear in v needs
/// one linear system. Other damping, such as friction, needs Newton's method. The residual of the equation is the
/// negative derivative of a convex function of v (Ψ in damping.h). A correction that passes the minimum of this
/// function by far is shortened. The iteration therefore converges from every v. The accepted velocity satisfies the
/// nonlinear equation up to the tolerance of the constraints or round-off.

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mechanics/methods/rattle_workspace.h"

namespace pseudorigid::mechanics {

struct RattleVelocity {
  /// Repeats v ← v − M⁻¹Gᵀ(G M⁻¹Gᵀ)⁻¹ G v until |G v|_∞ is at most w.constraint_tolerance or round-off. This projection
  /// completes the step of RATTLE. If the constraint is compliant, adds the pending reaction to v instead. Fails if a
  /// Gram solve fails or the projection does not converge. Does nothing without constraints.
  template <ConstrainedSystem S>
  static Status project_velocity(const S& system, State<S>& state, RattleWorkspace<S>& w) {
    if constexpr (Compliant<S>)
      if (is_compliant(system)) {
        add_pending_reaction(system, state, w);
        return {};
      }
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

  /// Sets w.acceleration to M⁻¹f at the state, unless it is known. Fails if the force fails.
  template <ConstrainedSystem S>
  static Status ensure_acceleration(const S& system, const State<S>& state, RattleWorkspace<S>& w) {
    // After a step, the time loop computes the time anew, with another rounding error. A checkpoint contains this time.
    // A resumed run therefore gives the same results only if the acceleration is computed at this time.
    if (w.acceleration_known && (!time_dependent(system) || w.acceleration_time == state.t)) return {};
    if (Status status = find_force(system, state, w); !status) return status;
    system.apply_inverse_mass(w.acceleration, w.acceleration);
    w.acceleration_known = true;
    w.acceleration_time = state.t;
    return {};
  }

  /// Sets v to the solution of v = v_half + (h/2) M⁻¹[f(q, v) + Gᵀμ] with G v = 0. On entry w.settling.half is v_half,
  /// and v is the guess. If the force is damping and the fixed-point iteration is slow, linear systems replace the
  /// iteration. Fails if the force or a projection fails, or if no iteration converges.
  template <ConstrainedSystem S>
  static Status settle_velocity(const S& system, double h, State<S>& state, RattleWorkspace<S>& w) {
    if constexpr (Damped<S>) {
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

 private:
  /// Adds the reaction of a compliant constraint in the second half of the last step to v, unless v already contains
  /// it.
  template <Compliant S>
  static void add_pending_reaction(const S& system, State<S>& state, RattleWorkspace<S>& w) {
    if (w.pending_weight == 0) return;
    w.impulse = w.history.values[0];
    scale(w.pending_weight, w.impulse);
    detail::set_reaction(system, state.q, w.impulse, w.system, w.constraint);
    add(1.0, w.constraint.reaction, state.v, w.v_rounding);
    w.pending_weight = 0;
    ++w.counters.n_projections;
  }

  /// Sets w.acceleration to f at the state, and fails if the force fails. If the damping is linear and no force depends
  /// on time, f(q, v) is the sum of f(q, 0) and the damping. The first call at q stores f(q, 0), so the iterations for
  /// v evaluate only the damping again.
  template <ConstrainedSystem S>
  static Status find_force(const S& system, const State<S>& state, RattleWorkspace<S>& w) {
    if constexpr (Damped<S>) {
      if (velocity_dependent(system) && !time_dependent(system) && damping_is_linear(system)) {
        scale(0.0, w.damping.force);
        if (!w.damping.rest_known) {
          if (Status status = system.force(state.t, state.q, w.damping.force, w.system, w.damping.at_rest); !status)
            return status;
          ++w.counters.n_force;
          w.damping.rest_known = true;
        }
        system.add_damping(state, state.v, Linearization::tangent, w.damping.force);
        w.acceleration = w.damping.at_rest;
        axpy(1.0, w.damping.force, w.acceleration);
        system.add_taken(-dot(state.v, w.damping.force), w.acceleration);
        return {};
      }
    }
    ++w.counters.n_force;
    return system.force(state.t, state.q, state.v, w.system, w.acceleration);
  }

  /// Solves the equation of `settle_velocity` if the force is damping. If the damping is not linear in v, Newton's
  /// method solves the equation. If the damping is linear, the first correction leaves only a small residual, and a
  /// second correction removes this residual. The force and its dissipated power are evaluated for the last time before
  /// the second correction. They are accurate up to the small residual. Fails if the force, a projection or a linear
  /// system fails.
  template <Damped S>
  static Status solve_velocity(const S& system, double h, State<S>& state, RattleWorkspace<S>& w) {
    const typename S::Vector rounding_half = w.v_rounding;
    if (!damping_is_linear(system)) return solve_velocity_by_newton(system, h, rounding_half, state, w);
    if (Status status = project_velocity(system, state, w); !status) return status;
    for (int i = 0; i < 2; ++i) {
      if (Status status = find_residual(system, h, rounding_half, state, w); !status) return status;
      const double enough = enough_for_velocity(state, w);
      if (Status status = solve_for_correction(system, h, enough, state, w); !status) return status;
      add(1.0, w.damping.solution, state.v, w.v_rounding);
      if (Status status = project_velocity(system, state, w); !status) return status;
    }
    w.acceleration_known = false;  // w.acceleration belongs to the velocity before the last correction
    return {};
  }

  /// Solves the equation of `settle_velocity` for damping that is not linear in v. On entry, v is the extrapolation 2
  /// v_half − v_n from the velocity v_n before the step. The iteration starts from v_n. If a body sticks by friction,
  /// the solution has the size of v_n, but v_half and the extrapolation are much larger. The iteration ends if the
  /// residual is small enough, or if the last correction was round-off. Fails if 100 corrections are not enough, or if
  /// the force, a projection or a linear system fails.
  template <Damped S>
  static Status solve_velocity_by_newton(const S& system, double h, const typename S::Vector& rounding_half,
                                         State<S>& state, RattleWorkspace<S>& w) {
    constexpr int most_corrections = 100;
    scale(-1.0, state.v);
    axpy(2.0, w.settling.half, state.v);
    if (Status status = project_velocity(system, state, w); !status) return status;
    if (Status status = find_residual(system, h, rounding_half, state, w); !status) return status;
    double size_before = HUGE_VAL, change = HUGE_VAL;
    for (int i = 0; i < most_corrections; ++i) {
      const double size = max_norm(w.damping.residual), enough = enough_for_velocity(state, w);
      if (size <= enough || (change <= 16 * enough && size > size_before / 2)) return {};
      size_before = size;
      if (Status status = search_along_correction(system, h, rounding_half, state, w, change); !status) return status;
    }
    return Status::failure("the velocity that the friction leaves is not found; use a smaller step");
  }

  /// Adds a correction αu to v, with the solution u of the linear system for the residual r at v. The convex function
  /// Ψ(v + αu) has the derivative −uᵀM r with respect to α, with r at v + αu. The factor α is 1 if v + u is not far
  /// beyond the minimum of Ψ, and is found by bisection otherwise. Sets w.damping.residual to r at the new v, and
  /// `change` to the size of αu. After 60 bisections, the last α is used. Fails if the force, a projection or the
  /// linear system fails.
  template <Damped S>
  static Status search_along_correction(const S& system, double h, const typename S::Vector& rounding_half,
                                        State<S>& state, RattleWorkspace<S>& w, double& change) {
    constexpr int most_bisections = 60;
    constexpr double relative = 1e-3;  // the linear system is solved up to this fraction of the residual
    const typename S::Vector before = state.v, rounding_before = w.v_rounding, residual = w.damping.residual;
    const auto& u = w.damping.solution;
    const auto slope_of = [&](const typename S::Vector& r) {
      system.apply_mass(r, w.damping.momentum);
      return dot(u, w.damping.momentum);
    };
    const double enough = std::max(enough_for_velocity(state, w), relative * max_norm(residual));
    if (Status status = solve_for_correction(system, h, enough, state, w); !status) return status;
    const double permitted = 0.5 * std::abs(slope_of(residual));
    double low = 0, high = 2, alpha = 1;
    for (int i = 0; i < most_bisections; ++i) {
      state.v = before;
      w.v_rounding = rounding_before;
      add(alpha, u, state.v, w.v_rounding);
      if (Status status = project_velocity(system, state, w); !status) return status;
      if (Status status = find_residual(system, h, rounding_half, state, w); !status) return status;
      const double slope = slope_of(w.damping.residual);
      const bool is_beyond = slope < -permitted, is_before = high <= 1 && slope > permitted;
      if (!is_beyond && !is_before) break;
      (is_beyond ? high : low) = alpha;
      alpha = 0.5 * (low + high);
    }
    change = alpha * max_norm(u);
    return {};
  }

  /// Returns the size in the maximum norm up to which the residual of v is small enough. This size is a tenth of the
  /// constraint tolerance, or the round-off of v if this is larger.
  template <ConstrainedSystem S>
  static double enough_for_velocity(const State<S>& state, const RattleWorkspace<S>& w) {
    return std::max(std::numeric_limits<double>::epsilon() * max_norm(state.v), w.constraint_tolerance / 10);
  }

  /// Sets w.damping.residual to the residual v_half − v + (h/2) M⁻¹f(q, v) of the equation of `settle_velocity`,
  /// projected onto G v = 0. `rounding_half` is the remainder of the compensated sum v_half. Fails if the force or the
  /// projection fails.
  template <Damped S>
  static Status find_residual(const S& system, double h, const typename S::Vector& rounding_half, State<S>& state,
                              RattleWorkspace<S>& w) {
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
    w.constraint.direction_known = false;
    return project_residual(system, state.q, enough_for_velocity(state, w), w.system, w.constraint, w.damping);
  }

  /// Solves the linear system for the residual at v. On return, w.damping.solution is the correction of v. `enough` is
  /// the permitted residual. Fails if solve_damping fails.
  template <Damped S>
  static Status solve_for_correction(const S& system, double h, double enough, const State<S>& state,
                                     RattleWorkspace<S>& w) {
    Status status = solve_damping(system, h / 2, state, enough, w.system, w.constraint, w.damping);
    // A product costs about as much as a force evaluation and counts as one.
    w.counters.n_force += std::exchange(w.damping.n_products, 0);
    return status;
  }

  /// Solves the equation of `settle_velocity` by alternate evaluations of the force and projections, until v no longer
  /// changes. If the force is damping and the iteration is slow, sets w.stiff to true and returns success without a
  /// solution. Fails if the force or a projection fails, or if the iteration does not converge.
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
        w.acceleration_known = false;  // w.acceleration belongs to the velocity before the last iteration
        return {};
      }
      constexpr double slow = 0.3;
      if (Damped<S> && !(c <= slow)) {
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
};

}  // namespace pseudorigid::mechanics
