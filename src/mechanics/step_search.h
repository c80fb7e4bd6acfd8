#pragma once
/// The step of one method from a tolerance of the time error of the configuration over a run of length T (maximum norm
/// over samples).
///
/// Pilot runs over a window w ≤ T with steps h and h/2 give, for a method of order p, Richardson's estimate
///
///   e(h) = max_k |Q_h(t_k) − Q_{h/2}(t_k)| · 2^p/(2^p − 1) · T/w.
///
/// T/w supposes that the error grows linearly beyond the window, as it does for symmetric methods on regular motions
/// (Hairer, Lubich, Wanner, Geometric Numerical Integration, X.3): the window should hold several periods of the
/// slowest motion that matters, and on a chaotic motion nothing but w = T is safe. From the stability limit the step is
/// halved until e ≤ target or until e, small by then, falls by 2^p (to within √2); then e ~ hᵖ gives the step, without
/// runs as fine as it, and with a reserve of 2^(p/4) for what such runs would have shown.
///
/// Round-off walks at random through the velocity and so costs about
///
///   e₀ = ½ ε √N max(1, |v|_∞ T),   N substeps,
///
/// of accuracy, times hω where sums are compensated: no step smaller than where e = e₀ is taken.

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "mechanics/pilot_run.h"

namespace pseudorigid::mechanics {

namespace detail {

inline constexpr int max_step_halvings = 12;
/// Pilot runs meet constraints that cost a solve to this part of the difference that two of them may have: the steps
/// found are the same to three digits (measured for the ball with 0 … 5e-3; with 5e-2 one changed by 4 %).
inline constexpr double pilot_constraint = 5e-3;
/// Of a run; more would take hours.
inline constexpr double max_run_forces = 1e11;

template <ConstrainedSystem S, class QOf>
class StepSearch {
  using Pilot = PilotRun<typename PilotHooks<S, QOf>::Configuration>;

 public:
  StepSearch(const S& system, const State<S>& initial, const StepRequest& request, const QOf& Q_of)
      : system_(system),
        initial_(initial),
        request_(request),
        Q_of_(Q_of),
        window_(std::min(request.window, request.end)) {}

  /// The step of one method; given up as soon as it needs more than `n_forces_to_beat` forces for the run.
  template <class Method>
  Trial try_method(MethodId id, double n_forces_to_beat) {
    Trial trial{.method = id, .limit = limit<Method>()};
    if (!(least_forces<Method>() <= max_run_forces)) {
      trial.reason = "the stable step is so small that the run would take more than 1e11 of them";
      return trial;
    }
    const Grid grid(window_, trial.limit);
    const long n_force_at_start = n_force_;
    long n = grid.n_steps;
    double d_before = 0;
    Pilot coarse = pilot<Method>(grid.n_samples, n);
    for (int halving = 0; halving <= max_step_halvings; ++halving, n *= 2) {
      Pilot fine = pilot<Method>(grid.n_samples, 2 * n);
      const double h = window_ / static_cast<double>(grid.n_samples * n);
      const bool both = coarse.status.ok() && fine.status.ok();
      const double d = both ? largest_difference(coarse, fine) : 0;
      if (both && settle<Method>(trial, h, d, d_before, fine.speed)) return trial;
      if ((both ? predicted_forces<Method>(h, d) : run_forces<Method>(h)) >= n_forces_to_beat) {
        trial.verdict = Trial::Verdict::dearer;
        return trial;
      }
      trial.reason = !fine.status ? fine.status.reason() : coarse.status.reason();
      if (motion_ends(coarse, fine, h) || given_up()) return trial;
      if (n_force_ - n_force_at_start > max_pilot_forces) break;
      d_before = d;
      coarse = std::move(fine);
    }
    if (trial.reason.empty())
      trial.reason = "the error does not fall with the step as the order of the method promises";
    return trial;
  }

  /// Forces of the whole run at the stability limit: the least that a method can cost.
  template <class Method>
  double least_forces() const {
    return run_forces<Method>(limit<Method>());
  }
  long n_force() const { return n_force_; }

  bool given_up() const { return request_.give_up && request_.give_up(); }

 private:
  /// The target of the estimate e.
  double allowed_error() const { return error_safety * request_.tolerance; }

  /// n_samples times n_steps steps, none longer than h, fill the window; as few steps as the choice of n_samples
  /// allows.
  struct Grid {
    long n_samples, n_steps;
    Grid(double window, double h) {
      const long n = std::max(1L, static_cast<long>(std::ceil(window / h * (1 - 1e-12))));
      n_samples = std::min(n, max_pilot_samples);
      n_steps = (n + n_samples - 1) / n_samples;
      for (long fewer = n_samples - 1; fewer >= max_pilot_samples / 2; --fewer)
        if (const long steps = (n + fewer - 1) / fewer; fewer * steps < n_samples * n_steps) {
          n_samples = fewer;
          n_steps = steps;
        }
    }
  };

