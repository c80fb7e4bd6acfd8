#pragma once
/// Method and step from a tolerance of the time error of Q over a run of length T (maximum norm over samples).
///
/// Pilot runs over a window w ≤ T with steps h and h/2 give, for a method of order p, Richardson's estimate
///
///   e(h) = max_k |Q_h(t_k) − Q_{h/2}(t_k)| · 2^p/(2^p − 1) · T/w.
///
/// T/w supposes that the error grows linearly beyond the window, as it does for symmetric methods on regular motions
/// (Hairer, Lubich, Wanner, Geometric Numerical Integration, X.3): the window should hold several periods of the
/// slowest motion that matters, and on a chaotic motion nothing but w = T is safe. From the stability limit the step is
/// halved until e ≤ target or until e falls by 2^p (to within √2); then e ~ hᵖ gives the step, without runs as fine as
/// it.
///
/// Round-off walks at random through the velocity and so costs about
///
///   e₀ = ½ ε √N max(1, |v|_∞ T),   N substeps,
///
/// of accuracy (within a factor 5 of measurements on SL(3) up to T = 1000): no step smaller than where e = e₀ is taken.

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "mechanics/constrained_system.h"
#include "mechanics/methods.h"
#include "mechanics/time_loop.h"

namespace pseudorigid::mechanics {

struct StepRequest {
  double end = 0;                    ///< T
  double window = 0;                 ///< w, of the pilot runs
  double tolerance = 0;              ///< of Q over [0, T]
  double rattle_limit = 0;           ///< step at which RATTLE is still stable (rattle_step_limit); others scale with it
  double step_bound = HUGE_VAL;      ///< largest outer step that the user allows
  std::optional<MethodId> method{};  ///< empty: the cheapest
  bool (*give_up)() = nullptr;       ///< asked after every pilot step; true ends the search
};

/// What to run with, or why nothing can be run. Times are those of the system, that is internal units.
struct [[nodiscard]] StepChoice {
  Status status{};
  MethodId method = MethodId::rattle;
  double step = 0;          ///< outer (composed) step, an upper bound
  double error = 0;         ///< estimated error of Q over the run
  double rattle_limit = 0;  ///< as requested
  long n_force = 0;         ///< forces spent on pilot runs
  std::string why{};        ///< one sentence for the log
};

/// Step at which RATTLE is stable with some reserve: safety · 2/(ω + |Q⁻¹Q̇|₂). The rate of the affine motion stands for
/// the turning and stretching of the modes themselves.
inline double rattle_step_limit(double omega, const Eigen::Matrix3d& Q, const Eigen::Matrix3d& Qdot,
                                double safety = 0.8) {
  const Eigen::Matrix3d L = Q.inverse() * Qdot;
  const double rate =
      std::sqrt(std::max(0.0, (L.transpose() * L).eval().selfadjointView<Eigen::Lower>().eigenvalues()(2)));
  return safety * Rattle::stability_limit / (omega + rate);
}

namespace detail {

inline constexpr int max_step_halvings = 12;
inline constexpr double error_safety = 0.5;  ///< part of the tolerance that the estimate may use
inline constexpr long max_pilot_samples = 32;
/// A method that needs this many times the least cost of a method of higher order is not pursued.
inline constexpr double clearly_dearer = 4;

/// One pilot run: Q at the samples, and the size of the velocity.
struct PilotRun {
  Status status;
  double t = 0;  ///< time reached
  std::vector<Eigen::Matrix3d> Q;
  double speed = 0;
};

template <ConstrainedSystem S, class QOf>
struct PilotHooks {
  const QOf& Q_of;
  long n_steps;
  bool (*give_up)();
  PilotRun run{};

