#pragma once
/// The method energy-momentum: a step of any size conserves energy, momenta and constraints up to round-off. The method
/// uses the discrete gradients of O. Gonzalez (J. Nonlinear Sci. 6 (1996) 449), with constraints as in Physica D 132
/// (1999) 165. The step also satisfies the constraint of the velocity. With X = (q, p) and p = M v, Hamilton's function
/// is H = K(p) + V(q), and the force is f = −∇V. The constraints are g(q) = 0 and, for their rates, γ(X) = G(q) M⁻¹p =
/// 0 with G = Dg. Δ denotes a change in a step. A step of size h from X₀ to X₁ is
///
///   ΔX = h 𝒥 ∇̄F,   F = H − λ·g + μ·γ,   g(q₁) = 0,   γ(q₁, p₁) = 0,   X_m = (X₀ + X₁)/2,
///   ∇̄F = ∇F(X_m) + C,   C = ΠD + θMP,   θ = [ΔF − (∇F(X_m) + ΠD)·ΔX]/(P·MP),   P = Π ΔX,
///   D = ½[∇F(X₁ − P/2) + ∇F(X₀ + P/2)] − ∇F(X_m),
///
/// with the discrete gradient ∇̄F, the canonical antisymmetric matrix 𝒥 and multipliers λ, μ. The projection Π acts on
/// vectors and on covectors in the coordinates (q, v). Π removes their components in the tangent space of the orbit of
/// the symmetries at X_m (orbit_complement.h). In these coordinates, ∇F = (−A, M v + B) at X_m and C = (C_q, C_v). The
/// step is then
///
///   A = f(q_m) + G(q_m)ᵀλ − D²g(q_m)(v_m, ·)ᵀμ,   B = G(q_m)ᵀμ,
///   Δv = h M⁻¹(A − C_q),   Δq = h [v_m + M⁻¹(B + C_v)].
///
/// - ∇̄F·ΔX = ΔF and 𝒥 is antisymmetric, so ΔF = 0. If g = γ = 0 at both ends, ΔH = 0. K is quadratic, so D does not
/// contain K.
///
/// - A momentum J is bilinear in (q, p), so ΔJ = ∇J(X_m)·ΔX = −h ∇̄F·(𝒥∇J)(X_m). The vector 𝒥∇J(X_m) is tangent to the
/// orbit. The invariants H, g, γ are constant on the orbit and C is orthogonal to the orbit, so ΔJ = 0.
///
/// - The step is symmetric and of order 2: C = O(h²), μ = O(h²).
///
/// - D is needed near relative equilibria, which are motions along the orbit with P = 0. X_m is the middle of a chord
/// of the motion, so ∇F(X_m) differs from ∇F on the motion by O(h²). Without D, θP would have to correct this
/// difference, but θP has no limit as P → 0. If the symmetries are one group of rotations or translations, a Cayley
/// transform of this group maps X₁ − P/2 to X₀ + P/2. The same holds if a body has the rotations of space and of the
/// reference body, and both have the same axis. In these cases θP is O(h|P|). Near a steady motion with two different
/// axes θP is O(h²), and the iteration may need smaller steps.
///
/// Round-off. Let ν be the round-off of V. Then θP has the error ν/|P|. A step corrects only the part of the energy
/// error that exceeds ν. The remainder is added to the energy error of the next step, so the total error remains about
/// ν. The round-off of V is measured at every step, because terms of V cancel differently after a rotation of the body.
/// A correction of pure round-off is harmless if it changes P by less than the fraction 10⁻⁴ in a step. If the largest
/// ν so far is harmless, the step uses the first ν, otherwise the largest ν so far. A relative equilibrium is a
/// critical point of H among the states with the same momenta. If |P| ≤ 10⁻⁷|ΔX|, the energy is therefore right to
/// round-off without θ, and the step sets θ = 0. The round-off of the momenta is corrected as well (momentum_keeper.h).
///
/// A Gauss–Seidel iteration on (Δv, Δq) solves the step. Each iteration makes the corrections
///
///   h G(q₁)M⁻¹G(q_m)ᵀ δλ = −γ(q₁, v₁),   G(q₁)M⁻¹G(q_m)ᵀ (h δμ + (h²/2) δλ) = −g(q₁)
///
/// to the multipliers, with the corresponding changes of Δv and Δq. The iteration ends when the increments of Δv and Δq
/// are round-off. The last iterations do not change θ and then C, because new values would contain other rounding
/// errors. Each iteration multiplies the error of an oscillation of frequency ω by (hω/2)².

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "mechanics/core/conservative_system.h"
#include "mechanics/core/orbiting_system.h"
#include "mechanics/core/second_order_field.h"
#include "mechanics/methods/energy_momentum_workspace.h"
#include "mechanics/methods/fixed_point_monitor.h"
#include "mechanics/methods/rattle.h"

