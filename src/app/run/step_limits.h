#pragma once
/// Limits of the step of a run, from the state of its model. They are the stability of RATTLE, the stiffness of the
/// damping, and an oscillation that the steps do not resolve. A `model` is a RunnableModelOf a system
/// (runnable_model.h).

#include <algorithm>
#include <utility>

#include "mechanics/steps/compliance_oscillation.h"
#include "mechanics/steps/largest_frequency.h"
#include "mechanics/steps/slow_motion.h"
#include "mechanics/steps/step_size.h"

namespace pseudorigid::app {

namespace detail {
inline constexpr int n_lanczos = 24;
/// Relative accuracy of the squared frequency at which Lanczos' iteration ends. If it is 0, the iteration makes all
/// n_lanczos steps. For a costly force, a better estimate costs more than steps longer by 1 % would save.
template <class System>
inline constexpr double lanczos_accuracy = mechanics::has_costly_force<System> ? 0.02 : 0;
}  // namespace detail

/// Sets `limit` to the largest stable step of RATTLE times `safety` (ModelStepping::rattle_limit).
template <class Model>
mechanics::Status rattle_limit([[maybe_unused]] const Model& model, [[maybe_unused]] const typename Model::State& state,
                               [[maybe_unused]] double safety, [[maybe_unused]] double& limit) {
  using System = typename Model::System;
  if constexpr (mechanics::ConstrainedSystem<System>) {
    constexpr double accuracy = detail::lanczos_accuracy<System>;
    auto workspace = model.system().make_workspace();
    // A workspace with `held_at` replaces contact by springs at all points of the surface. The limit therefore also
    // holds in a later contact.
    if constexpr (requires { workspace.held_at; }) workspace.held_at = &state.q;
    const auto frequency = mechanics::largest_frequency(model.system(), state, workspace, detail::n_lanczos, accuracy);
    if constexpr (requires { workspace.held_at; }) workspace.held_at = nullptr;
    if (!frequency.status) return frequency.status;
    limit = mechanics::rattle_step_limit(frequency.omega, model.rate(state), safety);
    if constexpr (!mechanics::Damped<System>) {
      const auto damping =
          mechanics::largest_damping(model.system(), state, workspace, frequency.omega, detail::n_lanczos, accuracy);
      if (!damping.status) return damping.status;
      limit = std::min(limit, mechanics::damped_step_limit(damping.gamma, safety));
    }
  }
  return {};
}

/// Sets request.stiff if an explicit method needs too many steps. It needs about γh steps for each step h of RATTLE. γ
/// is the largest damping rate, with friction that of a body at rest in contact. Fails if γ is not found.
template <class Model>
mechanics::Status judge_stiffness([[maybe_unused]] const Model& model,
                                  [[maybe_unused]] const typename Model::State& state,
                                  [[maybe_unused]] mechanics::StepRequest& request) {
  using System = typename Model::System;
  if constexpr (mechanics::Damped<System>) {
    if (!mechanics::dissipative(model.system())) return {};
    auto workspace = model.system().make_workspace();
    const double h = request.rattle_limit, omega = mechanics::Rattle::stability_limit / h;
    const auto at = mechanics::damping_is_linear(model.system()) ? state : model.in_contact(state);
    const auto damping = mechanics::largest_damping(model.system(), at, workspace, omega, detail::n_lanczos, 0.1);
    if (!damping.status) return damping.status;
    request.stiff = damping.gamma * h > (mechanics::has_costly_force<System> ? 30 : 100);
  }
  return {};
}

/// Sets `error` to the bound 4A/3 of the error of Q by an oscillation of the amplitude A that the steps do not resolve
/// (mechanics/steps/compliance_oscillation.h). The bound is twice the estimate 2A/3. It is 0 unless the constraint is
/// compliant.
template <class Model>
mechanics::Status unresolved_oscillation([[maybe_unused]] const Model& model,
                                         [[maybe_unused]] const typename Model::State& state, double& error) {
  error = 0;
  if constexpr (mechanics::Compliant<typename Model::System>)
    if (mechanics::is_compliant(model.system())) {
      auto workspace = model.system().make_workspace();
      double amplitude = 0;
      mechanics::Status status = mechanics::compliance_oscillation(model.system(), state, workspace, amplitude);
      error = 4 * amplitude / 3;
      return status;
    }
  return {};
}

/// Moves `state` to the slow motion, without the oscillation of a compliant constraint (mechanics/steps/slow_motion.h).
/// `h` is a time in which the slow motion changes little. If the motion cannot be found, does nothing.
template <class Model>
void leave_oscillation([[maybe_unused]] const Model& model, [[maybe_unused]] double h,
                       [[maybe_unused]] typename Model::State& state) {
  if constexpr (mechanics::Compliant<typename Model::System>) {
    typename Model::State slow = state;
    if (mechanics::move_to_slow_motion(model.system(), h, slow)) state = std::move(slow);
  }
}

}  // namespace pseudorigid::app
