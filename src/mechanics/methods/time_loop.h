#pragma once
/// The time loop. Samples t_k = k T/N, k = 0 … N; each interval holds a whole number n of steps, so that samples do not
/// disturb the steps and the last sample is T exactly:  h = (t_{k+1} − t_k)/n,  t = t_k + j h.  If the method
/// interpolates, a whole number of steps may hold any number of samples (Stretch).

#include <algorithm>
#include <cmath>
#include <concepts>
#include <string>
#include <type_traits>
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
  /// Least whole number of steps, none longer than `step`, that fills an interval.
  long steps_per_interval(double step) const {
    const double n = std::ceil(interval() / step * (1 - 1e-12));
    constexpr double most = 9e18;  // below the largest long; run_time_loop refuses steps long before
    return static_cast<long>(std::clamp(n, 1.0, most));
  }
};

/// Samples `first` to `last`, with a whole number of steps of equal length between them. It is one interval, unless the
/// method interpolates: then further samples lie within the steps, which do not depend on them.
struct Stretch {
  long first = 0, last = 1, n_steps = 1;
};

/// Where a run stands: `step` steps of the stretch that it is in are done, and the samples up to `sample` are taken.
struct Cursor {
  long sample = 0, step = 0;
};

struct RunResult {
  Outcome outcome = Outcome::finished;
  std::string reason;  ///< of a failure: one sentence
  double t = 0;        ///< time reached
};

/// Actions of the caller during the loop.
///   sample(k, state, workspace) → Status: at sample k (k = 0 included), the velocity being projected;
///   steps_per_interval(k, state, workspace) → long: steps from sample k to k+1 (not asked by adaptive methods);
///   stretch(k, state, workspace) → Stretch: optional, in place of steps_per_interval; the one that begins at sample k,
///     or that the run is in;
///   step_done(cursor, state, workspace) → bool: after each step; false interrupts the run. All samples up to the
///   state's time have been taken then.
template <class H, class S, class W>
concept TimeLoopHooks = requires(H hooks, long k, const State<S> state, W w, Cursor cursor) {
  { hooks.sample(k, state, w) } -> std::same_as<Status>;
  { hooks.steps_per_interval(k, state, w) } -> std::convertible_to<long>;
  { hooks.step_done(cursor, state, w) } -> std::same_as<bool>;
};

namespace detail {

template <class Hooks>
Stretch stretch_of(Hooks& hooks, long k, const auto& state, auto& w) {
  if constexpr (requires { hooks.stretch(k, state, w); })
    return hooks.stretch(k, state, w);
  else
    return {k, k + 1, hooks.steps_per_interval(k, state, w)};
}

/// Takes the samples of a stretch but its last one, as far as the time t.
template <class Method, class S, class W, class Hooks>
Status sample_within(const S& system, const SampleTimes& times, const Stretch& stretch, double t, Cursor& cursor,
                     State<S>& between, W& w, Hooks& hooks) {
  while (cursor.sample + 1 < stretch.last && times[cursor.sample + 1] <= t) {
    ++cursor.sample;
    if (Status status = Method::interpolate(system, times[cursor.sample], between, w); !status) return status;
    if (Status status = hooks.sample(cursor.sample, between, w); !status) return status;
  }
  return {};
}

}  // namespace detail

/// Runs from `cursor` (the start, or where a checkpoint was written) to the last sample. `cursor` and `state` are left
/// where the run ended; after a failure the state is that of the failing step and not to be used.
template <class Method, class S, TimeLoopHooks<S, typename Method::template Workspace<S>> Hooks>
requires(!Method::adaptive) RunResult
    run_time_loop(const S& system, const SampleTimes& times, State<S>& state, Cursor& cursor,
                  typename Method::template Workspace<S>& w, Hooks& hooks) {
  const auto fail = [&](Status status) { return RunResult{Outcome::failed, status.reason(), state.t}; };
  if (cursor.sample == 0 && cursor.step == 0)
    if (Status status = hooks.sample(0, state, w); !status) return fail(std::move(status));

  constexpr bool interpolates = requires(State<S> & between) { Method::interpolate(system, 0.0, between, w); };
  std::conditional_t<interpolates, State<S>, const State<S>&> between = state;
  while (cursor.sample < times.n_samples) {
    const Stretch stretch = detail::stretch_of(hooks, cursor.sample, state, w);
    const double t_start = times[stretch.first], t_end = times[stretch.last];
    const long n = stretch.n_steps;
    const double h = (t_end - t_start) / static_cast<double>(n);
    if (!(t_end - h < t_end))
      return fail(Status::failure("the step is shorter than the least difference of times in double precision"));
    for (; cursor.step < n;) {
      state.t = t_start + static_cast<double>(cursor.step) * h;
      if (Status status = Method::advance(system, h, state, w); !status) return fail(std::move(status));
      ++w.counters.n_steps;
      ++cursor.step;
      if constexpr (interpolates) {
        const double reached = cursor.step < n ? t_start + static_cast<double>(cursor.step) * h : t_end;
        if (Status status = detail::sample_within<Method>(system, times, stretch, reached, cursor, between, w, hooks);
            !status)
          return fail(std::move(status));
      }
      if (!hooks.step_done(cursor, state, w)) return {Outcome::interrupted, "interrupted", state.t};
    }
    state.t = t_end;
    if (Status status = Method::project_velocity(system, state, w); !status) return fail(std::move(status));
    cursor = {stretch.last, 0};
    if (Status status = hooks.sample(cursor.sample, state, w); !status) return fail(std::move(status));
  }
  return {Outcome::finished, "", state.t};
}

/// The same with steps of the method's own choice: they run past the samples, which are interpolated; the last one ends
/// at T.
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