namespace pseudorigid::mechanics {

namespace detail {

/// Returns the product λ·r of a multiplier and a residual. Both are numbers if there is a single constraint.
inline double pairing(double lambda, double r) { return lambda * r; }
template <class Multiplier>
double pairing(const Multiplier& lambda, const Multiplier& r) {
  return dot(lambda, r);
}

}  // namespace detail

struct EnergyMomentum {
  static constexpr const char* name = "energy-momentum";
  static constexpr const char* documentation =
      "keeps energy, momenta and constraints exactly (equivariant discrete gradients), order 2, implicit";
  static constexpr int order = 2;
  static constexpr int n_stages = 1;
  static constexpr bool symplectic = false, symmetric = true;
  static constexpr bool adaptive = false, chosen_by_auto = false, takes_any_vector = true;
  /// Largest hω that a search tries, with the frequency ω of an oscillation. The iteration converges for hω < 2, and
  /// its increments decrease by the factor (hω/2)². At hω = 1.6 the harmonic oscillator needs about 80 of the 150
  /// permitted iterations. The step itself is stable for all hω.
  static constexpr double stability_limit = 1.6;

  template <class S>
  using Workspace = EnergyMomentumWorkspace<S>;
  template <class S>
  static constexpr bool fits = ConservativeSystem<S>;

  /// Returns a failure if a force dissipates energy or depends on velocity or time, because the energy would then not
  /// be constant in general. Also returns a failure for companions, which V and K do not contain.
  template <ConservativeSystem S>
  static Status accepts(const S& system) {
    if (dissipative(system) || velocity_dependent(system) || time_dependent(system))
      return Status::failure(
          "energy-momentum keeps the energy constant, which forces that dissipate, depend on the velocity or depend on "
          "time do not do; use rattle or explicit-8");
    if (has_companions(system))
      return Status::failure("energy-momentum does not move companions in orbit; use rattle or explicit-8");
    return {};
  }

  /// Makes one step of size h. Fails if the force, the constraint or a Gram solve fails, or if the iteration does not
  /// converge. A failed step leaves the state unchanged.
  template <ConservativeSystem S>
  static Status advance(const S& system, double h, State<S>& state, EnergyMomentumWorkspace<S>& w) {
    using Verdict = detail::ConvergenceMonitor::Verdict;
    w.V_start = system.potential_energy(state.q);
    w.momenta.begin(system, state);
    const double noise = noise_of_potential(system, state.q);
    if (w.first_noise < 0) w.first_noise = noise;
    w.largest_noise = std::max(w.largest_noise, noise);
    predict(h, state, w);
    detail::FixedPointMonitor monitor;
    for (Verdict verdict = Verdict::go_on; verdict != Verdict::done;) {
      w.dq_before = w.dq;
      w.dv_before = w.dv;
      if (Status status = improve(system, h, state, w); !status) return status;
      if (Status status = constrain(system, h, state, w); !status) return status;
      ++w.counters.n_position_iterations;

      axpy(-1.0, w.dq, w.dq_before);
      axpy(-1.0, w.dv, w.dv_before);
      const double increment = std::max(max_norm(w.dq_before), max_norm(w.dv_before));
      const double step = std::max(max_norm(w.dq), max_norm(w.dv));
      // The first iterations compute θ and C anew. When round-off stops the decrease of the increments, θ is no longer
      // changed. When the increments are small, or stop decreasing again, C is no longer changed either.
      const bool stalled = monitor.stalled(increment, 1e-6 * step);
      // An increment of Δq of one unit of round-off changes Δv by up to 2/h of it. If the step has stiff oscillations,
      // the increments of Δv can decrease no further.
      if (w.hold == 2 && stalled && increment <= 120 * epsilon * max_norm(w.q_end) / std::abs(h)) break;
      if (w.hold < 2 && (stalled || increment <= 1e-14 * step)) {
        w.hold = increment <= 1e-14 * step ? 2 : w.hold + 1;
        monitor.start_again();
      }
      verdict = monitor.judge(increment, 4 * epsilon * std::max(max_norm(w.q_end), max_norm(w.v_end)));
      if (verdict == Verdict::stuck) return does_not_converge(increment);
    }
    accept(system, h, state, w);
    return {};
  }

