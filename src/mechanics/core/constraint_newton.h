#pragma once
/// Newton's iteration that meets a constraint by reactions: with the residual r = g(q) or G(q) v,
///
///   G(q₁) M⁻¹ G(q₀)ᵀ δ = −r,   x ← x + M⁻¹G(q₀)ᵀ δ,
///
/// until |r| ≤ tolerance (or round-off).
///
/// Round-off of G(q) v grows with |G||v|, and that of g(q) with |G||q|, so that no constant bounds it for all motions.
/// If a residual has stopped falling, it is compared with its changes if q and v change by units in their last place
/// (rounding_noise.h).

#include <cmath>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "mechanics/core/constrained_system.h"
#include "mechanics/core/rounding_noise.h"

namespace pseudorigid::mechanics::detail {

inline constexpr int max_constraint_iterations = 30;

/// The noise is the largest of a few changes, and errors may add up to more. In a sample of 4.3·10⁷ residuals that had
/// stopped falling, for bodies with semi-axes 10⁻⁴ … 10⁴, 99.97 % were below 3 times the noise, and three above 16
/// times, the largest 18.7; these are iterated once more.
inline constexpr double noise_reserve = 16;

/// Decides on a residual in the constraint loops: done, go on, or stuck. At round-off a residual stops falling; it then
/// counts as zero if it is at most `round_off`, or within `noise()` and its reserve. The noise is asked for there only,
/// as it costs several evaluations.
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
    // A residual may rise at first if Newton's iteration starts from far away. A NaN compares false everywhere and
    // counts as stuck at once.
    if (!(residual < 10 * previous) || ++iteration > max_constraint_iterations) return Verdict::stuck;
    previous = residual;
    return Verdict::go_on;
  }
};

/// A single constraint is a number: its reactions are multiples of one direction, and its Gram matrix is G(q₁) times
/// it.
template <class S>
inline constexpr bool single_constraint = std::is_same_v<typename S::Multiplier, double>;

template <ConstrainedSystem S>
struct ConstraintTemporaries {
  explicit ConstraintTemporaries(const S& system)
      : reaction(system.make_vector()),
        direction(single_constraint<S> ? system.make_vector() : typename S::Vector{}),
        residual(system.make_multiplier()),
        delta(system.make_multiplier()) {}

  typename S::Vector reaction, direction;  // M⁻¹G(q₀)ᵀδ; M⁻¹G(q₀)ᵀ of a single constraint
  typename S::Multiplier residual, delta;
  bool direction_known = false;  // to be cleared if q₀ has changed
  long n_gram_iterations = 0;
};

/// w.reaction = M⁻¹G(q₀)ᵀ λ. A system may compute it faster from data on q₀ in its workspace.
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

/// w.delta and w.reaction from w.residual.
template <ConstrainedSystem S>
Status react(const S& system, const typename S::Vector& q1, const typename S::Vector& q0,
             typename S::Workspace& system_workspace, ConstraintTemporaries<S>& w) {
  scale(-1.0, w.residual);
  if constexpr (single_constraint<S>) {
    set_reaction(system, q0, 1.0, system_workspace, w);
    system.constraint_rate(q1, w.direction, w.delta);
    w.delta = w.residual * (1 / w.delta);  // the quotient does not wait for the residual
  } else {
    SolveReport report = system.solve_gram(q1, q0, w.residual, system_workspace, w.delta);
    w.n_gram_iterations += report.iterations;
    if (!report.status) return std::move(report.status);
  }
  set_reaction(system, q0, w.delta, system_workspace, w);
  return {};
}

/// Apart from the steps' path: a message costs more than a step.
[[gnu::cold, gnu::noinline]] inline Status without_convergence(std::string_view what) {
  std::string sentence = "the ";
  sentence += what;
  sentence += " iteration of the constraint does not converge; use a smaller step";
  return Status::failure(std::move(sentence));
}

/// Tells an inexact solver of Gram systems how small a residual is enough; 0: as small as it makes it by itself.
template <ConstrainedSystem S>
void seek_residual(typename S::Workspace& system_workspace, double enough) {
  constexpr double linear_part = 1.0 / 3;  // the remaining tolerance is for the nonlinear part
  if constexpr (requires { system_workspace.residual_sought; }) system_workspace.residual_sought = linear_part * enough;
}

/// `evaluate` sets w.residual and returns a Status; `apply` adds w.reaction to x. Tolerance 0: until round-off. A
/// residual up to `foregone` takes one iteration, whose result is not checked.
template <ConstrainedSystem S, class Evaluate, class Apply, class Noise>
Status meet_constraint(const S& system, const char* what, double tolerance, const typename S::Vector& q1,
                       const typename S::Vector& q0, typename S::Workspace& system_workspace,
                       ConstraintTemporaries<S>& w, Evaluate&& evaluate, Apply&& apply, Noise&& noise,
                       double foregone = 0) {
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

/// G(q) v = 0, where `apply` adds w.reaction to v.
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

/// g(q) = 0, where `apply` adds w.reaction to q; the reactions act at q₀.
template <ConstrainedSystem S, class Apply>
Status meet_position_constraint(const S& system, double tolerance, const typename S::Vector& q,
                                const typename S::Vector& q0, typename S::Workspace& system_workspace,
                                ConstraintTemporaries<S>& w, Apply&& apply, double foregone = 0) {
  return meet_constraint(
      system, "position", tolerance, q, q0, system_workspace, w, [&] { return system.constraint(q, w.residual); },
      apply, [&] { return noise_of_constraint(system, q); }, foregone);
}

/// The same, with the remainder of the compensated sum of q if the system supports it.
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
