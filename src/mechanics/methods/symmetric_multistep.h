#pragma once
/// Explicit symmetric linear multistep methods with k steps for conservative systems M q̈ = f(q) + Gᵀλ with constraints
/// g(q) = 0 and G = Dg (Console, Hairer, Lubich, Numer. Math. 124 (2013) 517). With the step h they are
///
///   Σ_j α_j q_{n+j} = h² Σ_j β_j M⁻¹[f(q_{n+j}) + G(q_{n+j})ᵀ λ_{n+j}],   g(q_{n+k}) = 0,   β_0 = β_k = 0.
///
/// A step needs one force evaluation and one constraint solve for the newest multiplier λ_{n+k−1}. Let d_n = q_n −
/// q_{n−1} be the differences and a_n = M⁻¹[f + Gᵀλ]_n the accelerations. Let α̂ and β̂ be the coefficients
/// `difference` and `acceleration` of multistep_coefficients.h. The step is
///
///   d_{n+1} = Σ_i α̂_i d_{n−i} + h² Σ_i β̂_i a_{n−i},   q_{n+1} = q_n + d_{n+1}.
///
/// The sum for q is compensated, except for finite elements. The steps do not use the velocity. A starting method makes
/// the first k − 1 steps of a run and after a change of h (multistep_start.h). With the coefficients c_i, `velocity` in
/// multistep_coefficients.h, the velocity at a sample is
///
///   v_n = d_n/h + h Σ_i c_i a_{n−i},   then projected onto G v = 0.
///
/// For exact d_n and a_n, the error of v_n is of order h^{k+1}. An error of λ_n changes v only along M⁻¹G(q_n)ᵀ, and
/// the projection removes this part. The projection needs fewer iterations if a_n contains an extrapolated λ_n. The
/// energy error oscillates along a motion. After a change of h, the method starts again from a state with some energy
/// error. This error then remains, and causes a phase error that grows with time.
///
/// The order of a method here is k. For small systems the errors of energy and momenta oscillate within bounds
/// proportional to h^k. For a finite-element ball, the energy error is of the same order but grows as the motion
/// spreads to modes of high frequency (step_search.h). Order 4 was measured for such a ball at 0.8 of the stability
/// limit, in a release from a deformation of 0.3. The unit of time is r/c, with the radius r and the speed c of shear
/// waves. The relative energy error is 2e-5 at t = 100 r/c and 1e-2 at 1430 r/c. The error of the mean deformation Q at
/// 100 r/c is 1e-5. For RATTLE with the same step, this error of Q is 7e-3.
///
/// If the constraint is compliant (constrained_system.h), an energy B(g) with b = DB replaces the condition g = 0. The
/// step of order 4 then has λ_n = −b((g_{n−1} + 2g_n + g_{n+1})/4), which contains the new g_{n+1} (compliance.h). Let
/// f = −W q and b = κg, with ω² and Ω² the parts of the square of a frequency that are due to f and to b. With ζ =
/// e^{iθ} and c = cos θ, a small motion ζⁿ satisfies
///
///   4(1 − c)(c₁ − c) + (7/3)(c − c₂)[(hω)² + (hΩ)²(1 + c)/2] = 0,   c₁ = 0, c₂ = 1/7.
///
/// The left side is positive at c = 1, negative at c₂ and, for (hω)² < 3, positive at −1. So both roots c are between
/// −1 and 1, and the step is stable for every stiffness κ. The mean of g causes errors of λ of order h². They belong to
/// a change of volume, which is proportional to 1/κ. Therefore the errors of q are of order h⁴ + h²/κ. At a sample, v
/// is projected onto G v = ġ with differences of the last four g. For a stiff constraint, the roots are near −1 and c₂.
/// The differences cancel the first of them, which is that of an oscillation after a start (multistep_start.h). In
/// large motions a fast mode may resonate with a parasitic root. A pulsation of a ball with λ = 100 μ grew with 0.7 of
/// the limit of the step, but not with 0.5.
///
/// A round-off error ε of the constraint causes an error ε/h² of the multipliers. The step multiplies this error by the
/// coefficients β̂, whose largest absolute value is 5 for order 8 and 62 for order 12. The resulting error of the
/// motion grows as the square root of the number of steps. Therefore use order 8, not 12, for long runs with
/// constraints.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "mechanics/core/constraint_newton.h"
#include "mechanics/core/flatten.h"
#include "mechanics/methods/composition.h"
#include "mechanics/methods/multistep_coefficients.h"
#include "mechanics/methods/multistep_start.h"
#include "mechanics/methods/rattle.h"
#include "mechanics/methods/symmetric_multistep_workspace.h"