  /// Does nothing, because the velocity satisfies G v = 0 after every step.
  template <ConservativeSystem S>
  static Status project_velocity(const S&, State<S>&, EnergyMomentumWorkspace<S>&) {
    return {};
  }

 private:
  static constexpr double epsilon = std::numeric_limits<double>::epsilon();
  /// The ratio |P|/|ΔX| below which the motion counts as a relative equilibrium.
  static constexpr double relative_equilibrium = 1e-7;
  /// Largest |hθ| for which a correction of pure round-off is harmless. Such a correction changes P by at most this
  /// fraction.
  static constexpr double harmless = 1e-4;

  static Status does_not_converge(double increment) {
    return Status::failure(std::string("the iteration of the conserving step ") +
                           (std::isfinite(increment) ? "does not converge" : "has left the range of numbers") +
                           "; use a smaller step");
  }

  /// Estimates the round-off of V at q by the largest change of V among five fixed small changes of q. Change k adds
  /// (7i + 3k) mod 5 − 2 units to entry i = 1, 2, … of q, and a unit is 2ε max|q_i|. Terms of V may be larger than V
  /// and cancel. The round-off of these terms is therefore estimated better by changes of q than by ε|V|.
  template <ConservativeSystem S>
  static double noise_of_potential(const S& system, const typename S::Vector& q) {
    const double V = system.potential_energy(q), unit = 2 * epsilon * max_norm(q);
    double noise = 0;
    for (int k = 1; k <= 5; ++k) {
      typename S::Vector near = q;
      int i = 0;
      for (double& x : local_values(near)) x += unit * ((7 * ++i + 3 * k) % 5 - 2);  // −2 … 2 units
      noise = std::max(noise, std::abs(system.potential_energy(near) - V));
    }
    return noise;
  }

  /// Sets the initial guess of the iteration: ΔX from the acceleration of the last step, λ by extrapolation, and μ = 0.
  /// In the first step of a run, the acceleration is taken as 0.
  template <ConservativeSystem S>
  static void predict(double h, const State<S>& state, EnergyMomentumWorkspace<S>& w) {
    w.dv = w.acceleration;
    scale(h, w.dv);
    w.dq = state.v;
    axpy(0.5, w.dv, w.dq);
    scale(h, w.dq);
    w.history.guess(state.t + h / 2, w.lambda);
    scale(0.0, w.mu);
    w.hold = 0;
    set_end(state, w);
  }

  /// Sets (q₁, v₁) to the state plus (Δq, Δv).
  template <ConservativeSystem S>
  static void set_end(const State<S>& state, EnergyMomentumWorkspace<S>& w) {
    w.q_end = state.q;
    w.v_end = state.v;
    axpy(1.0, w.dq, w.q_end);
    axpy(1.0, w.dv, w.v_end);
  }

