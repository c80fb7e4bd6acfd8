#pragma once
/// Runs of the program's own methods by its own time loop.

#include "mechanics/methods/gauss_16.h"
#include "mechanics/methods/time_loop.h"
#include "work_precision.h"

namespace pseudorigid::benchmarks {

template <class System>
struct KeepSamples {
  std::vector<State<System>>& samples;
  long n_steps = 1;

  template <class Workspace>
  Status sample(long k, const State<System>& state, const Workspace&) {
    if (k > 0) samples.push_back(state);
    return {};
  }
  template <class Workspace>
  long steps_per_interval(long, const State<System>&, const Workspace&) {
    return n_steps;
  }
  template <class Workspace>
  bool step_done(mechanics::Cursor, const State<System>&, const Workspace&) {
    return true;
  }
};

/// Gauss collocation with `n_steps` steps between two samples, the accelerations iterated to a tolerance (0: to
/// round-off).
template <class System>
Recording<System> run_gauss(const Form<System>& form, double n_steps, double iteration_tolerance) {
  Recording<System> r;
  r.samples.reserve(n_samples);
  auto state = form.initial;
  const Stopwatch watch;
  KeepSamples<System> hooks{r.samples, std::lround(n_steps)};
  mechanics::Gauss16Workspace<System> workspace(form.system);
  workspace.iteration_tolerance = iteration_tolerance;
  mechanics::Cursor cursor;
  const auto result =
      mechanics::run_time_loop<mechanics::Gauss16>(form.system, {end_time, n_samples}, state, cursor, workspace, hooks);
  r.seconds = watch.seconds();
  r.n_evaluations = workspace.counters.n_force;
  r.failure = result.reason;
  return r;
}

/// `parameter` is the tolerance of an adaptive method, the number of steps between two samples of another.
template <class Method, class System>
Recording<System> run_own(const Form<System>& form, double parameter) {
  Recording<System> r;
  r.samples.reserve(n_samples);
  auto state = form.initial;
  const Stopwatch watch;
  KeepSamples<System> hooks{r.samples};
  typename Method::template Workspace<System> workspace(form.system);
  if constexpr (Method::adaptive)
    workspace.tolerance = parameter;
  else
    hooks.n_steps = std::lround(parameter);
  mechanics::Cursor cursor;
  const auto result =
      mechanics::run_time_loop<Method>(form.system, {end_time, n_samples}, state, cursor, workspace, hooks);
  r.seconds = watch.seconds();
  r.n_evaluations = workspace.counters.n_force;
  r.failure = result.reason;
  return r;
}

}  // namespace pseudorigid::benchmarks