namespace pseudorigid::mechanics {

template <class Coefficients, template <class> class Start>
struct SymmetricMultistep {
  static constexpr int order = Coefficients::order;
  static constexpr int n_stages = 1;
  static constexpr bool symplectic = false, symmetric = true;
  static constexpr bool adaptive = false, takes_compliance = order == 4;
  static constexpr double stability_limit = Coefficients::stability_limit;
  static constexpr double resonance_limit = Coefficients::resonance_limit;
  static constexpr MultistepFormula<order> formula = multistep_formula<order>(Coefficients::a);

  template <class S>
  using Workspace = SymmetricMultistepWorkspace<S, order, Start>;
  template <class S>
  static constexpr bool fits = ConstrainedSystem<S>;

  /// Returns a failure if a force dissipates energy, if a force depends on velocity or time, or if the system has
  /// contact.
  template <ConstrainedSystem S>
  static Status accepts(const S& system) {
    if (velocity_dependent(system) || dissipative(system) || time_dependent(system))
      return Status::failure(
          "symmetric multistep methods are for conservative forces that depend on the position alone; use explicit-8");
    // Contact forces are not smooth. For affine bodies, the contact force has a closed form
    // (loads/ellipsoid_contact.h). Its second derivative jumps at the beginning and the end of a contact. For other
    // bodies, it is a sum over points (loads/contact.h). Its first derivative jumps when a point touches or leaves a
    // plane. After each jump, the velocity oscillates from step to step.
    if constexpr (requires { system.has_contact(); })
      if (system.has_contact())
        return Status::failure("symmetric multistep methods are for smooth forces, not for contact; use rattle");
    return {};
  }

  /// Makes one step. state.v is the velocity of the new state only after a call of `project_velocity`. Fails if the
  /// force or the starting method fails, or if an iteration for the constraints does not converge. For dense vectors,
  /// also fails if the result is not finite.
  template <ConstrainedSystem S>
  static Status advance(const S& system, double h, State<S>& state, Workspace<S>& w) {
    if (!same_step(h, w.h)) {
      if (Status status = restart(system, h, state, w); !status) return status;
    }
    ++w.counters.n_substeps;
    if (w.n_known < w.n_slots) return start_up(system, state, w);
    if (Status status = ensure_predicted_acceleration(system, state, w); !status) return status;
    if (Status status = make_step(system, state, w); !status) return status;
    state.t += h;
    w.acceleration_known = false;
    return {};
  }

  /// Sets state.v to the projected velocity v_n. During the first k − 1 steps, the starting method sets it. Fails if
  /// the force or the projection fails.
  template <ConstrainedSystem S>
  static Status project_velocity(const S& system, State<S>& state, Workspace<S>& w) {
    if (w.n_known < w.n_slots) return w.start.project(system, state, w);
    if (Status status = ensure_predicted_acceleration(system, state, w); !status) return status;
    state.v = w.d[w.newest];
    scale(1 / w.h, state.v);
    axpy(w.h * formula.velocity[0], w.acceleration, state.v);
    for (int i = 1; i <= w.n_slots; ++i)  // the slot of the state still has a_{n−(k−1)} instead of a_n
      axpy(w.h * formula.velocity[i], w.a[(w.newest + w.n_slots - i) % w.n_slots], state.v);
    if constexpr (takes_compliance && Compliant<S>)
      if (is_compliant(system)) return detail::project_onto_rate(system, state, w);
    return Rattle::project_velocity(system, state, w);
  }

 private:
  /// Returns true if the step sizes differ only by the round-off of the sample times.
  static bool same_step(double h, double h_before) { return std::abs(h - h_before) <= 1e-10 * std::abs(h); }

