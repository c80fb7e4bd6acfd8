#pragma once
/// The search for the step of one method with steps of fixed size. The tolerance applies to the time error of the
/// configuration over a run of length T, in the maximum norm over the samples.
///
/// Q_h(t_k) is the configuration at the sample t_k, computed with the step h. Pilot runs over a window w ≤ T with steps
/// h and h/2 give, for a method of order p, Richardson's estimate
///
///   e(h) = max_k |Q_h(t_k) − Q_{h/2}(t_k)| · 2^p/(2^p − 1) · T/w.
///
/// The target of e is half of the tolerance. The factor T/w assumes that the error grows linearly after the window. The
/// assumption holds for symmetric methods on regular motions (Hairer, Lubich, Wanner, Geometric Numerical Integration,
/// X.3). The window should contain several periods of the slowest important motion. On a chaotic motion only w = T is
/// safe. In a test with 1500 short scenes, all runs met their tolerances. In another run, a release from the stretches
/// 1.29, 1.29, 0.60, the error was 1.12 times the tolerance. This motion magnifies a change of the initial state by a
/// factor of 2000 in the time 6.4 r/c. Here r is the radius of the ball, and c the speed of shear waves.
///
/// The search starts at the largest permitted step and halves the step. The largest permitted step is the least of the
/// limit of the method by stability and resonance, the bound of the user and the time between samples. The search ends
/// if e is at most the target, or at most the error e₀ by round-off (last formula of this text). It also ends if a
/// halving reduces a difference of at most 0.1 by a factor of at least 2^p/√2. When the search has ended, the relation
/// e ~ hᵖ gives the step. If this step is smaller than h, no pilot run has tested it, and the step is divided by
/// 2^(1/4) as a reserve. The search fails if 12 halvings or 4·10⁶ force evaluations are not enough. It also fails if
/// the motion ends within the window, if the caller ends the search, or if the run would need more than 10¹¹ force
/// evaluations.
///
/// An oscillation that the steps do not resolve may leave a difference that does not decrease with the step. The caller
/// gives a bound of this difference, and adds it to the estimate. The caller also begins the pilot runs without the
/// oscillation (slow_motion.h), but a part of it may remain. All other errors are of order 2 or more. If d_j is the
/// difference of the runs with the steps h_j = h_0/2^j and h_j/2, the other errors with h_j are therefore at most
///
///   min_i (4/3) d_i 4^(i−j),   i ≤ j.
///
/// The search ends if d_j is within the bound, and this minimum times T/w is at most the target.
///
/// A multistep method of order p begins with p − 1 steps of another method. These steps do not show the error of the
/// multistep method. Therefore the window contains at least 4p steps, or the whole run.
///
/// If force evaluations are costly, the search first estimates the error of the largest permitted step over a part w'
/// of the window. Methods of order 2 omit this estimate. The errors have hardly begun to grow in w', so the estimate is
/// multiplied by (w/w')^(3/2). The first part is w/8 with the factor 23. If this product is too large, but 2.8 times
/// the estimate is not, the search also tries w/2 with the factor 2.8. For a multistep method of order p, a part
/// contains at least 2p steps. These factors were tested in releases, spins, tides and figures of equilibrium of the
/// ball. The error was 0.07 to 9 times the estimate without a factor at w/8, and 0.4 to 2.1 times this estimate at w/2.
/// A method of high order often meets the target at its stability limit. Its pilot runs then cost only a fifth or a
/// half as much.
///
/// A symmetric multistep method conserves a modified energy. For a mode of frequency ω and energy E_ω, the modified
/// energy is
///
///   E_ω (1 + C (hω)^p + …),   C = 0.094 for order 4 (5/2 of the coefficient of its modified differential equation).
///
/// The true energy therefore changes if the motion transfers energy from slow modes to fast modes. In a body with many
/// modes this transfer continues for a long time, with and without constraints. It does not occur in small motions.
/// RATTLE-4 has C = −0.0009. The change of its energy has the opposite sign and a hundredth of the size.
///
/// Therefore the search makes one more pilot run of a multistep method, with the step that it has found. This run
/// covers the first eighth of the whole run, and is made only if this eighth has the length of at least five windows.
/// It is not made if the whole run watches its energy. D is the largest change of the energy in this pilot run. δ is
/// the difference of the mean energies in its first and second half. D and δ are divided by the energy of the motion
/// above the least potential energy. The step is shortened to h' such that
///
///   (D + 44 δ) (h'/h)^p ≤ target,
///
/// because a change that grows like t^(3/2) is 44 δ at the end of the run. In small motions the energy oscillates, and
/// δ is small. In 123 runs of releases and spins of the ball, the change at the end was 0.09 to 42 times D + 44 δ. The
/// median was 0.9. The runs had stretches of 1.001 to 1.3 and lengths of 20 to 1000 r/c, with and without the
/// constraint. The finite elements had degrees 2 to 4, and the polynomials had degrees 3 to 9. In 12 runs the change
/// was more than 5 times D + 44 δ, because violent motions become more violent with time. In the worst case a
/// compressible ball is compressed to a fifth. The power 3/2 was chosen after these measurements. The target and the
/// reserve of the models (app/run/field_model.h) together permit an underestimate by a factor of 5. Larger factors are
/// caused by the parasitic roots of the method, ±i for order 4, which resonate with sums of frequencies. Sums of two
/// frequencies resonate from hω = 0.79 on, and sums of three from 0.52 on. The error of these resonances falls faster
/// than h^p.
///
/// The random walk of round-off in the velocity causes an error of the configuration of about
///
///   e₀ = ½ ε √N max(1, |v|_∞ T),   with N substeps, the velocity v and the round-off ε.
///
/// If sums are compensated, √N has the additional factor min(1, hω). The chosen step is not smaller than the step at
/// which e = e₀, unless the largest permitted step is smaller.

