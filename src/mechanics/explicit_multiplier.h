#pragma once
/// A constrained system as a second-order field with invariant manifold (Oliva, Geometric Mechanics, 5.29): the
/// explicit multiplier of the motion,
///
///   q̈ = M⁻¹[f + G(q)ᵀλ],   G M⁻¹Gᵀ λ = −D²g(q̇, q̇) − G M⁻¹ f,
///
/// keeps g = 0 and G q̇ = 0; what integration loses of them is brought back by Newton's iteration,
///
///   G M⁻¹Gᵀ δ = −g(q),   q ← q + M⁻¹G(q)ᵀδ,     then     G M⁻¹Gᵀ δ = −G v,   v ← v + M⁻¹G(q)ᵀδ.
///
/// A system that computes its acceleration or its projection faster says so by members `acceleration(t, q, v, w, a)`
/// and `project(q, v, w)`. Gram solves of a number of constraints known at compile time are direct; the others may be
/// inexact and are refined until the constraint on the acceleration is met.

#include <utility>

#include "mechanics/constrained_system.h"
#include "mechanics/rattle.h"
#include "mechanics/second_order_field.h"

namespace pseudorigid::mechanics {

template <ConstrainedSystem S>
class ExplicitMultiplier {
 public:
  using Vector = typename S::Vector;
  using Multiplier = typename S::Multiplier;
  struct Workspace {
    typename S::Workspace system;
    Vector reaction;
    Multiplier residual, curvature, delta;
  };

  explicit ExplicitMultiplier(const S& system) : system_(system) {}

  const S& system() const { return system_; }
  Vector make_vector() const { return system_.make_vector(); }
  Workspace make_workspace() const {
    return {system_.make_workspace(), system_.make_vector(), system_.make_multiplier(), system_.make_multiplier(),
            system_.make_multiplier()};
  }
  bool velocity_dependent() const { return !unconstrained<S> || mechanics::velocity_dependent(system_); }
  bool dissipative() const { return mechanics::dissipative(system_); }
  bool time_dependent() const { return mechanics::time_dependent(system_); }

  Status acceleration(double t, const Vector& q, const Vector& v, Workspace& w, Vector& a) const {
    if constexpr (requires { system_.acceleration(t, q, v, w.system, a); }) {
      return system_.acceleration(t, q, v, w.system, a);
    } else {
      if (Status status = system_.force(t, q, v, w.system, a); !status) return status;
      system_.apply_inverse_mass(a, a);
      if constexpr (unconstrained<S>)
        return {};
      else
        return add_reaction(q, v, w, a);
    }
  }

  Status project(Vector& q, Vector& v, Workspace& w) const {
    if constexpr (requires { system_.project(q, v, w.system); }) {
      return system_.project(q, v, w.system);
    } else if constexpr (unconstrained<S>) {
      return {};
    } else {
      const auto position = [&](Multiplier& g) { return system_.constraint(q, g); };
      const auto rate = [&](Multiplier& r) {
        system_.constraint_rate(q, v, r);
        return Status();
      };
      if (Status status = solve("position", q, q, position, w); !status) return status;
      return solve("velocity", q, v, rate, w);
    }
  }

 private:
  /// a ← a + M⁻¹Gᵀλ with G a = −D²g(v, v).
  Status add_reaction(const Vector& q, const Vector& v, Workspace& w, Vector& a) const {
    constexpr int max_refinements = S::n_constraints == dynamic_constraints ? 30 : 1;
    constexpr double needed_fall = 0.5;  // round-off is reached when the residual stops falling
    system_.constraint_curvature(q, v, w.curvature);
    double before = HUGE_VAL;
    for (int i = 0; i < max_refinements; ++i) {
      system_.constraint_rate(q, a, w.residual);
      axpy(1.0, w.curvature, w.residual);
      if constexpr (max_refinements > 1) {
        const double norm = max_norm(w.residual);
        if (norm <= system_.constraint_tolerance() || norm > needed_fall * before) break;
        before = norm;
      }
      if (Status status = react(q, w); !status) return status;
      axpy(1.0, w.reaction, a);
    }
    return {};
  }

  /// reaction = M⁻¹Gᵀδ with G M⁻¹Gᵀ δ = −residual.
  Status react(const Vector& q, Workspace& w) const {
    scale(-1.0, w.residual);
    if (SolveReport report = system_.solve_gram(q, q, w.residual, w.system, w.delta); !report.status)
      return std::move(report.status);
    scale(0.0, w.reaction);
    system_.add_reaction(q, w.delta, w.reaction);
    system_.apply_inverse_mass(w.reaction, w.reaction);
    return {};
  }

  /// x ← x + M⁻¹G(q)ᵀδ until the residual (g(q) or G(q) v) is zero; x is q or v.
  template <class Residual>
  Status solve(const char* what, const Vector& q, Vector& x, Residual&& residual, Workspace& w) const {
    detail::ConvergenceMonitor monitor{system_.constraint_tolerance()};
    for (;;) {
      if (Status status = residual(w.residual); !status) return status;
      const double norm = max_norm(w.residual);
      const auto verdict = monitor.judge(norm);
      if (verdict == detail::ConvergenceMonitor::Verdict::done) return {};
      if (verdict == detail::ConvergenceMonitor::Verdict::stuck)
        return Status::failure(std::string("the projection of the ") + what +
                               " onto the constraints does not converge (residual " + std::to_string(norm) + ")");
      if (Status status = react(q, w); !status) return status;
      axpy(1.0, w.reaction, x);
    }
  }

  const S& system_;
};

}  // namespace pseudorigid::mechanics