  /// Empties the history, so that the starting method makes the next k − 1 steps of size h. The first of these steps
  /// starts from the projected state, except at the start of a run. Fails if the projection fails.
  template <class S>
  static Status restart(const S& system, double h, State<S>& state, Workspace<S>& w) {
    if (w.h != 0)
      if (Status status = project_velocity(system, state, w); !status) return status;
    w.h = h;
    w.n_known = w.n_multipliers = 0;
    w.acceleration_known = false;
    w.start.begin(system, w);
    w.multipliers.fill(system.make_multiplier());
    if constexpr (takes_compliance && Compliant<S>)
      if (is_compliant(system)) return detail::record_constraint(system, state, w);
    return {};
  }

  /// Makes a step by the starting method. Stores the difference d of the step and the acceleration at the start of the
  /// step. Fails if the starting method fails.
  template <class S>
  static Status start_up(const S& system, State<S>& state, Workspace<S>& w) {
    if (Status status = w.start.acceleration(system, state, w, w.a[w.newest]); !status) return status;
    const int next = (w.newest + 1) % w.n_slots;
    auto& d = w.d[next];
    d = state.q;
    const typename S::Vector rounding = w.q_rounding;
    auto& a = w.a[w.newest];
    if (Status status = w.start.step(system, w.h, state, w); !status) return status;
    scale(-1.0, d);
    axpy(1.0, state.q, d);
    if constexpr (VectorSpace<typename S::Vector>::compensated) {
      axpy(1.0, w.q_rounding, d);
      axpy(-1.0, rounding, d);
    }
    if constexpr (takes_compliance && Compliant<S>)
      if (is_compliant(system))
        if (Status status = detail::add_start_reaction(system, state, d, w, a); !status) return status;
    w.newest = next;
    ++w.n_known;
    return {};
  }

  /// Sets w.acceleration to M⁻¹f at the state. If the system has `force_with_reaction`, sets it to M⁻¹(f + Gᵀλ) with
  /// the extrapolated λ. If an acceleration is already known, does nothing. At the end of the start, a known M⁻¹f is
  /// also valid for systems with `force_with_reaction`, because no λ is known and λ counts as 0. Fails if the force
  /// fails.
  template <class S>
  static Status ensure_predicted_acceleration(const S& system, const State<S>& state, Workspace<S>& w) {
    if constexpr (FindsForceWithReaction<S>) {
      if (w.acceleration_known) return {};
      extrapolate_multiplier<S>(w);
      Status status = system.force_with_reaction(state.t, state.q, state.v, w.multiplier, w.system, w.acceleration);
      if (!status) return status;
      system.apply_inverse_mass(w.acceleration, w.acceleration);
      ++w.counters.n_force;
      w.acceleration_known = true;
      return {};
    } else {
      return Rattle::ensure_acceleration(system, state, w);
    }
  }

  /// Computes d_{n+1} and q_{n+1} with a_n from the extrapolated multiplier. Then corrects a_n, d_{n+1} and q_{n+1}
  /// until g(q_{n+1}) = 0. Fails if the constraint or a Gram solve fails, or if the iteration for the constraint does
  /// not converge. For dense vectors, also fails if the result is not finite. All calls are inlined, so that the
  /// temporaries of small systems are in registers. In a measurement with function calls, accesses to these temporaries
  /// in memory took a sixth of the time of a step of the pseudo-rigid body.
  template <class S>
  PSEUDORIGID_FLATTEN static Status make_step(const S& system, State<S>& state, Workspace<S>& w) {
    constexpr bool dense = VectorSpace<typename S::Vector>::dense;
    auto& a = w.a[w.newest];
    a = w.acceleration;
    if constexpr (!unconstrained<S>) {
      w.q_start = state.q;
      w.constraint.direction_known = false;
      extrapolate_multiplier<S>(w);
      if constexpr (!FindsForceWithReaction<S>) {
        detail::set_reaction(system, w.q_start, w.multiplier, w.system, w.constraint);
        axpy(1.0, w.constraint.reaction, a);
      }
    }
    const int next = w.newest + 1 < w.n_slots ? w.newest + 1 : 0;
    std::conditional_t<dense, typename S::Vector, typename S::Vector&> increment = w.d[next];
    sum_history<S>(w, increment);
    add(1.0, increment, state.q, w.q_rounding);
    if constexpr (!unconstrained<S>) {
      // The factor between a change of q_{n+1} and the change of a_n, and between δ and the change of λ_n.
      const double per_shift = 1 / (w.h * w.h * formula.acceleration[0]);
      const auto apply = [&] {
        add(1.0, w.constraint.reaction, state.q, w.q_rounding);
        axpy(1.0, w.constraint.reaction, increment);
        axpy(per_shift, w.constraint.reaction, a);
        axpy(per_shift, w.constraint.delta, w.multiplier);
        ++w.counters.n_position_iterations;
      };
      if (Status status = correct(system, state, per_shift, w, apply); !status) return status;
      record_multiplier<S>(w);
    }
    if constexpr (dense) {
      if (!std::isfinite(increment.squaredNorm())) return Status::failure("the force is not finite");
      w.d[next] = increment;
    }
    w.newest = next;
    return {};
  }

