#pragma once
/// Runs of the time loop that keep the state at every sample.

#include <cstdlib>
#include <string>
#include <vector>

#include "mechanics/core/field_of.h"
#include "mechanics/methods/methods.h"
#include "mechanics/methods/time_loop.h"

namespace pseudorigid::testing {

template <class S>
struct RecordedRun {
  mechanics::RunResult result;
  std::vector<mechanics::State<S>> states;  ///< at the samples
  mechanics::Counters counters;

  bool finished() const { return result.outcome == mechanics::Outcome::finished; }
  const mechanics::State<S>& last() const { return states.back(); }
};

/// Hooks that record the samples and stop after `n_steps_allowed` steps.
template <class S>
struct Recorder {
  long n_steps = 1;
  long n_steps_allowed = -1;
  std::vector<mechanics::State<S>> states{};

  template <class W>
  mechanics::Status sample(long, const mechanics::State<S>& state, const W&) {
    states.push_back(state);
    return {};
  }
  template <class W>
  long steps_per_interval(long, const mechanics::State<S>&, const W&) {
    return n_steps;
  }
  template <class W>
  bool step_done(mechanics::Cursor, const mechanics::State<S>&, const W&) {
    return --n_steps_allowed != 0;
  }
};

/// N samples with n steps between them; adaptive methods make steps of their own, at a tolerance of 1e-12.
template <class Method, class S>
RecordedRun<S> run(const S& system, mechanics::State<S> state, double end, long n_samples, long n_steps) {
  const auto& form = mechanics::form_for<Method>(system);
  typename Method::template Workspace<mechanics::FormFor<Method, S>> workspace(form);
  mechanics::Cursor cursor;
  Recorder<S> recorder{n_steps};
  auto result = mechanics::run_time_loop<Method>(form, {end, n_samples}, state, cursor, workspace, recorder);
  return {std::move(result), std::move(recorder.states), workspace.counters};
}

/// |(q, v) − (q', v')|_∞
template <class Vector>
double distance(mechanics::VectorState<Vector> a, const mechanics::VectorState<Vector>& b) {
  mechanics::axpy(-1.0, b.q, a.q);
  mechanics::axpy(-1.0, b.v, a.v);
  return std::max(mechanics::max_norm(a.q), mechanics::max_norm(a.v));
}

/// max over the samples of the distance.
template <class S>
double distance(const RecordedRun<S>& a, const RecordedRun<S>& b) {
  double d = a.states.size() == b.states.size() ? 0 : HUGE_VAL;
  for (std::size_t k = 0; k < std::min(a.states.size(), b.states.size()); ++k)
    d = std::max(d, distance(a.states[k], b.states[k]));
  return d;
}

}  // namespace pseudorigid::testing
