#pragma once
/// Choice of the method and the step. If the entry Time/Method of a parameter file is auto, the program chooses the
/// method. The tolerance applies to the time error of the configuration over a run, in the maximum norm over the
/// samples.
///
/// An adaptive method (tolerance_search.h) is tried first. Searches for other methods end as soon as these methods are
/// too costly compared with the adaptive method. If the adaptive method fails, or if its estimated error is above 0.1
/// units of length, other methods are not tried. The motion then ends early or is too sensitive for every method. An
/// adaptive method does not conserve the invariants of the motion. If another method meets the tolerance, the adaptive
/// method is therefore chosen only if it needs less than half of the force evaluations. This occurs on short runs,
/// because the error of an adaptive method grows like T², and on motions with short violent phases.
///
/// Then methods with fixed steps are tried (step_search.h), in the order of their least cost. The least cost is the
/// number of force evaluations of the run with the largest permitted step. For methods of order 2, twice this number
/// determines the order. A method is skipped if its least cost exceeds the cost of the best method so far. If force
/// evaluations are costly, the bound is 0.8 of this cost. During the search for the step of a method, pilot runs
/// predict the cost of the method. The search for this method ends if the predicted cost exceeds the cost of the best
/// method so far. It also ends if the predicted cost is four times the least cost of a later method, which
/// counts twice for a method of order 2. If force evaluations are cheap, only later methods of higher order count.
/// Without an adaptive method, the first method for which no step is found ends the whole search.

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "mechanics/core/field_of.h"
#include "mechanics/steps/pilot_run.h"

namespace pseudorigid::mechanics {

/// The chosen method and step, or the reason why no step can be found. Times are in internal units.
struct [[nodiscard]] StepChoice {
  Status status{};
  MethodId method = id_of<Rattle>;  ///< after a failure the last method that was tried, if any
  double step = 0;                  ///< upper bound of the size of a step, which includes all its substeps
  double local_tolerance = 0;       ///< tolerance of one step of an adaptive method; otherwise 0
  double error = 0;                 ///< estimated error of the configuration over the run
  bool at_round_off = false;        ///< true if round-off prevents the method from meeting the tolerance
  /// Time after which the effect of round-off exceeds the tolerance; empty if no such time is known.
  std::optional<double> round_off_rules_from{};
  double rattle_limit = 0;  ///< the value of StepRequest::rattle_limit
  long n_force = 0;         ///< number of force evaluations in all pilot runs
  std::string why{};        ///< the reason of the choice, one sentence for the log
};

/// Returns the rate |Q⁻¹Q̇|₂ (spectral norm) of an affine motion with the regular matrix Q. The modes of vibration
/// rotate and stretch with the body at about this rate.
double affine_rate(const Eigen::Matrix3d& Q, const Eigen::Matrix3d& Qdot);

/// Returns a step at which RATTLE is stable with some reserve: safety · 2/(ω + rate). ω is the largest frequency of
/// small motions about the present state. `rate` is the rate of the present motion, for example affine_rate.
inline double rattle_step_limit(double omega, double rate, double safety = 0.8) {
  return safety * Rattle::stability_limit / (omega + rate);
}

/// Returns the step at which RATTLE's iteration on a force that depends on the velocity converges well. With the
/// largest damping rate γ and the step h, an iteration multiplies the error by hγ/2. At the returned step this factor
/// is 0.2 for the default `safety`.
inline double damped_step_limit(double gamma, double safety = 0.8) { return safety * 0.5 / gamma; }

/// True if the entry Method = auto chooses the method only for systems that evaluate stages in lanes
/// (stage_by_stage.h).
template <class Method>
inline constexpr bool wants_stages_in_lanes = requires {
  Method::for_stages_in_lanes;
};

/// True if the entry Method = auto considers the method for systems of type S. The method must also accept the system.
/// If force evaluations are cheap, a method with fixed steps must be symplectic or declare `for_stages_in_lanes`.
template <class Method, class S>
inline constexpr bool auto_considers = Method::chosen_by_auto &&
                                       (Method::adaptive || Method::symplectic || wants_stages_in_lanes<Method> ||
                                        has_costly_force<S>)&&method_fits<Method, S>();

namespace detail {

/// Returns the best of the given methods and its step. The status is a failure if the lists are empty, or if no method
/// is accepted. `compensated` is true if sums of the system's vectors are compensated (vector_space.h).
StepChoice choose_among(const std::vector<FixedStepMethod>& fixed, const std::vector<AdaptiveMethod>& adaptive,
                        bool compensated, const StepRequest& request);

/// Returns true if the search must try the method. If the request names a method, this is the only candidate. Otherwise
/// the candidates are the methods that the entry Method = auto may choose and that accept the system. If force
/// evaluations are costly, an adaptive method is a candidate only for dissipative systems. Methods of high order with
/// fixed steps do not accept these systems. A method that declares `for_stages_in_lanes` is a candidate only if the
/// system evaluates its stages in lanes. If the system is stiff, RATTLE is the only candidate, because damping does not
/// limit its step.
template <class Method, class S>
bool is_candidate(const S& system, const StepRequest& request) {
  if (request.method) return *request.method == id_of<Method>;
  if (request.stiff && id_of<Method> != id_of<Rattle>) return false;
  if (Method::adaptive && has_costly_force<S> && !dissipative(system)) return false;
  if constexpr (wants_stages_in_lanes<Method> && method_fits<Method, S>())
    if (!has_stages_in_lanes(field_of(system))) return false;
  if constexpr (auto_considers<Method, S>) return Method::accepts(form_for<Method>(system)).ok();
  return false;
}

}  // namespace detail

/// Chooses the cheapest method and its step, or the step of the requested method. The tolerance applies to the
/// configuration Q_of(state), a matrix or vector of Eigen. `initial` is the state at the start of the run. If a pilot
/// run with fixed steps fails, it is repeated with half the step, unless the motion itself ends. `energies_of(state)`,
/// if given, returns a vector of the kinetic and the potential energy. A multistep method may then change their sum by
/// at most half the tolerance, relative to the energy of the motion. The status of the result is a failure if no method
/// fits or no step is found.
template <class S, class QOf, class EnergiesOf = detail::NoEnergies>
StepChoice choose_step(const S& system, const State<S>& initial, const StepRequest& request, const QOf& Q_of,
                       const EnergiesOf& energies_of = {}) {
  std::vector<detail::FixedStepMethod> fixed;
  std::vector<detail::AdaptiveMethod> adaptive;
  for_each_method([&]<class Method>(Method) {
    if constexpr (method_fits<Method, S>()) {
      if (!fits<Method>(system) || !detail::is_candidate<Method>(system, request)) return;
      if constexpr (Method::adaptive)
        adaptive.push_back(detail::adaptive_method<Method>(id_of<Method>, system, initial, request, Q_of));
      else
        fixed.push_back(detail::fixed_step_method<Method>(id_of<Method>, system, initial, request, Q_of, energies_of));
    }
  });
  return detail::choose_among(fixed, adaptive, VectorSpace<typename S::Vector>::compensated, request);
}

}  // namespace pseudorigid::mechanics
