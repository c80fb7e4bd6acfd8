#pragma once
/// Pilot runs: a short piece of the motion, computed to find out what method and step a tolerance asks for.

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "mechanics/methods.h"
#include "mechanics/time_loop.h"

namespace pseudorigid::mechanics {

struct StepRequest {
  double end = 0;                    ///< T
  double window = 0;                 ///< w, of the pilot runs
  double tolerance = 0;              ///< of the configuration over [0, T]
  double rattle_limit = 0;           ///< step at which RATTLE is still stable (rattle_step_limit); others scale with it
  double step_bound = HUGE_VAL;      ///< largest outer step that the user allows
  double interval = HUGE_VAL;        ///< between samples: methods with fixed steps have no longer ones
  std::optional<MethodId> method{};  ///< empty: the cheapest
  std::function<bool()> give_up = {};  ///< asked after every pilot step; true ends the search
};

namespace detail {

inline constexpr double error_safety = 0.5;  ///< part of the tolerance that the estimate may use
inline constexpr long max_pilot_samples = 32;
/// Differences above this, in the system's unit of length, say nothing of the order: beyond it lie collisions and
/// chaos.
inline constexpr double asymptotic_difference = 0.1;
/// Forces of one pilot run, and of the search for the step of one method. A collapse could take any number of them.
inline constexpr long max_pilot_forces = 4'000'000;

/// The configuration at the samples of a pilot run, and the size of the velocity.
template <class Configuration>
struct PilotRun {
  Status status;
  double t = 0;  ///< time reached
  std::vector<Configuration> q;
  double speed = 0;
};

/// Q_of(state) is what the tolerance speaks of.
template <class S, class QOf>
struct PilotHooks {
  using Configuration = std::decay_t<std::invoke_result_t<QOf, const State<S>&>>;
  const QOf& Q_of;
  long n_steps;
  const std::function<bool()>& give_up;
  PilotRun<Configuration> run{};

  template <class W>
  Status sample(long, const State<S>& state, const W&) {
    run.q.push_back(Q_of(state));
    run.speed = std::max(run.speed, max_norm(state.v));
    return {};
  }
  template <class W>
  long steps_per_interval(long, const State<S>&, const W&) const {
    return n_steps;
  }
  template <class W>
  bool step_done(Cursor, const State<S>&, const W& w) const {
    return w.counters.n_force < max_pilot_forces && !(give_up && give_up());
  }
};

/// Of a pilot run that has not reached its end.
inline Status failure_of(RunResult result) {
  return Status::failure(result.outcome == Outcome::failed ? std::move(result.reason)
                                                           : "it takes too many steps to look ahead");
}

template <class Configuration>
double largest_difference(const PilotRun<Configuration>& a, const PilotRun<Configuration>& b) {
  double d = 0;
  for (std::size_t k = 0; k < a.q.size(); ++k) {
    Configuration difference = a.q[k];
    axpy(-1.0, b.q[k], difference);
    d = std::max(d, max_norm(difference));
  }
  return d;
}

/// Random walk of round-off through N substeps of size h: of the velocity itself, or, where sums are compensated, of
/// the kicks alone, which are smaller by hω.
template <class S>
double round_off_walk(double speed, double end, double n_substeps, double h_omega) {
  const double part = VectorSpace<typename S::Vector>::compensated ? std::min(1.0, h_omega) : 1.0;
  return 0.5 * std::numeric_limits<double>::epsilon() * (1 + part * std::sqrt(n_substeps) * std::max(1.0, speed * end));
}

/// What one method offers.
struct Trial {
  enum class Verdict { accepted, dearer, failed } verdict = Verdict::failed;
  MethodId method = id_of<Rattle>;
  double limit = 0, step = 0;  ///< outer step; of an adaptive method: its bound
  double local_tolerance = 0;  ///< of an adaptive method
  double error = 0, n_forces_of_run = 0;
  bool at_round_off = false;
  std::string reason{};
};

}  // namespace detail

}  // namespace pseudorigid::mechanics
