#include "mechanics/steps/step_search.h"

#include <limits>
#include <string>
#include <utility>

namespace pseudorigid::mechanics::detail {
namespace {

constexpr int max_step_halvings = 12;
/// Largest number of force evaluations in a run. With 100 ns for a force, such a run takes 3 hours.
constexpr double max_run_forces = 1e11;

/// Division of a window into n_samples intervals with n_steps equal steps each, which are not longer than h. If the
/// window needs at most 32 steps, each step ends at a sample. Otherwise the constructor chooses the number of samples
/// from 16 to 32 such that the total number of steps is smallest.
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

/// Returns true for a multistep method. Only these methods have one force evaluation per step and an order above that
/// of RATTLE, which is 2.
bool is_multistep(const FixedStepMethod& method) { return method.n_stages == 1 && method.order > 2; }

/// Returns the change of the energy over the whole run, extrapolated from a pilot run over the fraction `part` of the
/// run. The pilot run records the energies. The result is relative to the energy of the motion above the least
/// potential energy. It is the sum of an oscillating and a lasting change. The oscillating change is the largest change
/// in the pilot run. The lasting change follows from the difference of the means over both halves, and is assumed to
/// grow like t^(3/2). Returns 0 if the largest change is round-off, or if the motion has no energy above the least
/// potential energy.
double change_of_energy(const PilotRun& run, double part) {
  const double of_halves = 0.8 - 0.2 * std::sqrt(2.0);  // difference of the means of t^(3/2) over both halves of [0, 1]
  const double start = run.q.front().sum();
  const std::size_t middle = run.q.size() / 2;
  double change = 0, size = 1, most = start, least = start, early = 0, late = 0;
  for (std::size_t k = 0; k < run.q.size(); ++k) {
    const Eigen::VectorXd& kinetic_and_potential = run.q[k];
    const double energy = kinetic_and_potential.sum();
    change = std::max(change, std::abs(energy - start));
    size = std::max(size, kinetic_and_potential.lpNorm<Eigen::Infinity>());
    most = std::max(most, energy);
    least = std::min(least, kinetic_and_potential[1]);
    (k < middle ? early : late) += energy - start;
  }
  const double round_off = 64 * std::numeric_limits<double>::epsilon() * size;
  if (change <= round_off || most <= least) return 0;
  const double n_early = static_cast<double>(middle), n_late = static_cast<double>(run.q.size() - middle);
  const double drift = std::abs(late / n_late - early / n_early) / of_halves * std::pow(part, -1.5);
  return (change + drift) / (most - least);
}

/// Returns true if the runs with steps h and h/2 fail at nearly the same time, more than 8 steps h after the start. The
/// motion itself then ends at this time, and a smaller step does not help. An unstable step would fail earlier.
bool motion_ends(const PilotRun& coarse, const PilotRun& fine, double h) {
  return !coarse.status && !fine.status && coarse.t > 8 * h && std::abs(coarse.t - fine.t) <= 0.2 * coarse.t;
}

}  // namespace

/// Finds the step for which the error of the configuration meets the tolerance (step_search.h), without regard to the
/// error of the energy. The verdict of the result is `dearer` if the run would need n_forces_to_beat force evaluations
/// or more.
Trial StepSearch::meet_tolerance(const FixedStepMethod& method, double n_forces_to_beat) {
  Trial trial{.method = method.id, .limit = limit(method)};
  if (!(least_forces(method) <= max_run_forces)) {
    trial.reason = "the stable step is so small that the run would take more than 1e11 of them";
    return trial;
  }
  window_ = window_of(method);
  if (request_.spare_pilots && method.order > 2 && glance(method, trial)) return trial;
  const Grid grid(window_, trial.limit);
  const long n_force_at_start = n_force_;
  long n = grid.n_steps;
  double d_before = 0;
  double others = HUGE_VAL;  // bound of all errors of order 2 or more with the step h
  PilotRun coarse = pilot(method, window_, grid.n_samples, n);
  for (int halving = 0; halving <= max_step_halvings; ++halving, n *= 2) {
    PilotRun fine = pilot(method, window_, grid.n_samples, 2 * n);
    const double h = window_ / static_cast<double>(grid.n_samples * n);
    const bool both = coarse.status.ok() && fine.status.ok();
    const double d = both ? largest_difference(coarse, fine) : 0;
    if (both && settle(method, trial, h, d, d_before, fine.speed)) return trial;
    if (both) {
      const double of_pair = 4 * d / 3, of_pair_before = others / 4;
      others = std::min(of_pair, of_pair_before);
      if (of_pair_before < of_pair && d_before <= asymptotic_difference &&
          leave_oscillation(method, trial, h, d, others, fine.speed))
        return trial;
    }
    if ((both ? predicted_forces(method, h, d) : run_forces(method, h)) >= n_forces_to_beat) {
      trial.verdict = Trial::Verdict::dearer;
      return trial;
    }
    trial.reason = !fine.status ? fine.status.reason() : coarse.status.reason();
    if (motion_ends(coarse, fine, h) || given_up()) return trial;
    if (n_force_ - n_force_at_start > max_pilot_forces) break;
    d_before = d;
    coarse = std::move(fine);
  }
  if (trial.reason.empty()) trial.reason = "the error does not fall with the step as the order of the method promises";
  return trial;
}

/// Returns the length of the pilot runs. For a multistep method of order p the length is at least 4p steps of the
/// largest permitted size, or the whole run if this is shorter.
double StepSearch::window_of(const FixedStepMethod& method) const {
  constexpr double n_steps_per_order = 4;
  const double least = is_multistep(method) ? n_steps_per_order * method.order * limit(method) : 0;
  return std::min(request_.end, std::max(pilot_window(request_), least));
}

/// Returns the predicted number of force evaluations of the run at the step that meets the tolerance. The prediction
/// assumes that the difference d of the pilot runs with h and h/2 decreases according to the order. Large differences
/// are limited by the size of the motion, so the true number may be larger. A method that is too costly by this
/// prediction is therefore too costly in fact.
double StepSearch::predicted_forces(const FixedStepMethod& method, double h, double d) const {
  const double e = d * std::max(1.0, request_.end / window_), target = allowed_error();
  return run_forces(method, h) * std::max(1.0, std::pow(e / target, 1 / method.order));
}

/// Makes the shorter estimate of step_search.h with the largest permitted step, first over 1/8 and then over 1/2 of the
/// window. Multiplies the estimate by its possible growth in the rest of the window. If the product is at most the
/// target, accepts the step and returns true. Tries the longer part only if the estimate of the shorter part meets the
/// target with the smaller factor. Returns false if no part is sufficient, if a part would be longer than the window,
/// or if a pilot run fails.
bool StepSearch::glance(const FixedStepMethod& method, Trial& trial) {
  double error = 0;
  for (double part : {1.0 / 8, 1.0 / 2}) {
    const double window = std::max(part * window_, is_multistep(method) ? 2 * method.order * trial.limit : 0);
    const double doubt = std::pow(window_ / window, 1.5);
    if (window > window_ || doubt * error > allowed_error()) return false;
    const Grid grid(window, trial.limit);
    const PilotRun coarse = pilot(method, window, grid.n_samples, grid.n_steps);
    const PilotRun fine = pilot(method, window, grid.n_samples, 2 * grid.n_steps);
    if (!coarse.status || !fine.status) return false;
    const double p = method.order, h = window / static_cast<double>(grid.n_samples * grid.n_steps);
    error = largest_difference(coarse, fine) * std::exp2(p) / (std::exp2(p) - 1) *
            std::max(1.0, request_.end / window) * std::pow(trial.limit / h, p);
    if (doubt * error <= allowed_error())
      return accept(method, trial, trial.limit, doubt * error, round_off(method, fine.speed, h));
  }
  return false;
}

/// Shortens the step such that the predicted change of the energy over the run is permitted (step_search.h). Does
/// nothing for methods other than multistep methods, for short runs, if the caller does not give the energies or
/// watches them, if the pilot run fails, or if the predicted change is permitted without a shorter step.
void StepSearch::keep_energy(const FixedStepMethod& method, Trial& trial) {
  // The two values and the power in change_of_energy() were chosen after the measurements in step_search.h.
  constexpr double part = 1.0 / 8, least_windows = 5;
  const double window = part * request_.end;
  if (!is_multistep(method) || !method.energies || request_.watches_energy) return;
  if (window < least_windows * pilot_window(request_)) return;
  const Grid grid(window, trial.step);
  const PilotRun run = method.energies(window, grid.n_samples, grid.n_steps);
  n_force_ += run.n_force;
  const double p = method.order, h = window / static_cast<double>(grid.n_samples * grid.n_steps);
  if (!run.status || run.q.size() < 2) return;  // without energies, the step is not shortened
  const double change = change_of_energy(run, part) * std::pow(trial.step / h, p);
  if (change <= allowed_error()) return;
  const double shorter = std::pow(allowed_error() / change, 1 / p);
  trial.step *= shorter;
  trial.error *= std::pow(shorter, p);
  trial.n_forces_of_run = run_forces(method, trial.step);
  trial.set_by_energy = true;
}

/// Makes a pilot run and counts its force evaluations.
PilotRun StepSearch::pilot(const FixedStepMethod& method, double window, long n_samples, long n_steps) {
  PilotRun run = method.pilot(window, n_samples, n_steps);
  n_force_ += run.n_force;
  return run;
}

/// Accepts a step for `trial` and returns true if the difference d of the pilot runs with h and h/2 is sufficient.
/// Otherwise returns false. One sufficient condition is that the error estimate from d is at most the target or the
/// error by round-off. The other condition is that d is small and has decreased according to the order. `d_before` is
/// the difference of the pilot runs with 2h and h, or 0 if these runs were not made. `speed` is the largest |v|_∞ of
/// the pilot run with h/2.
bool StepSearch::settle(const FixedStepMethod& method, Trial& trial, double h, double d, double d_before,
                        double speed) const {
  const double p = method.order;
  const double richardson = std::exp2(p) / (std::exp2(p) - 1) * std::max(1.0, request_.end / window_);
  const double e = d * richardson, target = allowed_error();
  const double walk = round_off(method, speed, h);
  const double fall = d > 0 && d_before > 0 ? std::log2(d_before / d) : 0;
  const bool regular = fall >= p - 0.5 && d <= asymptotic_difference, enough = e <= target || e <= walk;

  if (!regular && !enough) return false;
  if (fall == 0 || e == 0) {
    // The grid of the pilot run has a step slightly below the limit. If the error permits, the limit itself is chosen.
    const double step = std::min(trial.limit, h * std::clamp(e > 0 ? std::pow(target / e, 1 / p) : 1.25, 1.0, 1.25));
    return accept(method, trial, step, e * std::pow(step / h, p), walk);
  }
  const double exponent = e > target ? p : std::max(p, fall);  // a faster decrease than the order may not continue
  const double h_accuracy = h * (e > target ? std::exp2(-0.25) : 1.0) * std::pow(target / e, 1 / exponent);
  const double h_round_off = h * std::pow(walk / e, 1 / (p + 0.5));  // the step h' with e (h'/h)^p = walk (h/h')^½
  const double step = std::min(std::max(h_accuracy, h_round_off), trial.limit);
  return accept(method, trial, step, e * std::pow(step / h, p), round_off(method, speed, step));
}

/// Accepts a step for `trial` and returns true if the difference d of the pilot runs with h and h/2 is within the bound
/// of an unresolved oscillation, and if the other errors meet the target. `others` is the bound of the other errors
/// with the step h in the window. The step is between h and 2h, whose pilot runs were successful.
bool StepSearch::leave_oscillation(const FixedStepMethod& method, Trial& trial, double h, double d, double others,
                                   double speed) const {
  const double e = others * std::max(1.0, request_.end / window_), target = allowed_error();
  if (d > request_.unresolved || e > target) return false;
  const double longer = std::min(2.0, std::sqrt(target / std::max(e, target / 4)));
  const double step = std::min(h * longer, trial.limit);
  return accept(method, trial, step, e * std::pow(step / h, 2), round_off(method, speed, step));
}

/// Sets `trial` to `accepted` with this step, and returns true. The estimated error is the sum of `truncation`, the
/// error of the method, and `walk`, the error by round-off.
bool StepSearch::accept(const FixedStepMethod& method, Trial& trial, double step, double truncation,
                        double walk) const {
  trial.verdict = Trial::Verdict::accepted;
  trial.step = step;
  trial.error = truncation + walk;
  trial.at_round_off = walk > allowed_error();
  trial.n_forces_of_run = run_forces(method, step);
  return true;
}

/// Returns the error e₀ that round-off causes in the configuration over the run with the step h (step_search.h).
double StepSearch::round_off(const FixedStepMethod& method, double speed, double h) const {
  // If the system has no constrained form, its largest frequency is not known and rattle_limit is infinite. hω is then
  // taken as 1.
  const double h_omega = std::isfinite(request_.rattle_limit)
                             ? Rattle::stability_limit * h / (method.n_stages * request_.rattle_limit)
                             : 1;
  return round_off_walk(compensated_, speed, request_.end, run_forces(method, h), h_omega);
}

}  // namespace pseudorigid::mechanics::detail
