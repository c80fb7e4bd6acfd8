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
/// slowest motion that matters, and on a chaotic motion nothing but w = T is safe. In a test with 1500 short scenes,
/// all met their tolerances. Another release, from the stretches 1.29, 1.29, 0.60, had 1.12 times its tolerance: its
/// motion magnifies a change of its start 2000 times in 6.4 r/c.
///
/// From the stability limit the step is halved until e ≤ target or until e, small by then, falls by 2^p (to within
/// √2); then e ~ hᵖ gives the step, without runs as fine as it, and with a reserve of 2^(p/4) for what such runs would
/// have shown.
///
/// A multistep method of order p begins with p − 1 steps of another method, which do not show its own error: its window
/// holds 4p of its steps, or the whole run.
///
/// If it is asked for, a glance comes first, the same with a part w' of the window: w/8, and if that leaves it a
/// chance w/2. Errors have hardly begun to grow in it, so its estimate is multiplied by (w/w')^(3/2): 23 and 2.8. In
/// releases, spins, tides and figures of equilibrium of the ball it was 0.07 to 9 times too small at w/8, and 0.4 to
/// 2.1 times at w/2. A method of high order at its stability limit often has room for that, and the pilots cost a fifth
/// or a half.
///
/// A symmetric multistep method keeps a modified energy, of a mode of frequency ω and energy E_ω
///
///   E_ω (1 + C (hω)^p + …),   C = 0.094 for order 4 (5/2 of that of its differential equation),
///
/// so that the energy itself changes with what the motion hands on from slow modes to fast ones. On a body of many
/// modes that goes on for long, with constraints and without, and not in small motions. (RATTLE-4 has C = −0.0009, and
/// its energy changes the other way by a hundredth of that.) So a run of five windows of the pilots in its first eighth
/// is given a look at that eighth with the step found. D is the largest change of the energy there and δ the difference
/// of its means over the halves of that window, both over the energy of the motion. The step is shortened until
///
///   (D + 44 δ) (h'/h)^p ≤ target,
///
/// for a change like t^(3/2) is 44 δ at the end; in small motions it comes and goes, and δ is small. In 123 runs of
/// releases and spins of the ball (stretches of 1.001 to 1.3, degrees 2 to 4, 3 to 9 of polynomials, with the
/// constraint and without, t = 20 to 1000) the change at the end was 0.09 to 42 times D + 44 δ, 0.9 in the median. It
/// was more than 5 times in 12 runs: violent motions get more violent with time, and at the worst a compressible ball
/// is squeezed to a fifth. The power 3/2 was chosen after that. A factor of 5 is in the target and in the reserve of
/// the models. What goes beyond are parasitic roots, ±i for order 4, which sums of frequencies of the motion meet, of
/// two from hω = 0.79 on, of three from 0.52 on. It falls faster than h^p.
///
/// Round-off walks at random through the velocity and so costs about
///
///   e₀ = ½ ε √N max(1, |v|_∞ T),   N substeps,
///
/// of accuracy, times hω if sums are compensated: no step smaller than where e = e₀ is taken.

#include <algorithm>
#include <cmath>

#include "mechanics/steps/pilot_run.h"

namespace pseudorigid::mechanics::detail {

/// `compensated`: whether the vectors of the system are summed so.
class StepSearch {
 public:
  StepSearch(const StepRequest& request, bool compensated)
      : request_(request), compensated_(compensated), window_(pilot_window(request)) {}

  /// The step of one method; given up as soon as it needs more than `n_forces_to_beat` forces for the run.
  Trial try_method(const FixedStepMethod& method, double n_forces_to_beat) {
    Trial trial = meet_tolerance(method, n_forces_to_beat);
    if (trial.verdict == Trial::Verdict::accepted && trial.n_forces_of_run < n_forces_to_beat)
      keep_energy(method, trial);
    return trial;
  }

  /// Forces of the whole run at the stability limit: the least that a method can cost.
  double least_forces(const FixedStepMethod& method) const { return run_forces(method, limit(method)); }
  long n_force() const { return n_force_; }

 private:
  bool given_up() const { return request_.give_up && request_.give_up(); }
  /// The target of the estimate e.
  double allowed_error() const { return error_safety * request_.tolerance; }
  double limit(const FixedStepMethod& method) const {
    return std::min(request_.rattle_limit * (method.step_limit / Rattle::stability_limit),
                    std::min(request_.step_bound, request_.interval));
  }
  double run_forces(const FixedStepMethod& method, double h) const {
    return std::ceil(request_.end / h) * method.n_stages;
  }
  double window_of(const FixedStepMethod& method) const;
  Trial meet_tolerance(const FixedStepMethod& method, double n_forces_to_beat);
  void keep_energy(const FixedStepMethod& method, Trial& trial);
  double predicted_forces(const FixedStepMethod& method, double h, double d) const;
  bool glance(const FixedStepMethod& method, Trial& trial);
  PilotRun pilot(const FixedStepMethod& method, double window, long n_samples, long n_steps);
  bool settle(const FixedStepMethod& method, Trial& trial, double h, double d, double d_before, double speed) const;
  bool accept(const FixedStepMethod& method, Trial& trial, double step, double truncation, double walk) const;
  double round_off(const FixedStepMethod& method, double speed, double h) const;

  const StepRequest& request_;
  bool compensated_;
  double window_;  ///< length of the pilot runs of the method that is tried
  long n_force_ = 0;
};

}  // namespace pseudorigid::mechanics::detail