  template <class W>
  Status sample(long, const State<S>& state, const W&) {
    run.Q.push_back(Q_of(state));
    run.speed = std::max(run.speed, max_norm(state.v));
    return {};
  }
  template <class W>
  long steps_per_interval(long, const State<S>&, const W&) const {
    return n_steps;
  }
  template <class W>
  bool step_done(Cursor, const State<S>&, const W&) const {
    return !give_up || !give_up();
  }
};

inline double largest_difference(const PilotRun& a, const PilotRun& b) {
  double d = 0;
  for (std::size_t k = 0; k < a.Q.size(); ++k) d = std::max(d, (a.Q[k] - b.Q[k]).lpNorm<Eigen::Infinity>());
  return d;
}

/// What one method offers.
struct Trial {
  enum class Verdict { accepted, dearer, failed } verdict = Verdict::failed;
  MethodId method = MethodId::rattle;
  double limit = 0, step = 0, error = 0, n_forces_of_run = 0;
  bool at_round_off = false;
  std::string reason{};
};

inline std::string describe(const Trial& chosen, const StepRequest& request, const std::vector<Trial>& others) {
  std::ostringstream s;
  s.precision(3);
  s << method_name(chosen.method) << " with steps of at most " << chosen.step << " internal time units ("
    << (chosen.step < 0.99 * chosen.limit           ? "set by accuracy"
        : request.step_bound <= chosen.limit * 1.01 ? "the bound given"
                                                    : "set by stability")
    << "): estimated time error of Q " << chosen.error << ", tolerance " << request.tolerance;
  if (chosen.at_round_off) s << ", which is below what double precision gives over this run";
  s << "; " << chosen.n_forces_of_run << " forces";
  for (const Trial& other : others)
    if (other.method != chosen.method && other.verdict == Trial::Verdict::accepted)
      s << ", " << method_name(other.method) << " would need " << other.n_forces_of_run;
  return s.str();
}

template <ConstrainedSystem S, class QOf>
class StepSearch {
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
    const Grid grid(window_, trial.limit);
    long n = grid.n_steps;
    double d_before = 0;
    PilotRun coarse = pilot<Method>(grid.n_samples, n);
    for (int halving = 0; halving <= max_step_halvings; ++halving, n *= 2) {
      PilotRun fine = pilot<Method>(grid.n_samples, 2 * n);
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
  static bool motion_ends(const PilotRun& coarse, const PilotRun& fine, double h) {
    return !coarse.status && !fine.status && coarse.t > 8 * h && std::abs(coarse.t - fine.t) <= 0.2 * coarse.t;
  }

  template <class Method>
  double limit() const {
    return std::min(request_.rattle_limit * (Method::stability_limit / Rattle::stability_limit), request_.step_bound);
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
    const double e = d * std::max(1.0, request_.end / window_), target = error_safety * request_.tolerance;
    return run_forces<Method>(h) * std::max(1.0, std::pow(e / target, 1 / p));
  }

  template <class Method>
  PilotRun pilot(long n_samples, long n_steps) {
    PilotHooks<S, QOf> hooks{Q_of_, n_steps, request_.give_up};
    State<S> state = initial_;
    typename Method::template Workspace<S> workspace(system_);
    Cursor cursor;
    RunResult result = run_time_loop<Method>(system_, {window_, n_samples}, state, cursor, workspace, hooks);
    n_force_ += workspace.counters.n_force;
    hooks.run.t = result.t;
    if (result.outcome != Outcome::finished) hooks.run.status = Status::failure(std::move(result.reason));
    return std::move(hooks.run);
  }

  /// Sets the step if the differences d at h, and d_before at 2h (0: unknown), suffice to say it.
  template <class Method>
  bool settle(Trial& trial, double h, double d, double d_before, double speed) const {
    constexpr double p = Method::order;
    const double richardson = std::exp2(p) / (std::exp2(p) - 1) * std::max(1.0, request_.end / window_);
    const double e = d * richardson, target = error_safety * request_.tolerance;
    const double walk = round_off(speed, request_.end, run_forces<Method>(h));
    const double fall = d > 0 && d_before > 0 ? std::log2(d_before / d) : 0;
    const bool regular = fall >= p - 0.5, enough = e <= target || e <= walk;

    if (!regular && !enough) return false;
    if (fall == 0 || e == 0) {
      // The grid of the pilot rounds its step down; where accuracy has room, the limit itself is taken.
      const double step = std::min(trial.limit, h * std::clamp(e > 0 ? std::pow(target / e, 1 / p) : 1.25, 1.0, 1.25));
      return accept<Method>(trial, step, e * std::pow(step / h, p), walk);
    }
    const double exponent = e > target ? p : std::max(p, fall);  // never trust a fast fall to go on
    const double h_accuracy = h * std::pow(target / e, 1 / exponent);
    const double h_round_off = h * std::pow(walk / e, 1 / (p + 0.5));  // e (h'/h)^p = walk (h/h')^½
    const double step = std::min(std::max(h_accuracy, h_round_off), trial.limit);
    return accept<Method>(trial, step, e * std::pow(step / h, p),
                          round_off(speed, request_.end, run_forces<Method>(step)));
  }

  template <class Method>
  bool accept(Trial& trial, double step, double truncation, double walk) const {
    trial.verdict = Trial::Verdict::accepted;
    trial.step = step;
    trial.error = truncation + walk;
    trial.at_round_off = walk > error_safety * request_.tolerance;
    trial.n_forces_of_run = run_forces<Method>(step);
    return true;
  }

  static double round_off(double speed, double end, double n_substeps) {
    return 0.5 * std::numeric_limits<double>::epsilon() * std::sqrt(n_substeps) * std::max(1.0, speed * end);
  }

  const S& system_;
  const State<S>& initial_;
  const StepRequest& request_;
  const QOf& Q_of_;
  double window_;
  long n_force_ = 0;
};

}  // namespace detail

/// The cheapest method, or the step of the one that is asked for. Methods are tried by rising order, as long as the
/// next one at its stability limit would be cheaper than the best so far at the step that accuracy asks of it, and
/// dropped as soon as a pilot shows that a higher order must be cheaper.
/// Q_of(state) → Eigen::Matrix3d. `initial` is at t = 0. A pilot run that fails is repeated with half the step.
template <ConstrainedSystem S, class QOf>
StepChoice choose_step(const S& system, const State<S>& initial, const StepRequest& request, const QOf& Q_of) {
  detail::StepSearch<S, QOf> search(system, initial, request, Q_of);
  std::vector<detail::Trial> trials;
  std::optional<detail::Trial> best;
  bool broken_off = false;
  // The least that a method of higher order can cost, if there is a choice.
  const auto least_forces_above = [&](MethodId id) {
    double least = HUGE_VAL;
    for (const MethodId other : all_methods)
      if (other > id && !request.method)
        with_method(other,
                    [&]<class Method>(Method) { least = std::min(least, search.template least_forces<Method>()); });
    return least;
  };
  for (const MethodId id : all_methods) {
    if (request.method && *request.method != id) continue;
    if (broken_off) break;  // a motion that ends within the window ends for every method
    with_method(id, [&]<class Method>(Method) {
      const double cheapest = best ? best->n_forces_of_run : HUGE_VAL;
      if (search.template least_forces<Method>() >= cheapest) return;
      const double to_beat = std::min(cheapest, detail::clearly_dearer * least_forces_above(id));
      trials.push_back(search.template try_method<Method>(id, to_beat));
      const detail::Trial& trial = trials.back();
      broken_off = trial.verdict == detail::Trial::Verdict::failed;
      if (trial.verdict == detail::Trial::Verdict::accepted && trial.n_forces_of_run < cheapest) best = trial;
    });
  }

  StepChoice choice{.rattle_limit = request.rattle_limit, .n_force = search.n_force()};
  if (!best) {
    choice.status = Status::failure("no step of " + std::string(method_name(trials.back().method)) +
                                    " can be found: " + trials.back().reason);
    return choice;
  }
  choice.method = best->method;
  choice.step = best->step;
  choice.error = best->error;
  choice.why = detail::describe(*best, request, trials);
  return choice;
}

}  // namespace pseudorigid::mechanics
