#pragma once
/// Pilot runs are short runs over the beginning of the motion. The program uses them to choose the method and the step.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "mechanics/core/field_of.h"
#include "mechanics/methods/methods.h"
#include "mechanics/methods/time_loop.h"
#include "mechanics/steps/kicked_method.h"

namespace pseudorigid::mechanics {

/// The request for a method and a step. All times are in the system's unit of time.
struct StepRequest {
  double end = 0;        ///< end T of the run, which starts at 0
  double window = 0;     ///< length w of the pilot runs
  double tolerance = 0;  ///< permitted error of the configuration over [0, T]
  /// Largest permitted step of RATTLE (rattle_step_limit), to which the limits of other methods are proportional. The
  /// limit is infinite if the system has no constrained form, and 0 if it is not known.
  double rattle_limit = 0;
  double step_bound = HUGE_VAL;  ///< largest length of a step with all its substeps that the user permits
  double interval = HUGE_VAL;    ///< time between samples, which bounds the step of methods with fixed steps
  /// Bound of the difference of two pilot runs that an unresolved oscillation causes (compliance_oscillation.h). It
  /// does not grow with time, and the caller adds it to the error.
  double unresolved = 0;
  bool stiff = false;  ///< true if the damping would make the steps of all methods except RATTLE too small
  /// True if force evaluations are costly. The search then saves pilot runs. It tries shorter pilot runs first. It
  /// omits methods that cannot save more than 20 % of the force evaluations of the best method so far. It does not
  /// measure how the motion amplifies round-off.
  bool spare_pilots = false;
  /// True if the run itself checks the change of the energy, and shortens the steps. The search then does not predict
  /// this change.
  bool watches_energy = false;
  std::optional<MethodId> method{};    ///< the requested method; empty: the cheapest method
  std::function<bool()> give_up = {};  ///< called after every pilot step; the search ends if the result is true
};

namespace detail {

inline constexpr double error_safety = 0.5;  ///< fraction of the tolerance that the error estimate may use
/// Largest number of samples in a pilot run.
inline constexpr long max_pilot_samples = 32;
/// Largest difference of the configurations of two pilot runs that is assumed to decrease with the step according to
/// the order of the method. Collisions and chaos cause larger differences.
inline constexpr double asymptotic_difference = 0.1;
/// Number of force evaluations after which one pilot run is interrupted, and after which the search for the step of one
/// method with fixed steps ends. The steps of a collapsing body shrink, so a run without a bound would never end.
inline constexpr long max_pilot_forces = 4'000'000;
/// Tolerance of the constraints in pilot runs with costly force evaluations, as a fraction of the permitted difference
/// of two pilot runs. For the ball, fractions 0 … 5e-3 give the same steps to three digits. With the fraction 5e-2 one
/// step changed by 4 %.
inline constexpr double pilot_constraint = 5e-3;

/// Result of a pilot run. `q` has the configuration at each sample, or the kinetic and the potential energy if the run
/// records energies. `speed` is the largest |v|_∞ at the samples, and `n_force` the number of force evaluations. After
/// a failure, the results are those of the samples before the failure.
struct PilotRun {
  Status status;
  double t = 0;  ///< time that the pilot run reached
  std::vector<Eigen::VectorXd> q;
  double speed = 0;
  long n_force = 0;
};

/// Type of the argument `energies_of` if the caller does not give a function for kinetic and potential energy.
struct NoEnergies {};

/// A method with steps of fixed size, and functions that make pilot runs of one system with it. `n_stages` is the cost
/// of a step in force evaluations. `step_limit` is the largest permitted hω, with the step h and the largest frequency
/// ω.
struct FixedStepMethod {
  MethodId id;
  double order, n_stages, step_limit;
  /// Makes a pilot run over `window`, with n_steps steps from each sample to the next.
  std::function<PilotRun(double window, long n_samples, long n_steps)> pilot;
  /// Makes the same pilot run, but records kinetic and potential energy instead of the configuration. The function is
  /// empty if the method is symplectic or if the caller does not give the energies.
  std::function<PilotRun(double window, long n_samples, long n_steps)> energies{};
};
/// An adaptive method, and functions that make pilot runs of one system with it. The length of these runs is
/// pilot_window(request).
struct AdaptiveMethod {
  MethodId id;
  std::function<PilotRun(double local_tolerance)> pilot;
  /// Makes the same pilot run with a perturbation of `part` times round-off after every step (kicked_method.h).
  std::function<PilotRun(double local_tolerance, double part)> kicked_pilot;
};

/// Returns the length of the pilot runs: `window`, but at most the length of the run.
inline double pilot_window(const StepRequest& request) { return std::min(request.window, request.end); }

/// Functions that record a pilot run in `run`; the time loop calls them (time_loop.h). The recorded configuration is
/// Q_of(state). The run has n_steps steps from each sample to the next. The pilot run is interrupted if it needs
/// max_pilot_forces force evaluations, or if give_up returns true.
template <class State, class QOf>
class PilotHooks final : public AnyHooks<State> {
 public:
  PilotRun run{};

