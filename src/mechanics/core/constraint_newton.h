#pragma once
/// Newton's iteration that changes q or v by constraint reactions until a constraint holds. The constraint is g(q) = 0
/// with the derivative G = Dg, and the mass is M. The reactions act at the fixed configuration q₀. For positions, the
/// unknown is x = q, the residual is r = g(q), and q₁ is the present q. For velocities, the unknown is x = v, the
/// residual is r = G(q) v, and q₁ = q₀ = q. The iteration repeats
///
///   G(q₁) M⁻¹ G(q₀)ᵀ δ = −r,   x ← x + M⁻¹G(q₀)ᵀ δ,
///
/// until |r| ≤ tolerance, or until r is round-off. The round-off of G(q) v grows with |G||v|, and the round-off of g(q)
/// with |G||q|. Therefore no constant bounds the round-off for all motions. A residual that stops decreasing is
/// compared with its noise, which is measured. The noise is the largest change of r if q and v change by units in their
/// last place (rounding_noise.h).

#include <cmath>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "mechanics/core/constrained_system.h"
#include "mechanics/core/rounding_noise.h"

namespace pseudorigid::mechanics::detail {

inline constexpr int max_constraint_iterations = 30;

/// A residual up to this multiple of its noise counts as round-off. The noise is the largest of a few changes of the
/// residual, but a residual may contain the sum of several errors. The factor was chosen from 4.3·10⁷ residuals that
/// had stopped decreasing, for bodies with semi-axes 10⁻⁴ … 10⁴. Among them, 99.97 % were below 3 times the noise.
/// Three residuals were 16 to 18.7 times the noise. The iteration continues for such residuals.
inline constexpr double noise_reserve = 16;

/// Decides after each iteration, from the norm of the residual, if the iteration is done, goes on, or is stuck. It is
/// done if the residual is at most `tolerance`. It is also done if the residual did not halve and is at most
/// `round_off` or noise_reserve · noise(). It is stuck if the residual is not finite, grows at least tenfold, or is not
/// small enough after max_constraint_iterations. noise() costs several evaluations of the constraint. It is called only
/// for a residual above `round_off` that did not halve.
struct ConvergenceMonitor {
  double tolerance, round_off, previous = HUGE_VAL;
  int iteration = 0;
  enum class Verdict { done, go_on, stuck };

  template <class Noise>
  Verdict judge(double residual, Noise&& noise) {
    if (residual <= tolerance) return Verdict::done;
    const bool falling = residual < 0.5 * previous;
    if (!falling && std::isfinite(residual) && (residual <= round_off || residual <= noise_reserve * noise()))
      return Verdict::done;
    // A residual may grow at first if Newton's iteration starts far from the solution. Comparisons with NaN are false,
    // so a NaN counts as stuck.
    if (!(residual < 10 * previous) || ++iteration > max_constraint_iterations) return Verdict::stuck;
    previous = residual;
    return Verdict::go_on;
  }
};

/// True if the multiplier is a single number. All reactions are then multiples of one vector M⁻¹G(q₀)ᵀ, and the Gram
/// matrix is a number.
template <class S>
inline constexpr bool single_constraint = std::is_same_v<typename S::Multiplier, double>;

template <ConstrainedSystem S>
struct ConstraintTemporaries {
  explicit ConstraintTemporaries(const S& system)
      : reaction(system.make_vector()),
        direction(single_constraint<S> ? system.make_vector() : typename S::Vector{}),
        residual(system.make_multiplier()),
        delta(system.make_multiplier()) {}

