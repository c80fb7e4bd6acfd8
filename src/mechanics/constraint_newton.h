#pragma once
/// Newton's iteration that meets a constraint by reactions: with the residual r = g(q) or G(q) v,
///
///   G(q₁) M⁻¹ G(q₀)ᵀ δ = −r,   x ← x + M⁻¹G(q₀)ᵀ δ,
///
/// until |r| ≤ tolerance (or round-off).

#include <string>
#include <type_traits>
#include <utility>

#include "mechanics/constrained_system.h"
#include "mechanics/rattle.h"

namespace pseudorigid::mechanics::detail {

/// A single constraint is a number: its reactions are multiples of one direction, and its Gram matrix is G(q₁) times
/// it.
template <class S>
inline constexpr bool single_constraint = std::is_same_v<typename S::Multiplier, double>;

template <ConstrainedSystem S>
struct ConstraintTemporaries {
  explicit ConstraintTemporaries(const S& system)
      : zero(system.make_vector()),
        reaction(system.make_vector()),
        direction(single_constraint<S> ? system.make_vector() : typename S::Vector{}),
        residual(system.make_multiplier()),
        delta(system.make_multiplier()) {}

  typename S::Vector zero;                 // a product with 0 would keep a NaN of a failed trial
  typename S::Vector reaction, direction;  // M⁻¹G(q₀)ᵀδ; M⁻¹G(q₀)ᵀ of a single constraint
  typename S::Multiplier residual, delta;
  bool direction_known = false;  // to be cleared where q₀ has changed
};

/// w.reaction = M⁻¹G(q₀)ᵀ λ.
template <ConstrainedSystem S>
void set_reaction(const S& system, const typename S::Vector& q0, const typename S::Multiplier& lambda,
                  ConstraintTemporaries<S>& w) {
  if constexpr (single_constraint<S>) {
    if (!w.direction_known) {
      w.direction = w.zero;
      system.add_reaction(q0, 1.0, w.direction);
      system.apply_inverse_mass(w.direction, w.direction);
      w.direction_known = true;
    }
    w.reaction = lambda * w.direction;
  } else {
    w.reaction = w.zero;
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
    if (SolveReport report = system.solve_gram(q1, q0, w.residual, system_workspace, w.delta); !report.status)
      return std::move(report.status);
  }
  set_reaction(system, q0, w.delta, w);
  return {};
}

/// `evaluate` sets w.residual and returns a Status; `apply` adds w.reaction to x.
template <ConstrainedSystem S, class Evaluate, class Apply>
Status meet_constraint(const S& system, const char* what, const typename S::Vector& q1, const typename S::Vector& q0,
                       typename S::Workspace& system_workspace, ConstraintTemporaries<S>& w, Evaluate&& evaluate,
                       Apply&& apply) {
  ConvergenceMonitor monitor{system.constraint_tolerance()};
  for (;;) {
    if (Status status = evaluate(); !status) return status;
    const double norm = max_norm(w.residual);
    const auto verdict = monitor.judge(norm);
    if (verdict == ConvergenceMonitor::Verdict::done) return {};
    if (verdict == ConvergenceMonitor::Verdict::stuck)
      return Status::failure(std::string("the ") + what + " iteration of the constraint does not converge (residual " +
                             std::to_string(norm) + ")");
    if (Status status = react(system, q1, q0, system_workspace, w); !status) return status;
    apply();
  }
}

}  // namespace pseudorigid::mechanics::detail
