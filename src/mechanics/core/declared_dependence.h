#pragma once
/// Checks that a system declares each dependence of its force on time and velocity (second_order_field.h). The compiler
/// does not report a misspelt declaration, and methods would then rely on a false property.

#include "mechanics/core/constrained_system.h"
#include "mechanics/core/second_order_field.h"

namespace pseudorigid::mechanics {

/// Evaluates the force at `state`, at another time, and at another velocity. The other velocity is zero, or a vector of
/// ones if the state is at rest. Fails if a force differs from the force at `state` and the system does not declare the
/// dependence. If a force fails or is not finite, the function succeeds without a comparison. For a second-order field,
/// only the dependence on time is tested, because accelerations in charts nearly always depend on the velocity.
template <class S>
Status check_declared_dependence(const S& system, const State<S>& state) {
  auto workspace = system.make_workspace();
  const auto force = [&](double t, const typename S::Vector& v, typename S::Vector& f) {
    if constexpr (ConstrainedSystem<S>)
      return system.force(t, state.q, v, workspace, f);
    else
      return system.acceleration(t, state.q, v, workspace, f);
  };
  const typename S::Vector other_v =
      state.v.isZero(0) ? typename S::Vector(S::Vector::Ones(state.v.rows(), state.v.cols())) : system.make_vector();
  typename S::Vector f = system.make_vector(), later = f, faster = f;
  const double other_t = state.t + 0.37;
  // A force that fails or is not finite is reported later, by the run.
  if (!force(state.t, state.v, f) || !force(other_t, state.v, later) || !force(state.t, other_v, faster)) return {};
  if (!f.allFinite() || !later.allFinite() || !faster.allFinite()) return {};
  if (!time_dependent(system) && later != f)
    return Status::failure("a force depends on time, and its system does not declare time_dependent()");
  if (ConstrainedSystem<S> && !velocity_dependent(system) && faster != f)
    return Status::failure("a force depends on the velocity, and its system does not declare velocity_dependent()");
  return {};
}

}  // namespace pseudorigid::mechanics