  PilotHooks(const QOf& Q_of, long n_steps, const Counters& counters, const std::function<bool()>& give_up)
      : Q_of_(Q_of), n_steps_(n_steps), counters_(counters), give_up_(give_up) {}

 private:
  Status take_sample(long, const State& state) override {
    auto q = Q_of_(state);
    const auto values = local_values(q);
    run.q.emplace_back(Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size())));
    run.speed = std::max(run.speed, max_norm(state.v));
    return {};
  }
  long steps_after(long, const State&) override { return n_steps_; }
  bool goes_on(Cursor, const State&) override {
    return counters_.n_force < max_pilot_forces && !(give_up_ && give_up_());
  }

  const QOf& Q_of_;
  long n_steps_;
  const Counters& counters_;
  const std::function<bool()>& give_up_;
};

/// Returns a failure with the reason why a pilot run did not reach its end.
inline Status failure_of(RunResult result) {
  return Status::failure(result.outcome == Outcome::failed ? std::move(result.reason)
                                                           : "it takes too many steps to look ahead");
}

/// Makes a pilot run from `state` over the time `window`, with n_samples samples and n_steps steps from each sample to
/// the next. An adaptive method ignores n_steps. `form` is the form of the system that the method integrates
/// (field_of.h). The function calls `prepare(workspace)` before the first step. If the run fails or is interrupted, the
/// status of the result is a failure.
template <class Method, class Form, class QOf, class Prepare>
PilotRun run_pilot(const Form& form, State<Form> state, const StepRequest& request, const QOf& Q_of, double window,
                   long n_samples, long n_steps, Prepare&& prepare) {
  typename Method::template Workspace<Form> workspace(form);
  prepare(workspace);
  PilotHooks<State<Form>, QOf> hooks(Q_of, n_steps, workspace.counters, request.give_up);
  AnyHooks<State<Form>>& any_hooks = hooks;
  Cursor cursor;
  RunResult result = run_time_loop<Method>(form, {window, n_samples}, state, cursor, workspace, any_hooks);
  hooks.run.n_force = workspace.counters.n_force;
  hooks.run.t = result.t;
  if (result.outcome != Outcome::finished) hooks.run.status = failure_of(std::move(result));
  return std::move(hooks.run);
}

/// Returns the longest permitted step of a pilot run with kicks (kicked_method.h): `rattle_limit`, but at least 1/4096
/// of the pilot run. If `rattle_limit` is 0, it is not known, and the result is infinite. The error control of an
/// adaptive method does not notice perturbations far below its tolerance. Without this bound, the steps for a body at
/// rest would exceed the stability limit, and the method itself would amplify the perturbations.
inline double longest_kicked_step(const StepRequest& request) {
  constexpr double most_steps = 4096;
  if (request.rattle_limit == 0) return HUGE_VAL;  // the limit is not known
  return std::max(request.rattle_limit, pilot_window(request) / most_steps);
}

/// Returns the cost of one step as a number of force evaluations.
template <class Method, class S>
double forces_of_step(const S& system) {
  if constexpr (requires { Method::forces_of_step(system); })
    return Method::forces_of_step(system);
  else
    return Method::n_stages;
}

