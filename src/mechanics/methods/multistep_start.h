#pragma once
/// The start of a symmetric multistep method with k steps (symmetric_multistep.h). Another method, the starting method,
/// makes its first k − 1 steps. For orders 8 and 12 the starting method is the explicit method of order 8 with a
/// tolerance at round-off. For order 4 it is a composition of RATTLE of order 4.
///
/// The composition has steps of negative size. If a constraint is compliant, they amplify fast oscillations of g that
/// the steps do not resolve. In place of the composition, a step then extrapolates RATTLE. From one step of size h to
/// (q₁, v₁) and three steps of size h/3 to (q₃, v₃), it computes
///
///   q = q₁ + (9/8)(q₃ − q₁) + M⁻¹G(q₁)ᵀδ,   g(q) = g(q₁),
///   v = v₁ + (9/8)(v₃ − v₁) + M⁻¹G(q)ᵀη,     G(q) v = G(q₁) v₁.
///
/// The error of RATTLE has even powers of h, so the order of q and v is 4. Their values of g and its rate are those of
/// the step of size h. A fast oscillation of g then changes its sign in each step, as in the multistep method. Another
/// sequence of g would be amplified. The error of g is of order 2, but it belongs to a change of volume, which is
/// proportional to the reciprocal of the stiffness.
///
/// A starting method for a system of type S is a type Start<S>. The workspace of the multistep method contains an
/// object of this type, which has the following functions. The argument w is the workspace of the multistep method. The
/// functions `acceleration`, `step` and `project` return a Status.
///
///   begin(system, w)                       prepares steps from a new state or with a new h
///   acceleration(system, state, w, a)      sets a to the acceleration with the reaction, but without that of a compliant
///                                          constraint; may first project state.v
///   step(system, h, state, w)              makes one step of size h, and sets w.q_rounding
///   project(system, state, w)              projects the velocity onto G v = 0 if `step` does not
///   visit_memory(visit)                    passes the members that a checkpoint must contain to `visit`

#include <limits>
#include <utility>

#include "mechanics/core/explicit_multiplier.h"
#include "mechanics/methods/composition.h"
#include "mechanics/methods/dormand_prince_8.h"
#include "mechanics/methods/rattle.h"

namespace pseudorigid::mechanics {

/// The first steps by the explicit method of order 8 with a tolerance at round-off.
template <ConstrainedSystem S>
struct ExplicitStart {
  explicit ExplicitStart(const S& system)
      : field(system), workspace(field, 4 * std::numeric_limits<double>::epsilon()) {}

  void begin(const S& system, RattleWorkspace<S>& w) {
    workspace.acceleration_known = false;
    workspace.h = 0;
    workspace.q_rounding = w.q_rounding;
    workspace.v_rounding = system.make_vector();
  }
  Status acceleration(const S&, State<S>& state, RattleWorkspace<S>&, typename S::Vector& a) {
    return field.acceleration(state.t, state.q, state.v, workspace.system, a);
  }
  Status step(const S&, double h, State<S>& state, RattleWorkspace<S>& w) {
    // If h is stable and accurate for the multistep method, a few tens of small steps are enough. A limit is needed
    // because this loop cannot be interrupted.
    constexpr int most = 2000;
    const double t_end = state.t + h;
    for (int n = 0; state.t != t_end; ++n) {
      if (n == most)
        return Status::failure(
            "the first steps of the multistep method take more than 2000 small ones each; use a smaller step");
      if (Status status = DormandPrince8::step(field, t_end, state, workspace); !status) return status;
    }
    w.q_rounding = workspace.q_rounding;
    return {};
  }
  /// Does nothing, because `step` projects the velocity.
  Status project(const S&, State<S>&, RattleWorkspace<S>&) const { return {}; }
  template <class Visit>
  void visit_memory(Visit&& visit) {
    workspace.visit_memory(visit);
  }

  ExplicitMultiplier<S> field;
  DormandPrince8Workspace<ExplicitMultiplier<S>> workspace;
};

/// The first steps by a composition of RATTLE. The composition is stable up to larger steps than the multistep method.
template <class Composed>
struct CompositionStart {
  template <ConstrainedSystem S>
  struct Of {
    explicit Of(const S& system) : curvature(system.make_multiplier()) {}

    void begin(const S& system, RattleWorkspace<S>& w) {
      w.history.n_known = 0;
      w.pending_weight = 0;
      w.v_rounding = make_rounding(system);
    }
    Status acceleration(const S& system, State<S>& state, RattleWorkspace<S>& w, typename S::Vector& a) {
      if (Status status = project(system, state, w); !status) return status;
      if (Status status = Rattle::ensure_acceleration(system, state, w); !status) return status;
      a = w.acceleration;
      if constexpr (unconstrained<S>) return {};
      if (is_compliant(system)) return {};
      return detail::add_reaction_of_motion(system, state.q, state.v, w.system, w.constraint, curvature, a);
    }
    Status step(const S& system, double h, State<S>& state, RattleWorkspace<S>& w) {
      const double t_end = state.t + h;
      if constexpr (Compliant<S>)
        if (is_compliant(system)) return extrapolate(system, t_end, state, w);
      if (Status status = Composed::advance(system, h, state, w); !status) return status;
      state.t = t_end;
      return {};
    }
    Status project(const S& system, State<S>& state, RattleWorkspace<S>& w) {
      return Rattle::project_velocity(system, state, w);
    }
    template <class Visit>
    void visit_memory(Visit&&) {}

   private:
    /// Makes the step from `state`, whose velocity must be projected, to the time t_end for a compliant constraint.
    /// Fails if RATTLE or a projection fails.
    static Status extrapolate(const S& system, double t_end, State<S>& state, RattleWorkspace<S>& w) {
      const double h = t_end - state.t;
      if (Status status = Rattle::ensure_acceleration(system, state, w); !status) return status;
      State<S> finer = state;
      const typename S::Vector acceleration = w.acceleration, q_rounding = w.q_rounding, v_rounding = w.v_rounding;
      if (Status status = substeps(system, h / 3, 3, finer, w); !status) return status;
      w.acceleration = acceleration;
      w.q_rounding = q_rounding;
      w.v_rounding = v_rounding;
      w.acceleration_known = true;
      w.acceleration_time = state.t;
      if (Status status = substeps(system, h, 1, state, w); !status) return status;
      const typename S::Vector q1 = state.q;
      auto& rate = w.compliance.mean;
      system.constraint_rate(q1, state.v, rate);
      for (const auto& [from, to] : {std::pair(&finer.q, &state.q), std::pair(&finer.v, &state.v)}) {
        axpy(-1.0, *to, *from);
        axpy(9.0 / 8, *from, *to);
      }
      if (Status status = detail::meet_value(system, h, w.compliance.g_end, q1, state, w); !status) return status;
      if (Status status = detail::meet_rate(system, rate, state, w); !status) return status;
      w.acceleration_known = w.compliance.g_known = false;
      state.t = t_end;
      return {};
    }
    /// Makes n steps of RATTLE with the size h, and completes the velocity.
    static Status substeps(const S& system, double h, int n, State<S>& state, RattleWorkspace<S>& w) {
      w.history.n_known = 0;
      w.compliance.g_known = false;
      for (int i = 0; i < n; ++i)
        if (Status status = Rattle::advance(system, h, state, w); !status) return status;
      return Rattle::project_velocity(system, state, w);
    }
    typename S::Multiplier curvature;
  };
};

}  // namespace pseudorigid::mechanics
