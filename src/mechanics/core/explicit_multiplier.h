#pragma once
/// A constrained system as a second-order field with an invariant manifold (Oliva, Geometric Mechanics, 5.29). The
/// system has the mass M, the force f and the constraint g = 0 with G = Dg. The multiplier λ of the motion is an
/// explicit function of the state,
///
///   q̈ = M⁻¹[f + G(q)ᵀλ],   G M⁻¹Gᵀ λ = −D²g(q̇, q̇) − G M⁻¹ f,
///
/// so g = 0 and G q̇ = 0 are invariants of the field. Numerical integration violates both by its errors, which Newton's
/// iteration corrects:
///
///   G M⁻¹Gᵀ δ = −g(q),   q ← q + M⁻¹G(q)ᵀδ,     then     G M⁻¹Gᵀ δ = −G v,   v ← v + M⁻¹G(q)ᵀδ.
///
/// If the system has members `acceleration(t, q, v, w, a)` and `project(q, v, w)`, the field calls these members, which
/// may be faster. If the number of constraints is known at compile time, Gram solves are direct. Other Gram solves may
/// be inexact. For the acceleration a = q̈, the residual is G a + D²g(q̇, q̇). Inexact solves are repeated until this
/// residual is within the constraint tolerance or no longer halves, at most 30 times.

#include <cmath>

#include "mechanics/core/constrained_system.h"
#include "mechanics/core/constraint_newton.h"
#include "mechanics/core/gauss_stages.h"
#include "mechanics/core/relaxation.h"
#include "mechanics/core/second_order_field.h"

namespace pseudorigid::mechanics {

namespace detail {

/// Adds M⁻¹Gᵀλ to the acceleration a, with λ such that the new a satisfies G a = −D²g(v, v). Fails if a Gram solve
/// fails.
template <ConstrainedSystem S>
Status add_reaction_of_motion(const S& system, const typename S::Vector& q, const typename S::Vector& v,
                              typename S::Workspace& system_workspace, ConstraintTemporaries<S>& constraint,
                              typename S::Multiplier& curvature, typename S::Vector& a) {
  constexpr int max_refinements = S::n_constraints == dynamic_constraints ? 30 : 1;
  constexpr double needed_fall = 0.5;  // a residual that does not halve is round-off
  system.constraint_curvature(q, v, curvature);
  constraint.direction_known = false;
  double before = HUGE_VAL;
  for (int i = 0; i < max_refinements; ++i) {
    system.constraint_rate(q, a, constraint.residual);
    axpy(1.0, curvature, constraint.residual);
    if constexpr (max_refinements > 1) {
      const double norm = max_norm(constraint.residual);
      if (norm <= system.constraint_tolerance() || norm > needed_fall * before) break;
      before = norm;
    }
    if (Status status = react(system, q, q, system_workspace, constraint); !status) return status;
    axpy(1.0, constraint.reaction, a);
  }
  return {};
}

}  // namespace detail

/// The second-order field of a constrained system. The system must exist as long as the field.
template <ConstrainedSystem S>
class ExplicitMultiplier {
 public:
  using Vector = typename S::Vector;
  using Multiplier = typename S::Multiplier;
  struct Workspace {
    typename S::Workspace system;
    detail::ConstraintTemporaries<S> constraint;
    Multiplier curvature;

    /// Passes the memory of the system's workspace (memory.h) to `visit`. Only workspaces with an iterative solver of
    /// Gram systems have a memory.
    template <class Visit>
    void visit_memory(Visit&& visit) {
      if constexpr (requires { system.visit_memory(visit); }) system.visit_memory(visit);
    }
  };

  explicit ExplicitMultiplier(const S& system) : system_(system) {}

  const S& system() const { return system_; }
  Vector make_vector() const { return system_.make_vector(); }
  Workspace make_workspace() const {
    return {system_.make_workspace(), detail::ConstraintTemporaries<S>(system_), system_.make_multiplier()};
  }
  bool velocity_dependent() const { return !unconstrained<S> || mechanics::velocity_dependent(system_); }
  bool dissipative() const { return mechanics::dissipative(system_); }
  bool time_dependent() const { return mechanics::time_dependent(system_); }
  bool relaxes() const { return mechanics::relaxes(system_); }

  /// Sets a = q̈ of the motion through (q, v). Fails if the force or a Gram solve fails.
  Status acceleration(double t, const Vector& q, const Vector& v, Workspace& w, Vector& a) const {
    if constexpr (requires { system_.acceleration(t, q, v, w.system, a); }) {
      return system_.acceleration(t, q, v, w.system, a);
    } else {
      if (Status status = system_.force(t, q, v, w.system, a); !status) return status;
      system_.apply_inverse_mass(a, a);
      if constexpr (unconstrained<S>)
        return {};
      else
        return detail::add_reaction_of_motion(system_, q, v, w.system, w.constraint, w.curvature, a);
    }
  }

  /// The next four members concern the stages of a Gauss step (stage_by_stage.h). Each of them exists if the system has
  /// a member of the same name, and calls that member.
  bool solve_stages_in_lanes(GaussStages& stages) const requires requires(const S& s) {
    s.solve_stages_in_lanes(stages);
  }
  { return system_.solve_stages_in_lanes(stages); }
  bool has_stages_in_lanes() const requires requires(const S& s) { s.has_stages_in_lanes(); }
  { return system_.has_stages_in_lanes(); }
  double cost_of_iteration() const requires requires(const S& s) { s.cost_of_iteration(); }
  { return system_.cost_of_iteration(); }
  Status solve_stages(GaussStages& stages, Workspace& w) const requires
      requires(const S& s, typename S::Workspace& of_s) {
    s.solve_stages(stages, of_s);
  }
  { return system_.solve_stages(stages, w.system); }

  /// Changes q and v until g(q) = 0 and G v = 0 hold up to the constraint tolerance of the system or round-off. Fails
  /// if a constraint or a Gram solve fails, or if one of the iterations does not converge. Does nothing without
  /// constraints.
  Status project(Vector& q, Vector& v, Workspace& w) const {
    if constexpr (requires { system_.project(q, v, w.system); }) {
      return system_.project(q, v, w.system);
    } else if constexpr (unconstrained<S>) {
      return {};
    } else {
      if (!is_constrained(system_)) return {};
      auto& c = w.constraint;
      c.direction_known = false;  // the corrections of q and v use one direction, since q hardly changes
      const double tolerance = system_.constraint_tolerance();
      if (Status status = detail::meet_position_constraint(system_, tolerance, q, q, w.system, c,
                                                           [&] { axpy(1.0, c.reaction, q); });
          !status)
        return status;
      return detail::meet_velocity_constraint(system_, tolerance, q, v, w.system, c, [&] { axpy(1.0, c.reaction, v); });
    }
  }

 private:
  const S& system_;
};

}  // namespace pseudorigid::mechanics