/// Returns a FixedStepMethod for the system. Its functions refer to the arguments, which must exist as long as the
/// result.
template <class Method, class S, class QOf, class EnergiesOf>
FixedStepMethod fixed_step_method(MethodId id, const S& system, const State<S>& initial, const StepRequest& request,
                                  const QOf& Q_of, const EnergiesOf& energies_of) {
  const auto prepare = [&request](auto& workspace) {
    // If the method halved steps, the two pilot runs that are compared could have the same steps. Their difference
    // would then be meaningless.
    if constexpr (requires { workspace.most_halvings; }) {
      workspace.most_halvings = 0;
      workspace.iteration_tolerance = Method::iteration_tolerance(request.tolerance, request.end);
    }
    if constexpr (requires { workspace.constraint_tolerance; } && has_costly_force<S>)
      workspace.constraint_tolerance =
          std::max(workspace.constraint_tolerance,
                   pilot_constraint * (error_safety * request.tolerance) * pilot_window(request) / request.end);
  };
  FixedStepMethod method{id, Method::order, forces_of_step<Method>(system), step_limit<Method>,
                         [&, prepare](double window, long n_samples, long n_steps) {
                           return run_pilot<Method>(system, initial, request, Q_of, window, n_samples, n_steps,
                                                    prepare);
                         }};
  if constexpr (!Method::symplectic && !std::is_same_v<EnergiesOf, NoEnergies>)
    method.energies = [&, prepare](double window, long n_samples, long n_steps) {
      return run_pilot<Method>(system, initial, request, energies_of, window, n_samples, n_steps, prepare);
    };
  return method;
}
/// Returns an AdaptiveMethod for the system. Its functions refer to the arguments, which must exist as long as the
/// result.
template <class Method, class S, class QOf>
AdaptiveMethod adaptive_method(MethodId id, const S& system, const State<S>& initial, const StepRequest& request,
                               const QOf& Q_of) {
  const auto pilot = [&]<class Stepper>(Stepper, double local_tolerance, auto&& prepare) {
    const auto& field = field_of(system);
    return run_pilot<Stepper>(field, initial, request, Q_of, pilot_window(request), max_pilot_samples, 1,
                              [&](auto& workspace) {
                                workspace.tolerance = local_tolerance;
                                workspace.h_max = request.step_bound;
                                prepare(workspace);
                              });
  };
  return {id, [pilot](double local_tolerance) { return pilot(Method{}, local_tolerance, [](auto&) {}); },
          [pilot, &request](double local_tolerance, double part) {
            return pilot(Kicked<Method>{}, local_tolerance, [&](auto& workspace) {
              workspace.part = part;
              workspace.h_max = std::min(workspace.h_max, longest_kicked_step(request));
            });
          }};
}

/// Returns the largest |q_a − q_b|_∞ of the configurations q_a and q_b over the samples that both runs have.
inline double largest_difference(const PilotRun& a, const PilotRun& b) {
  double d = 0;
  for (std::size_t k = 0; k < std::min(a.q.size(), b.q.size()); ++k)
    d = std::max(d, max_norm<Eigen::VectorXd>(a.q[k] - b.q[k]));
  return d;
}

/// Returns an estimate of the error of the configuration at the time `end` that round-off causes. The rounding errors
/// of the velocity in n_substeps substeps make a random walk. `speed` is the size |v|_∞ of the velocity. If sums are
/// compensated, only the increments of the velocity have round-off. The random walk is then smaller by the factor
/// min(1, hω). `h_omega` is hω, with the size h of a substep and the largest frequency ω.
inline double round_off_walk(bool compensated, double speed, double end, double n_substeps, double h_omega) {
  const double part = compensated ? std::min(1.0, h_omega) : 1.0;
  return 0.5 * std::numeric_limits<double>::epsilon() * (1 + part * std::sqrt(n_substeps) * std::max(1.0, speed * end));
}

/// Result of the search for the step or the local tolerance of one method. The verdict `dearer` means that the method
/// would need too many force evaluations compared with another method (step_size.h). If the verdict is `failed`,
/// `reason` contains the reason in one sentence.
struct Trial {
  enum class Verdict { accepted, dearer, failed } verdict = Verdict::failed;
  MethodId method = id_of<Rattle>;
  double limit = 0, step = 0;  ///< largest permitted and chosen step; both are step_bound for an adaptive method
  double local_tolerance = 0;  ///< tolerance of one step of an adaptive method; otherwise 0
  /// Estimated error of the configuration over the run, and number of force evaluations of the run.
  double error = 0, n_forces_of_run = 0;
  bool at_round_off = false;   ///< true if round-off prevents the method from meeting the tolerance
  bool set_by_energy = false;  ///< true if the error of the energy determines the step
  /// Time after which the effect of round-off exceeds the tolerance; empty if no such time is known.
  std::optional<double> round_off_rules_from{};
  std::string reason{};
};

}  // namespace detail

}  // namespace pseudorigid::mechanics
