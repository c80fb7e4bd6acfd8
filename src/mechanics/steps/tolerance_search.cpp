#include "mechanics/steps/tolerance_search.h"

#include <algorithm>
#include <limits>

namespace pseudorigid::mechanics::detail {

Trial search_tolerance(const StepRequest& request, bool compensated, const AdaptiveMethod& method, long& n_force) {
  constexpr int max_trials = 6;
  constexpr double finer = 16, least_tolerance = finer * 4 * std::numeric_limits<double>::epsilon();
  const double target = error_safety * request.tolerance, times = std::max(1.0, request.end / pilot_window(request));
  Trial trial{.method = method.id, .limit = request.step_bound, .step = request.step_bound};
  double tau = std::max(least_tolerance, target / (10 * times * times));
  for (int i = 0; i < max_trials; ++i) {
    const PilotRun coarse = method.pilot(tau), fine = method.pilot(tau / finer);
    n_force += coarse.n_force + fine.n_force;
    trial.reason = !fine.status ? fine.status.reason() : coarse.status.reason();
    if (!trial.reason.empty()) return trial;
    const double n_forces_of_run = static_cast<double>(coarse.n_force) * times;
    const double walk = round_off_walk(compensated, coarse.speed, request.end, n_forces_of_run, 1);
    const double e = largest_difference(coarse, fine) * times * times;
    if (e <= target || e <= walk || tau <= least_tolerance) {
      trial.verdict = Trial::Verdict::accepted;
      trial.local_tolerance = e > target ? tau / finer : tau;
      trial.error = e + walk;
      trial.at_round_off = std::max(e, walk) > target;
      trial.n_forces_of_run = n_forces_of_run;
      return trial;
    }
    tau = std::max(least_tolerance, tau * std::min(0.25, 0.5 * target / e));
  }
  trial.reason = "the error does not fall with the local tolerance; the motion is too sensitive for this tolerance";
  return trial;
}

}  // namespace pseudorigid::mechanics::detail
