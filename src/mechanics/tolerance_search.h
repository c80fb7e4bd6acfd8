#pragma once
/// The local tolerance of an adaptive method from a tolerance of the time error of the configuration over a run of
/// length T: pilot runs over a window w ≤ T with local tolerances τ and τ/16 give
///
///   e(τ) = max_k |q_τ(t_k) − q_{τ/16}(t_k)| · (T/w)²,
///
/// for the error of a method without geometric structure grows like t² (its energy drifts; Hairer, Lubich, Wanner,
/// Geometric Numerical Integration, X.3). Then e ~ τ gives the tolerance.

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "mechanics/pilot_run.h"

namespace pseudorigid::mechanics::detail {

template <class F, class QOf>
class ToleranceSearch {
  using Pilot = PilotRun<typename PilotHooks<F, QOf>::Configuration>;

 public:
  ToleranceSearch(const F& field, const State<F>& initial, const StepRequest& request, const QOf& Q_of)
      : field_(field),
        initial_(initial),
        request_(request),
        Q_of_(Q_of),
        window_(std::min(request.window, request.end)) {}

  template <class Method>
  Trial try_method() {
    constexpr int max_trials = 6;
    constexpr double finer = 16, least_tolerance = finer * 4 * std::numeric_limits<double>::epsilon();
    const double target = error_safety * request_.tolerance, times = std::max(1.0, request_.end / window_);
    Trial trial{.method = id_of<Method>, .limit = request_.step_bound, .step = request_.step_bound};
    double tau = std::max(least_tolerance, target / (10 * times * times));
    for (int i = 0; i < max_trials; ++i) {
      long n_force = 0, n_finer = 0;
      const Pilot coarse = pilot<Method>(tau, n_force), fine = pilot<Method>(tau / finer, n_finer);
      n_force_ += n_force + n_finer;
      trial.reason = !fine.status ? fine.status.reason() : coarse.status.reason();
      if (!trial.reason.empty()) return trial;
      const double walk = round_off_walk<F>(coarse.speed, request_.end, static_cast<double>(n_force) * times, 1);
      const double e = largest_difference(coarse, fine) * times * times;
      if (e <= target || e <= walk || tau <= least_tolerance) {
        trial.verdict = Trial::Verdict::accepted;
        trial.local_tolerance = e > target ? tau / finer : tau;
        trial.error = e + walk;
        trial.at_round_off = std::max(e, walk) > target;
        trial.n_forces_of_run = static_cast<double>(n_force) * times;
        return trial;
      }
      tau = std::max(least_tolerance, tau * std::min(0.25, 0.5 * target / e));
    }
    trial.reason = "the error does not fall with the local tolerance; the motion is too sensitive for this tolerance";
    return trial;
  }

  long n_force() const { return n_force_; }

 private:
  template <class Method>
  Pilot pilot(double tau, long& n_force) {
    PilotHooks<F, QOf> hooks{Q_of_, 1, request_.give_up};
    State<F> state = initial_;
    typename Method::template Workspace<F> workspace(field_);
    workspace.tolerance = tau;
    workspace.h_max = request_.step_bound;
    Cursor cursor;
    RunResult result = run_time_loop<Method>(field_, {window_, max_pilot_samples}, state, cursor, workspace, hooks);
    n_force = workspace.counters.n_force;
    hooks.run.t = result.t;
    if (result.outcome != Outcome::finished) hooks.run.status = failure_of(std::move(result));
    return std::move(hooks.run);
  }

  const F& field_;
  const State<F>& initial_;
  const StepRequest& request_;
  const QOf& Q_of_;
  double window_;
  long n_force_ = 0;
};

}  // namespace pseudorigid::mechanics::detail