#include <algorithm>
#include <cmath>

#include "mechanics/steps/pilot_run.h"

namespace pseudorigid::mechanics::detail {

/// Searches for the steps of the methods, one after the other. `compensated` is true if sums of the system's vectors
/// are compensated (vector_space.h). The request must exist as long as the object.
class StepSearch {
 public:
  StepSearch(const StepRequest& request, bool compensated)
      : request_(request), compensated_(compensated), window_(pilot_window(request)) {}

  /// Searches for the step of one method. If the error of the energy is too large at this step, the step is shortened.
  /// The search ends early with the verdict `dearer` if the run would need `n_forces_to_beat` force evaluations or
  /// more.
  Trial try_method(const FixedStepMethod& method, double n_forces_to_beat) {
    Trial trial = meet_tolerance(method, n_forces_to_beat);
    if (trial.verdict == Trial::Verdict::accepted && trial.n_forces_of_run < n_forces_to_beat)
      keep_energy(method, trial);
    return trial;
  }

  /// Returns the number of force evaluations of the whole run with the largest permitted step. This is the least number
  /// for the method.
  double least_forces(const FixedStepMethod& method) const { return run_forces(method, limit(method)); }
  long n_force() const { return n_force_; }

 private:
  bool given_up() const { return request_.give_up && request_.give_up(); }
  /// Returns the target of the estimate e, which is error_safety times the tolerance.
  double allowed_error() const { return error_safety * request_.tolerance; }
  /// Returns the largest permitted step: the limit of the method by stability and resonance, but at most the bound of
  /// the user and the time between samples.
  double limit(const FixedStepMethod& method) const {
    return std::min(request_.rattle_limit * (method.step_limit / Rattle::stability_limit),
                    std::min(request_.step_bound, request_.interval));
  }
  /// Returns the number of force evaluations of the whole run with the step h.
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
  bool leave_oscillation(const FixedStepMethod& method, Trial& trial, double h, double d, double others,
                         double speed) const;
  bool accept(const FixedStepMethod& method, Trial& trial, double step, double truncation, double walk) const;
  double round_off(const FixedStepMethod& method, double speed, double h) const;

  const StepRequest& request_;
  bool compensated_;
  double window_;  ///< length of the pilot runs of the method that is tried
  long n_force_ = 0;
};

}  // namespace pseudorigid::mechanics::detail
