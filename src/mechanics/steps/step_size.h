#pragma once
/// Choice of the method and the step. If the entry Time/Method of a parameter file is auto, the program chooses the
/// method. The tolerance applies to the time error of the configuration over a run, in the maximum norm over the
/// samples.
///
/// An adaptive method (tolerance_search.h) is tried first. Its cost bounds the cost of the search among the other
/// methods. If it fails, or if its estimated error is above 0.1 units of length, other methods are not tried. The
/// motion then ends early or is too sensitive for every method. An adaptive method does not conserve the invariants of
/// the motion. If another method meets the tolerance, the adaptive method is therefore chosen only if it needs less
/// than half of the force evaluations. This occurs on short runs, because the error of an adaptive method grows like
/// T², and on motions with short violent phases.
///
/// Then methods with fixed steps are tried (step_search.h), in the order of their least cost, which is the cost at the
/// stability limit. For methods of order 2 this cost counts twice. A method is skipped if its least cost exceeds the
/// cost of the best method so far. If force evaluations are costly, the bound is 0.8 of this cost. During the search
/// for the step of a method, pilot runs predict the cost of the method. The search ends if this cost exceeds the cost
/// of the best method so far. It also ends if this cost is four times the least cost of a later method. If force
/// evaluations are cheap, only later methods of higher order count. Without an adaptive method, the first method for
/// which no step is found ends the whole search.

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
  MethodId method = id_of<Rattle>;
  double step = 0;             ///< upper bound of the step, which contains all its substeps
  double local_tolerance = 0;  ///< for adaptive methods only
  double error = 0;            ///< estimated error of the configuration over the run
  bool at_round_off = false;   ///< true if round-off prevents the method from meeting the tolerance
  /// Time after which round-off grows beyond the tolerance; empty if no such time is known.
  std::optional<double> round_off_rules_from{};
  double rattle_limit = 0;  ///< the value of StepRequest::rattle_limit
  long n_force = 0;         ///< number of force evaluations in all pilot runs
  std::string why{};        ///< the reason of the choice, one sentence for the log
};

/// Returns |Q⁻¹Q̇|₂, the rate of an affine motion with the regular matrix Q. The modes of vibration rotate and stretch
/// at about this rate.
double affine_rate(const Eigen::Matrix3d& Q, const Eigen::Matrix3d& Qdot);

/// Returns the step at which RATTLE is stable with some reserve: safety · 2/(ω + rate). The frequency ω is the largest
/// frequency of small motions about the present motion, and `rate` is the rate of the present motion.
inline double rattle_step_limit(double omega, double rate, double safety = 0.8) {
  return safety * Rattle::stability_limit / (omega + rate);
}

/// Returns the step at which RATTLE's iteration on a force that depends on the velocity converges well. With the
/// largest damping rate γ and the step h, an iteration multiplies the error by hγ/2. At this step an iteration gains
/// more than half a digit.
inline double damped_step_limit(double gamma, double safety = 0.8) { return safety * 0.5 / gamma; }

/// True if Method = auto chooses the method only for systems that evaluate stages in lanes (stage_by_stage.h).
template <class Method>
inline constexpr bool wants_stages_in_lanes = requires {
  Method::for_stages_in_lanes;
};

/// True if Method = auto considers the method for those systems of type S that the method accepts. If force evaluations
/// are cheap, a method with fixed steps must be symplectic or declare `for_stages_in_lanes`.
template <class Method, class S>
inline constexpr bool auto_considers = Method::chosen_by_auto &&
                                       (Method::adaptive || Method::symplectic || wants_stages_in_lanes<Method> ||
                                        has_costly_force<S>)&&method_fits<Method, S>();

namespace detail {

/// Returns the best of the given methods and its step. The status is a failure if there is no method, or if no step of
/// a method can be found. `compensated` is true if sums of the system's vectors are compensated.
StepChoice choose_among(const std::vector<FixedStepMethod>& fixed, const std::vector<AdaptiveMethod>& adaptive,
                        bool compensated, const StepRequest& request);

/// Returns true for the requested method. Without a request, returns true for each method that Method = auto may choose
/// and that accepts the system. If force evaluations are costly, an adaptive method is a candidate only for dissipative
/// systems. Methods with fixed steps of high order do not accept these systems. A method that is for stages in lanes is
/// a candidate only if the system evaluates its stages in lanes. If the system is stiff, RATTLE is the only candidate,
/// because RATTLE solves a linear system for the velocity. Damping then does not limit its step.
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
/// configuration Q_of(state), a matrix or vector of Eigen. `initial` is at t = 0. If a pilot run with fixed steps
/// fails, it is repeated with half the step, unless the motion itself ends. The function energies_of(state), if given,
/// returns the kinetic and the potential energy. A multistep method may then change their sum by at most half the
/// tolerance, relative to the energy of the motion. The status of the result is a failure if no method fits or no step
/// is found.
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