  /// Computes new Δv and Δq, and the new end of the step, from the Δv, Δq, λ and μ of the previous iteration. Fails if
  /// a force or the constraint fails.
  template <ConservativeSystem S>
  static Status improve(const S& system, double h, const State<S>& state, EnergyMomentumWorkspace<S>& w) {
    w.q_middle = state.q;
    w.v_middle = state.v;
    axpy(0.5, w.dq, w.q_middle);
    axpy(0.5, w.dv, w.v_middle);
    scale(0.0, w.A);
    scale(0.0, w.B);
    if (Status status = add_gradient(system, 1.0, state.t + h / 2, w.q_middle, w.v_middle, w, w.A, w.B); !status)
      return status;
    if (w.hold < 2)
      if (Status status = correct(system, h, state.t + h / 2, w); !status) return status;

    axpy(-1.0, w.C_q, w.A);
    axpy(1.0, w.C_v, w.B);
    system.apply_inverse_mass(w.A, w.A);
    system.apply_inverse_mass(w.B, w.B);
    w.dv = w.A;
    scale(h, w.dv);
    w.dq = state.v;
    axpy(0.5, w.dv, w.dq);
    axpy(1.0, w.B, w.dq);
    scale(h, w.dq);
    set_end(state, w);
    return {};
  }

  /// Adds a [f(q) + G(q)ᵀλ − D²g(q)(v, ·)ᵀμ] to A, and a G(q)ᵀμ to B. With a = 1, and A = B = 0 before the call, the
  /// pair (−A, B) is ∇F without the term M v. Fails if the force fails.
  template <ConservativeSystem S>
  static Status add_gradient(const S& system, double a, double t, const typename S::Vector& q,
                             const typename S::Vector& v, EnergyMomentumWorkspace<S>& w, typename S::Vector& A,
                             typename S::Vector& B) {
    if (Status status = system.force(t, q, v, w.system, w.force); !status) return status;
    ++w.counters.n_force;
    if constexpr (!unconstrained<S>) {
      system.add_reaction(q, w.lambda, w.force);
      w.delta = w.mu;
      scale(-1.0, w.delta);
      system.add_reaction_rate(q, v, w.delta, w.force);
      scale(-a, w.delta);
      system.add_reaction(q, w.delta, B);
    }
    axpy(a, w.force, A);
    return {};
  }

  /// Sets C = Π D + θ M P, with D = 0 if the system has no symmetries. Computes P from ΔX, and θ if w.hold is 0.
  /// Otherwise θ does not change. On entry, w.A and w.B are the results of add_gradient at X_m. Fails if a force or the
  /// constraint fails.
  template <ConservativeSystem S>
  static Status correct(const S& system, double h, double t, EnergyMomentumWorkspace<S>& w) {
    w.P_q = w.dq;
    w.P_v = w.dv;
    w.orbit.set(system, w.q_middle, w.v_middle);
    const double P = w.orbit.project(system, w.P_q, w.P_v);
    scale(0.0, w.C_q);
    scale(0.0, w.C_v);
    if (system.n_symmetries() > 0) {
      for (const double side : {-0.5, 0.5}) {
        w.q_side = w.q_middle;
        w.v_side = w.v_middle;
        axpy(side, w.dq, w.q_side);
        axpy(-side, w.P_q, w.q_side);
        axpy(side, w.dv, w.v_side);
        axpy(-side, w.P_v, w.v_side);
        if (Status status = add_gradient(system, 0.5, t, w.q_side, w.v_side, w, w.C_q, w.C_v); !status) return status;
      }
      axpy(-1.0, w.A, w.C_q);
      scale(-1.0, w.C_q);
      axpy(-1.0, w.B, w.C_v);
      w.orbit.project_covector(w.C_q, w.C_v);
    }
    if (w.hold == 0)
      if (Status status = set_theta(system, h, P, w); !status) return status;
    system.apply_mass(w.P_q, w.q_side);
    system.apply_mass(w.P_v, w.v_side);
    axpy(w.theta, w.q_side, w.C_q);
    axpy(w.theta, w.v_side, w.C_v);
    return {};
  }