  typename S::Vector reaction;   // M⁻¹G(q₀)ᵀδ
  typename S::Vector direction;  // M⁻¹G(q₀)ᵀ, used only for a single constraint
  typename S::Multiplier residual, delta;
  bool direction_known = false;  // true if `direction` belongs to q₀; set this flag to false if you change q₀
  long n_gram_iterations = 0;
};

/// Sets w.reaction to M⁻¹G(q₀)ᵀ λ, by a faster function of the system if there is one. For a single constraint this is
/// `reaction_of_one(q, f)`, which sets f = G(q)ᵀ. Otherwise it is an `add_reaction` with the workspace as a further
/// argument, which contains quantities at q₀.
template <ConstrainedSystem S>
void set_reaction(const S& system, const typename S::Vector& q0, const typename S::Multiplier& lambda,
                  [[maybe_unused]] typename S::Workspace& system_workspace, ConstraintTemporaries<S>& w) {
  if constexpr (single_constraint<S>) {
    if (!w.direction_known) {
      if constexpr (requires { system.reaction_of_one(q0, w.direction); }) {
        system.reaction_of_one(q0, w.direction);
      } else {
        scale(0.0, w.direction);
        system.add_reaction(q0, 1.0, w.direction);
      }
      system.apply_inverse_mass(w.direction, w.direction);
      w.direction_known = true;
    }
    w.reaction = lambda * w.direction;
  } else {
    scale(0.0, w.reaction);
    if constexpr (requires { system.add_reaction(q0, lambda, w.reaction, system_workspace); })
      system.add_reaction(q0, lambda, w.reaction, system_workspace);
    else
      system.add_reaction(q0, lambda, w.reaction);
    system.apply_inverse_mass(w.reaction, w.reaction);
  }
}

/// Solves G(q₁) M⁻¹ G(q₀)ᵀ δ = −w.residual, and sets w.delta = δ and w.reaction = M⁻¹G(q₀)ᵀ δ. Changes the
/// sign of w.residual, and adds the iterations of the Gram solve to w.n_gram_iterations. Fails if the Gram solve fails.
/// For a single constraint the solve is a division, which does not fail.
template <ConstrainedSystem S>
Status react(const S& system, const typename S::Vector& q1, const typename S::Vector& q0,
             typename S::Workspace& system_workspace, ConstraintTemporaries<S>& w) {
  scale(-1.0, w.residual);
  if constexpr (single_constraint<S>) {
    set_reaction(system, q0, 1.0, system_workspace, w);
    system.constraint_rate(q1, w.direction, w.delta);
    w.delta = w.residual * (1 / w.delta);  // the processor can compute the quotient before it has the residual
  } else {
    SolveReport report = system.solve_gram(q1, q0, w.residual, system_workspace, w.delta);
    w.n_gram_iterations += report.iterations;
    if (!report.status) return std::move(report.status);
  }
  set_reaction(system, q0, w.delta, system_workspace, w);
  return {};
}

/// Returns the failure of an iteration that does not converge. `what` is "position" or "velocity". The function is not
/// inlined, so that the loop of the iteration does not contain the code for the message.
[[gnu::cold, gnu::noinline]] inline Status without_convergence(std::string_view what) {
  std::string sentence = "the ";
  sentence += what;
  sentence += " iteration of the constraint does not converge; use a smaller step";
  return Status::failure(std::move(sentence));
}

/// Permits an iterative solver of Gram systems to stop at a residual of `enough`/3. If `enough` is 0, the solver uses
/// its default. A workspace without the member `residual_sought` belongs to a direct solver. The function then does
/// nothing.
template <ConstrainedSystem S>
void seek_residual(typename S::Workspace& system_workspace, double enough) {
  constexpr double linear_part = 1.0 / 3;  // the other two thirds are for the error of the linearisation
  if constexpr (requires { system_workspace.residual_sought; }) system_workspace.residual_sought = linear_part * enough;
}

/// Runs Newton's iteration of this header for x. `evaluate` sets w.residual to r and returns a Status; `apply` adds
/// w.reaction to x. `what` names x in messages, and `noise` returns the noise of r. Fails if `evaluate` or a Gram solve
/// fails, or if the iteration is stuck. With tolerance 0 the iteration continues until the residual is round-off. If a
/// residual is at most `foregone`, the iteration ends after its correction, without evaluating the new residual. Set
/// w.direction_known to false before the call if q₀ has changed since the last call.
template <ConstrainedSystem S, class Evaluate, class Apply, class Noise>
Status meet_constraint(const S& system, const char* what, double tolerance, const typename S::Vector& q1,
                       const typename S::Vector& q0, typename S::Workspace& system_workspace,
                       ConstraintTemporaries<S>& w, Evaluate&& evaluate, Apply&& apply, Noise&& noise,
                       double foregone = 0) {
  // A residual that no longer halves counts as round-off up to 1000 times the constraint tolerance of the system.
  ConvergenceMonitor monitor{tolerance, 1000 * system.constraint_tolerance()};
  for (;;) {
    if (Status status = evaluate(); !status) return status;
    const double norm = max_norm(w.residual);
    const auto verdict = monitor.judge(norm, noise);
    if (verdict == ConvergenceMonitor::Verdict::done) return {};
    if (verdict == ConvergenceMonitor::Verdict::stuck) return without_convergence(what);
    seek_residual<S>(system_workspace, tolerance);
    Status status = react(system, q1, q0, system_workspace, w);
    seek_residual<S>(system_workspace, 0);
    if (!status) return status;
    apply();
    if (norm <= foregone) return {};
  }
}

/// Solves G(q) v = 0 for v; `apply` adds w.reaction to v. Fails if a Gram solve fails or the iteration is stuck.
template <ConstrainedSystem S, class Apply>
Status meet_velocity_constraint(const S& system, double tolerance, const typename S::Vector& q,
                                const typename S::Vector& v, typename S::Workspace& system_workspace,
                                ConstraintTemporaries<S>& w, Apply&& apply) {
  const auto evaluate = [&] {
    system.constraint_rate(q, v, w.residual);
    return Status();
  };
  return meet_constraint(system, "velocity", tolerance, q, q, system_workspace, w, evaluate, apply,
                         [&] { return noise_of_rate(system, q, v); });
}

/// Solves g(q) = 0 for q; `apply` adds w.reaction to q. The reactions act at q₀. Fails if the constraint cannot be
/// evaluated, a Gram solve fails, or the iteration is stuck. `foregone` has the same meaning as in meet_constraint.
template <ConstrainedSystem S, class Apply>
Status meet_position_constraint(const S& system, double tolerance, const typename S::Vector& q,
                                const typename S::Vector& q0, typename S::Workspace& system_workspace,
                                ConstraintTemporaries<S>& w, Apply&& apply, double foregone = 0) {
  return meet_constraint(
      system, "position", tolerance, q, q0, system_workspace, w, [&] { return system.constraint(q, w.residual); },
      apply, [&] { return noise_of_constraint(system, q); }, foregone);
}

/// Solves g(q + q_rounding) = 0 if the system has this constraint (`resolves_rounding` in constrained_system.h),
/// otherwise g(q) = 0. q_rounding is the remainder of the compensated sum of q. `apply` adds w.reaction to q. Fails in
/// the same cases as the overload above.
template <ConstrainedSystem S, class Apply>
Status meet_position_constraint(const S& system, double tolerance, const typename S::Vector& q,
                                const typename S::Vector& q_rounding, const typename S::Vector& q0,
                                typename S::Workspace& system_workspace, ConstraintTemporaries<S>& w, Apply&& apply) {
  if constexpr (resolves_rounding<S>)
    return meet_constraint(
        system, "position", tolerance, q, q0, system_workspace, w,
        [&] { return system.constraint(q, q_rounding, w.residual); }, apply,
        [&] { return noise_of_constraint(system, q, q_rounding); });
  else
    return meet_position_constraint(system, tolerance, q, q0, system_workspace, w, apply);
}

}  // namespace pseudorigid::mechanics::detail