  /// Corrects q_{n+1} by `apply` until g(q_{n+1}) = 0 or, if the constraint is compliant, until λ_n = −b. Fails if the
  /// constraint or a Gram solve fails, or if the iteration does not converge.
  template <class S, class Apply>
  static Status correct(const S& system, const State<S>& state, double per_delta, Workspace<S>& w, Apply&& apply) {
    if constexpr (takes_compliance && Compliant<S>)
      if (is_compliant(system)) {
        const auto& g = w.constraints.g;
        const auto find_mean = [&] {
          w.compliance.mean = w.compliance.g_end;
          axpy(2.0, g[0], w.compliance.mean);
          axpy(1.0, g[1], w.compliance.mean);
          scale(0.25, w.compliance.mean);
        };
        Status status =
            detail::meet_compliance(system, w.h, 0.25, per_delta, state.q, w.multiplier, w, find_mean, apply);
        if (status) w.constraints.record(w.compliance.g_end);
        return status;
      }
    Status status = detail::meet_position_constraint(system, w.constraint_tolerance, state.q, w.q_start, w.system,
                                                     w.constraint, apply, foregone(system, w));
    w.counters.n_gram_iterations += std::exchange(w.constraint.n_gram_iterations, 0);
    return status;
  }

  /// Returns the residual |g| below which the iteration ends after one more correction, without evaluating g again. For
  /// a fixed number of constraints, Gram solves are exact. A Newton iteration then replaces the residual by its square
  /// times the curvature of g. The factor 1e-4 permits curvatures up to 10⁴. For a dynamic number of constraints, the
  /// result is 0, so that every residual is evaluated.
  template <class S>
  static double foregone(const S&, const Workspace<S>& w) {
    return S::n_constraints == dynamic_constraints ? 0 : std::sqrt(1e-4 * w.constraint_tolerance);
  }

  /// Sets `sum` to Σ_i α̂_i d_{n−i} + h² Σ_i β̂_i a_{n−i}. `sum` may be the vector of the oldest d_{n−i}.
  template <class S>
  static void sum_history(Workspace<S>& w, typename S::Vector& sum) {
    const auto slot = [&](int i) { return w.newest >= i ? w.newest - i : w.newest - i + w.n_slots; };
    if constexpr (VectorSpace<typename S::Vector>::dense) {  // newest terms last, because they are known last
      sum = w.d[slot(w.n_slots - 1)];
      scale(formula.difference[w.n_slots - 1], sum);
      axpy(w.h * w.h * formula.acceleration[w.n_slots - 1], w.a[slot(w.n_slots - 1)], sum);
      for (int i = w.n_slots - 2; i >= 0; --i) {
        const double of_d = formula.difference[i], of_a = w.h * w.h * formula.acceleration[i];
        if constexpr (requires { VectorSpace<typename S::Vector>::add_both(of_d, sum, of_a, sum, sum); }) {
          VectorSpace<typename S::Vector>::add_both(of_d, w.d[slot(i)], of_a, w.a[slot(i)], sum);
        } else {
          const double* d = w.d[slot(i)].data();
          const double* a = w.a[slot(i)].data();
          for (Eigen::Index k = 0; k < sum.size(); ++k) sum.data()[k] += of_d * d[k] + of_a * a[k];
        }
      }
    } else {  // computes all terms in one pass over the memory
      std::array<const double*, Workspace<S>::n_slots> d, a;
      for (int i = 0; i < w.n_slots; ++i) {
        d[i] = local_values(w.d[slot(i)]).data();
        a[i] = local_values(w.a[slot(i)]).data();
      }
      const auto values = local_values(sum);
      const double h2 = w.h * w.h;
      for (std::size_t k = 0; k < values.size(); ++k) {
        double of_d = 0, of_a = 0;
        for (int i = 0; i < w.n_slots; ++i) {
          of_d += formula.difference[i] * d[i][k];
          of_a += formula.acceleration[i] * a[i][k];
        }
        values[k] = of_d + h2 * of_a;
      }
    }
  }

