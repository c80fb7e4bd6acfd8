#pragma once
/// The start of a symmetric multistep method with k steps (symmetric_multistep.h). Another method, the starting method,
/// makes its first k − 1 steps. For orders 8 and 12 the starting method is the explicit method of order 8 with a
/// tolerance at round-off. For order 4 it is a composition of RATTLE of order 4.
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
      if (Status status = Composed::advance(system, h, state, w); !status) return status;
      state.t = t_end;
      return {};
    }
    Status project(const S& system, State<S>& state, RattleWorkspace<S>& w) {
      return Rattle::project_velocity(system, state, w);
    }
    template <class Visit>
    void visit_memory(Visit&&) {}

    typename S::Multiplier curvature;
  };
};

}  // namespace pseudorigid::mechanics