  /// Steps h and h/2 that fail at nearly the same time, many steps from the start: it is the motion that ends there,
  /// and no step helps. (Steps beyond stability fail within the first few.)
  static bool motion_ends(const Pilot& coarse, const Pilot& fine, double h) {
    return !coarse.status && !fine.status && coarse.t > 8 * h && std::abs(coarse.t - fine.t) <= 0.2 * coarse.t;
  }

  template <class Method>
  double limit() const {
    return std::min(request_.rattle_limit * (Method::stability_limit / Rattle::stability_limit),
                    std::min(request_.step_bound, request_.interval));
  }
  template <class Method>
  double run_forces(double h) const {
    return std::ceil(request_.end / h) * Method::n_stages;
  }

  /// Forces of the run if the difference d at h falls as the order promises. Above the asymptotic regime errors
  /// saturate and this is too small, so a method that it rules out is ruled out.
  template <class Method>
  double predicted_forces(double h, double d) const {
    constexpr double p = Method::order;
    const double e = d * std::max(1.0, request_.end / window_), target = allowed_error();
    return run_forces<Method>(h) * std::max(1.0, std::pow(e / target, 1 / p));
  }

  template <class Method>
  Pilot pilot(long n_samples, long n_steps) {
    PilotHooks<S, QOf> hooks{Q_of_, n_steps, request_.give_up};
    State<S> state = initial_;
    typename Method::template Workspace<S> workspace(system_);
    if constexpr (requires { workspace.constraint_tolerance; } && !VectorSpace<typename S::Vector>::dense)
      workspace.constraint_tolerance =
          std::max(workspace.constraint_tolerance, pilot_constraint * allowed_error() * window_ / request_.end);
    Cursor cursor;
    RunResult result = run_time_loop<Method>(system_, {window_, n_samples}, state, cursor, workspace, hooks);
    n_force_ += workspace.counters.n_force;
    hooks.run.t = result.t;
    if (result.outcome != Outcome::finished) hooks.run.status = failure_of(std::move(result));
    return std::move(hooks.run);
  }

  /// Sets the step if the differences d at h, and d_before at 2h (0: unknown), suffice to say it.
  template <class Method>
  bool settle(Trial& trial, double h, double d, double d_before, double speed) const {
    constexpr double p = Method::order;
    const double richardson = std::exp2(p) / (std::exp2(p) - 1) * std::max(1.0, request_.end / window_);
    const double e = d * richardson, target = allowed_error();
    const double walk = round_off<Method>(speed, h);
    const double fall = d > 0 && d_before > 0 ? std::log2(d_before / d) : 0;
    const bool regular = fall >= p - 0.5 && d <= asymptotic_difference, enough = e <= target || e <= walk;

    if (!regular && !enough) return false;
    if (fall == 0 || e == 0) {
      // The grid of the pilot rounds its step down; where accuracy has room, the limit itself is taken.
      const double step = std::min(trial.limit, h * std::clamp(e > 0 ? std::pow(target / e, 1 / p) : 1.25, 1.0, 1.25));
      return accept<Method>(trial, step, e * std::pow(step / h, p), walk);
    }
    const double exponent = e > target ? p : std::max(p, fall);  // never trust a fast fall to go on
    const double h_accuracy = h * (e > target ? std::exp2(-0.25) : 1.0) * std::pow(target / e, 1 / exponent);
    const double h_round_off = h * std::pow(walk / e, 1 / (p + 0.5));  // e (h'/h)^p = walk (h/h')^½
    const double step = std::min(std::max(h_accuracy, h_round_off), trial.limit);
    return accept<Method>(trial, step, e * std::pow(step / h, p), round_off<Method>(speed, step));
  }

  template <class Method>
  bool accept(Trial& trial, double step, double truncation, double walk) const {
    trial.verdict = Trial::Verdict::accepted;
    trial.step = step;
    trial.error = truncation + walk;
    trial.at_round_off = walk > allowed_error();
    trial.n_forces_of_run = run_forces<Method>(step);
    return true;
  }

  template <class Method>
  double round_off(double speed, double h) const {
    const double h_omega = Rattle::stability_limit * h / (Method::n_stages * request_.rattle_limit);
    return round_off_walk<S>(speed, request_.end, run_forces<Method>(h), h_omega);
  }

  const S& system_;
  const State<S>& initial_;
  const StepRequest& request_;
  const QOf& Q_of_;
  double window_;
  long n_force_ = 0;
};

}  // namespace detail

}  // namespace pseudorigid::mechanics