  /// Sets w.multiplier to λ_n, extrapolated by the polynomial through the last n_multipliers multipliers.
  template <class S>
  static void extrapolate_multiplier(Workspace<S>& w) {
    constexpr double weights[7][6]{
        {}, {1}, {2, -1}, {3, -3, 1}, {4, -6, 4, -1}, {5, -10, 10, -5, 1}, {6, -15, 20, -15, 6, -1}};
    constexpr int n = Workspace<S>::n_extrapolated;
    if (w.n_multipliers == n)  // the usual case, with a constant number of terms, so that the compiler unrolls the sum
      sum_multipliers<S>(w, weights[n], n);
    else
      sum_multipliers<S>(w, weights[w.n_multipliers], w.n_multipliers);
  }
  /// Sets w.multiplier to the sum of the last n multipliers with the weights. If n is 0, sets w.multiplier to the
  /// latest entry of the ring, which is then zero.
  template <class S>
  [[gnu::always_inline]] static void sum_multipliers(Workspace<S>& w, const double* weights, int n) {
    const auto before = [&w](int i) -> const typename S::Multiplier& {
      const int slot = w.newest_multiplier - i;
      return w.multipliers[slot >= 0 ? slot : slot + Workspace<S>::n_extrapolated];
    };
    w.multiplier = before(0);
    if (n == 0) return;
    scale(weights[0], w.multiplier);
    for (int i = 1; i < n; ++i) axpy(weights[i], before(i), w.multiplier);
  }
  /// Stores w.multiplier as the latest entry of the ring.
  template <class S>
  static void record_multiplier(Workspace<S>& w) {
    constexpr int n = Workspace<S>::n_extrapolated;
    w.newest_multiplier = w.newest_multiplier + 1 < n ? w.newest_multiplier + 1 : 0;
    w.multipliers[w.newest_multiplier] = w.multiplier;
    const int most = w.constraints.is_used ? 3 : n;  // a fast oscillation makes more multipliers a worse guess
    w.n_multipliers = std::min(w.n_multipliers + 1, most);
  }
};

struct Symmetric4 : SymmetricMultistep<Symmetric4Coefficients, CompositionStart<Rattle4>::Of> {
  static constexpr bool chosen_by_auto = true, takes_any_vector = true;
  static constexpr const char* name = "symmetric-4";
  static constexpr const char* documentation =
      "explicit symmetric multistep method of order 4, one force a step, for conservative forces; not symplectic: "
      "energy and momenta are kept to the error of the step";
};
struct Symmetric8 : SymmetricMultistep<Symmetric8Coefficients, ExplicitStart> {
  static constexpr bool chosen_by_auto = false;
  static constexpr const char* name = "symmetric-8";
  static constexpr const char* documentation =
      "explicit symmetric multistep method of order 8, one force a step, for conservative forces; not symplectic: "
      "energy and momenta are kept to the error of the step";
};
struct Symmetric12 : SymmetricMultistep<Symmetric12Coefficients, ExplicitStart> {
  static constexpr bool chosen_by_auto = false;
  static constexpr const char* name = "symmetric-12";
  static constexpr const char* documentation =
      "explicit symmetric multistep method of order 12, one force a step, for conservative forces; not symplectic: "
      "energy and momenta are kept to the error of the step";
};

}  // namespace pseudorigid::mechanics
