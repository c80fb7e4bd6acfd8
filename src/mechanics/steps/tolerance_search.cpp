#include "mechanics/steps/tolerance_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace pseudorigid::mechanics::detail {
namespace {

/// Returns |q|_∞ of the configuration q at the first sample, or 0 if the run has no samples.
double size_of(const PilotRun& pilot) { return pilot.q.empty() ? 0 : max_norm<Eigen::VectorXd>(pilot.q.front()); }

/// Effect of round-off on a pilot run. Two other pilot runs are perturbed by round-off in opposite directions.
/// `difference` is the largest distance of their configurations from those of the unperturbed run, in the maximum norm.
struct RoundOff {
  double difference = 0;
  bool magnified = false;               ///< true if `difference` is more than 1000 times that of a random walk
  std::optional<double> beyond_from{};  ///< time of the first sample with a distance above the bound; empty if none
};

/// Makes the two perturbed pilot runs with the local tolerance `tau` and compares them with `pilot`. `bound` is the
/// bound of the distance for `beyond_from`. Adds the number of force evaluations of the two runs to n_force.
RoundOff round_off_of(const StepRequest& request, const AdaptiveMethod& method, double tau, const PilotRun& pilot,
                      double bound, long& n_force) {
  constexpr double much = 1000;
  RoundOff found;
  for (const double part : {1.0, -1.0}) {
    const PilotRun twin = method.kicked_pilot(tau, part);
    n_force += twin.n_force;
    for (std::size_t k = 0; k < std::min(twin.q.size(), pilot.q.size()); ++k) {
      const double d = max_norm<Eigen::VectorXd>(twin.q[k] - pilot.q[k]);
      found.difference = std::max(found.difference, d);
      const double t = pilot_window(request) * static_cast<double>(k) / max_pilot_samples;
      if (d > bound && !(found.beyond_from && *found.beyond_from <= t)) found.beyond_from = t;
    }
    const double walk =
        round_off_walk(false, pilot.speed, pilot_window(request), static_cast<double>(twin.n_force), 1) *
        std::max(1.0, size_of(pilot));
    found.magnified |= found.difference > much * walk;
  }
  return found;
}

/// Returns true if the system is at rest in the pilot run: all velocities are zero, and all configurations equal the
/// first one, up to round-off.
bool rests(const PilotRun& pilot) {
  const double round_off = 16 * std::numeric_limits<double>::epsilon() * std::max(1.0, size_of(pilot));
  return pilot.speed <= round_off && std::ranges::all_of(pilot.q, [&](const Eigen::VectorXd& q) {
           return max_norm<Eigen::VectorXd>(q - pilot.q.front()) <= round_off;
         });
}

}  // namespace

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
    const bool still = rests(coarse) && rests(fine);
    const double e = largest_difference(coarse, fine) * (still ? 1 : times * times);
    if (e <= target || e <= walk || tau <= least_tolerance) {
      trial.verdict = Trial::Verdict::accepted;
      trial.local_tolerance = e > target ? tau / finer : tau;
      RoundOff round_off;
      if (!request.spare_pilots)
        round_off = round_off_of(request, method, tau, coarse, request.tolerance / (times * times), n_force);
      const bool at_rest = still && !round_off.magnified;
      const double growth = at_rest ? 1 : std::pow(times, round_off.magnified ? 2 : 1.5);
      trial.error = e + std::max(walk, round_off.difference * growth);
      trial.at_round_off = std::max(e, walk) > target || (!round_off.magnified && trial.error > request.tolerance);
      if (round_off.magnified) trial.round_off_rules_from = round_off.beyond_from;
      trial.n_forces_of_run = at_rest ? static_cast<double>(coarse.n_force) : n_forces_of_run;
      return trial;
    }
    tau = std::max(least_tolerance, tau * std::min(0.25, 0.5 * target / e));
  }
  trial.reason = "the error does not fall with the local tolerance; the motion is too sensitive for this tolerance";
  return trial;
}

}  // namespace pseudorigid::mechanics::detail
