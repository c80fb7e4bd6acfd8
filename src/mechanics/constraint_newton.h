#pragma once
/// Newton's iteration that meets a constraint by reactions: with the residual r = g(q) or G(q) v,
///
///   G(q₁) M⁻¹ G(q₀)ᵀ δ = −r,   x ← x + M⁻¹G(q₀)ᵀ δ,
///
/// until |r| ≤ tolerance (or round-off).

#include <cmath>
#include <string>
#include <type_traits>
#include <utility>

#include "mechanics/constrained_system.h"

namespace pseudorigid::mechanics::detail {

inline constexpr int max_constraint_iterations = 30;

/// Decides on a residual in the constraint loops: done, go on, or stuck. At round-off a residual stops falling; it then
/// counts as zero if it is at most `round_off`.
struct ConvergenceMonitor {
  double tolerance, round_off, previous = HUGE_VAL;
  int iteration = 0;
  enum class Verdict { done, go_on, stuck };

  Verdict judge(double residual) {
    if (residual <= tolerance) return Verdict::done;
    const bool falling = residual < 0.5 * previous;
    if (!falling && residual <= round_off) return Verdict::done;
    // One rise is forgiven (a first Newton step from far away); a NaN compares false everywhere and is stuck at once.
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
  bool direction_known = false;  // to be cleared where q₀ has changed
  long n_gram_iterations = 0;
};

/// w.reaction = M⁻¹G(q₀)ᵀ λ.
template <ConstrainedSystem S>
void set_reaction(const S& system, const typename S::Vector& q0, const typename S::Multiplier& lambda,
                  ConstraintTemporaries<S>& w) {
  if constexpr (single_constraint<S>) {
    if (!w.direction_known) {
      scale(0.0, w.direction);
      system.add_reaction(q0, 1.0, w.direction);
      system.apply_inverse_mass(w.direction, w.direction);
      w.direction_known = true;
    }
    w.reaction = lambda * w.direction;
  } else {
    scale(0.0, w.reaction);
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
    set_reaction(system, q0, 1.0, w);
    system.constraint_rate(q1, w.direction, w.delta);
    w.delta = w.residual * (1 / w.delta);  // the quotient does not wait for the residual
  } else {
    SolveReport report = system.solve_gram(q1, q0, w.residual, system_workspace, w.delta);
    w.n_gram_iterations += report.iterations;
    if (!report.status) return std::move(report.status);
  }
  set_reaction(system, q0, w.delta, w);
  return {};
}

/// `evaluate` sets w.residual and returns a Status; `apply` adds w.reaction to x. Tolerance 0: until round-off.
template <ConstrainedSystem S, class Evaluate, class Apply>
Status meet_constraint(const S& system, const char* what, double tolerance, const typename S::Vector& q1,
                       const typename S::Vector& q0, typename S::Workspace& system_workspace,
                       ConstraintTemporaries<S>& w, Evaluate&& evaluate, Apply&& apply) {
  ConvergenceMonitor monitor{tolerance, 1000 * system.constraint_tolerance()};
  for (;;) {
    if (Status status = evaluate(); !status) return status;
    const double norm = max_norm(w.residual);
    const auto verdict = monitor.judge(norm);
    if (verdict == ConvergenceMonitor::Verdict::done) return {};
    if (verdict == ConvergenceMonitor::Verdict::stuck)
      return Status::failure(std::string("the ") + what +
                             " iteration of the constraint does not converge; use a smaller step");
    if (Status status = react(system, q1, q0, system_workspace, w); !status) return status;
    apply();
  }
}

}  // namespace pseudorigid::mechanics::detail