  /// Sets θ from the part of the energy error that exceeds ν. P is the norm |P|. Sets θ = 0 near a relative
  /// equilibrium. Fails if the constraint fails. The energy error is ΔF − (∇F(X_m) + ΠD)·ΔX plus a bounded part of the
  /// error of earlier steps. The covectors ∇F(X_m) and ΠD vanish on the tangent space of the orbit, so their products
  /// with ΔX and with P are equal.
  template <ConservativeSystem S>
  static Status set_theta(const S& system, double h, double P, EnergyMomentumWorkspace<S>& w) {
    w.theta = 0;
    if (P <= relative_equilibrium * w.orbit.norm(system, w.dq, w.dv)) return {};
    const double V_end = system.potential_energy(w.q_end);
    const double work = dot(w.A, w.P_q) - dot(w.B, w.P_v) - dot(w.C_q, w.P_q) - dot(w.C_v, w.P_v);
    const double limit = 0.01 * P * P / std::abs(h);
    double gain = V_end - w.V_start + work + std::clamp(w.energy_gained, -limit, limit);
    if constexpr (!unconstrained<S>) {  // −λ·Δg + μ·Δγ, which is not yet zero during the iteration
      if (Status status = system.constraint(w.q_end, w.residual); !status) return status;
      gain -= detail::pairing(w.lambda, w.residual);
      system.constraint_rate(w.q_end, w.v_end, w.residual);
      gain += detail::pairing(w.mu, w.residual);
    }
    const double noise = w.largest_noise < harmless * P * P / std::abs(h) ? w.first_noise : w.largest_noise;
    const double nu = 2 * noise + 2 * epsilon * (std::abs(w.V_start) + std::abs(V_end) + std::abs(work));
    w.theta = std::copysign(std::max(std::abs(gain) - nu, 0.0), gain) / (P * P);
    return {};
  }

  /// Corrects (q₁, v₁), λ and μ such that g(q₁) = 0 and γ(q₁, v₁) = 0 to first order. The reactions act at q_m. Does
  /// nothing without constraints. Fails if the constraint or a Gram solve fails.
  template <ConservativeSystem S>
  static Status constrain(const S& system, double h, const State<S>& state, EnergyMomentumWorkspace<S>& w) {
    if constexpr (!unconstrained<S>) {
      if (Status status = system.constraint(w.q_end, w.residual); !status) return status;
      if (Status status = react(system, w); !status) return status;
      axpy(1.0, w.B, w.dq);
      axpy(1 / h, w.delta, w.mu);
      set_end(state, w);

      system.constraint_rate(w.q_end, w.v_end, w.residual);
      if (Status status = react(system, w); !status) return status;
      axpy(1.0, w.B, w.dv);
      axpy(1 / h, w.delta, w.lambda);
      axpy(-0.5, w.delta, w.mu);
      set_end(state, w);
    }
    return {};
  }

  /// Sets w.delta to the solution δ of G(q₁)M⁻¹G(q_m)ᵀ δ = −w.residual, and w.B to M⁻¹G(q_m)ᵀ δ. Changes w.residual.
  /// Fails if the Gram solve fails.
  template <ConservativeSystem S>
  static Status react(const S& system, EnergyMomentumWorkspace<S>& w) {
    scale(-1.0, w.residual);
    SolveReport report = system.solve_gram(w.q_end, w.q_middle, w.residual, w.system, w.delta);
    w.counters.n_gram_iterations += report.iterations;
    if (!report.status) return std::move(report.status);
    scale(0.0, w.B);
    system.add_reaction(w.q_middle, w.delta, w.B);
    system.apply_inverse_mass(w.B, w.B);
    return {};
  }

  /// Adds (Δq, Δv) to the state, and advances the time by h. Restores the momenta. Adds the energy error of the step to
  /// w.energy_gained. Stores the acceleration and the multipliers for the guess of the next step.
  template <ConservativeSystem S>
  static void accept(const S& system, double h, State<S>& state, EnergyMomentumWorkspace<S>& w) {
    const double K_start = system.kinetic_energy(state.v);
    add(1.0, w.dq, state.q, w.q_rounding);
    add(1.0, w.dv, state.v, w.v_rounding);
    w.momenta.keep(system, state, w.v_rounding);
    w.energy_gained += (system.potential_energy(state.q) - w.V_start) + (system.kinetic_energy(state.v) - K_start);
    w.acceleration = w.dv;
    scale(1 / h, w.acceleration);
    w.history.record(state.t + h / 2, w.lambda);
    state.t += h;
    ++w.counters.n_substeps;
  }
};

}  // namespace pseudorigid::mechanics
