#pragma once
/// The time loop over a run of length T with the samples t_k = k T/N, k = 0 … N. A method with steps of fixed size
/// makes a whole number n of steps from each sample to the next, with h = (t_{k+1} − t_k)/n. The steps therefore end at
/// the samples, and the last sample is exactly at T.

#include <algorithm>
#include <cmath>
#include <concepts>
#include <string>
#include <utility>

#include "mechanics/core/constrained_system.h"
#include "mechanics/core/outcome.h"
#include "mechanics/methods/rattle.h"

namespace pseudorigid::mechanics {

struct SampleTimes {
  double end = 0;
  long n_samples = 1;
  double operator[](long k) const { return end * (static_cast<double>(k) / static_cast<double>(n_samples)); }
  double interval() const { return end / static_cast<double>(n_samples); }
  /// Returns the least number of equal steps that fill the time between two samples and are not longer than `step`, up
  /// to round-off. The number is at least 1.
  long steps_per_interval(double step) const {
    const double n = std::ceil(interval() / step * (1 - 1e-12));
    constexpr double most = 9e18;  // below the largest long; a run cannot make so many steps
    return static_cast<long>(std::clamp(n, 1.0, most));
  }
};

/// Position of a run: the last sample and the number of steps since that sample.
struct Cursor {
  long sample = 0, step = 0;
};

struct RunResult {
  Outcome outcome = Outcome::finished;
  std::string reason;  ///< the reason of a failure in one sentence, or "interrupted"; empty if the run is finished
  double t = 0;        ///< time that the run reached
};

/// Functions of the caller that the loop calls, called hooks.
///   sample(k, state, workspace) → Status: called at sample k, with the initial velocity (k = 0) or the projected one;
///   steps_per_interval(k, state, workspace) → long: steps from sample k to k+1, not called for adaptive methods;
///   step_done(cursor, state, workspace) → bool: called after each step; false interrupts the loop.
/// For steps of fixed size, `sample` is called after step_done. For adaptive methods, `sample` is called before
/// step_done, for all samples up to the time of the step.
template <class H, class S, class W>
concept TimeLoopHooks = requires(H hooks, long k, const State<S> state, W w, Cursor cursor) {
  { hooks.sample(k, state, w) } -> std::same_as<Status>;
  { hooks.steps_per_interval(k, state, w) } -> std::convertible_to<long>;
  { hooks.step_done(cursor, state, w) } -> std::same_as<bool>;
};

/// Hooks behind one type. The loop of a method is then compiled once for all callers that use this type. A caller that
/// needs the workspace keeps a pointer to it.
template <class State>
class AnyHooks {
 public:
  virtual ~AnyHooks() = default;
  template <class W>
  Status sample(long k, const State& state, W&) {
    return take_sample(k, state);
  }
  template <class W>
  long steps_per_interval(long k, const State& state, W&) {
    return steps_after(k, state);
  }
  template <class W>
  bool step_done(Cursor cursor, const State& state, W&) {
    return goes_on(cursor, state);
  }

 private:
  // The hooks `sample`, `steps_per_interval` and `step_done`.
  virtual Status take_sample(long k, const State& state) = 0;
  virtual long steps_after(long k, const State& state) = 0;
  virtual bool goes_on(Cursor cursor, const State& state) = 0;
};

/// Runs from `cursor`, the start or a checkpoint, to the last sample, an interruption or a failure. Advances `cursor`
/// and `state`, and returns the outcome and the time reached. Fails if the hook `sample`, a step or the projection of
/// the velocity fails, or if a step is shorter than the round-off of the time. After a failed step `state` is not
/// valid.
template <class Method, class S, TimeLoopHooks<S, typename Method::template Workspace<S>> Hooks>
requires(!Method::adaptive) RunResult
    run_time_loop(const S& system, const SampleTimes& times, State<S>& state, Cursor& cursor,
                  typename Method::template Workspace<S>& w, Hooks& hooks) {
  const auto fail = [&](Status status) { return RunResult{Outcome::failed, status.reason(), state.t}; };
  if (cursor.sample == 0 && cursor.step == 0)
    if (Status status = hooks.sample(0, state, w); !status) return fail(std::move(status));

  while (cursor.sample < times.n_samples) {
    const double t_start = times[cursor.sample], t_end = times[cursor.sample + 1];
    const long n = hooks.steps_per_interval(cursor.sample, state, w);
    const double h = (t_end - t_start) / static_cast<double>(n);
    if (!(t_end - h < t_end))
      return fail(Status::failure("the step is shorter than the least difference of times in double precision"));
    for (; cursor.step < n;) {
      state.t = t_start + static_cast<double>(cursor.step) * h;
      if (Status status = Method::advance(system, h, state, w); !status) return fail(std::move(status));
      ++w.counters.n_steps;
      ++cursor.step;
      if (!hooks.step_done(cursor, state, w)) return {Outcome::interrupted, "interrupted", state.t};
    }
    state.t = t_end;
    if (Status status = Method::project_velocity(system, state, w); !status) return fail(std::move(status));
    cursor = {cursor.sample + 1, 0};
    if (Status status = hooks.sample(cursor.sample, state, w); !status) return fail(std::move(status));
  }
  return {Outcome::finished, "", state.t};
}

/// The time loop for an adaptive method. The steps do not end at the samples, so the state at a sample is interpolated.
/// Only the last step ends at T. cursor.step is the number of steps after the step that passed the last sample. Fails
/// if the hook `sample`, a step or an interpolation fails. A failed step does not change `state`.
template <class Method, class F, TimeLoopHooks<F, typename Method::template Workspace<F>> Hooks>
requires(Method::adaptive) RunResult
    run_time_loop(const F& field, const SampleTimes& times, State<F>& state, Cursor& cursor,
                  typename Method::template Workspace<F>& w, Hooks& hooks) {
  const auto fail = [&](Status status) { return RunResult{Outcome::failed, status.reason(), state.t}; };
  if (cursor.sample == 0 && cursor.step == 0)
    if (Status status = hooks.sample(0, state, w); !status) return fail(std::move(status));

  State<F> between = state;
  while (cursor.sample < times.n_samples) {
    if (Status status = Method::step(field, times.end, state, w); !status) return fail(std::move(status));
    ++w.counters.n_steps;
    ++cursor.step;
    while (cursor.sample < times.n_samples && times[cursor.sample + 1] <= state.t) {
      const double t = times[cursor.sample + 1];
      if (Status status = Method::interpolate(field, t, between, w); !status) return fail(std::move(status));
      cursor = {cursor.sample + 1, 0};
      if (Status status = hooks.sample(cursor.sample, between, w); !status) return fail(std::move(status));
    }
    if (!hooks.step_done(cursor, state, w)) return {Outcome::interrupted, "interrupted", state.t};
  }
  return {Outcome::finished, "", state.t};
}

}  // namespace pseudorigid::mechanics
