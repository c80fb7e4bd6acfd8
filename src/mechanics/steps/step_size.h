#pragma once
/// Method and step from a tolerance of the time error of the configuration over a run (maximum norm over samples).
///
/// An adaptive method (tolerance_search.h) is tried first: it can follow motions of every kind, and its cost bounds
/// that of the search among the others. It is taken if it needs less than half of their forces, for it does not keep
/// the invariants of the motion; that is on short runs, since its error grows like T², and on motions with short
/// violent phases. Methods of fixed step are tried by rising order (step_search.h), as long as the next one at its
/// stability limit would be cheaper than the best so far at the step that accuracy asks of it, and dropped as soon as a
/// pilot shows that a higher order must be cheaper.

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "mechanics/core/field_of.h"
#include "mechanics/steps/pilot_run.h"

namespace pseudorigid::mechanics {

/// The chosen method and step, or the reason why no method can run. Times are in internal units.
struct [[nodiscard]] StepChoice {
  Status status{};
  MethodId method = id_of<Rattle>;
  double step = 0;             ///< outer (composed) step, an upper bound
  double local_tolerance = 0;  ///< of an adaptive method
  double error = 0;            ///< estimated error of the configuration over the run
  bool at_round_off = false;   ///< the tolerance is below the limit of double precision
  /// Time from which on round-off, which grows with the motion, exceeds the tolerance.
  std::optional<double> round_off_rules_from{};
  double rattle_limit = 0;  ///< as requested
  long n_force = 0;         ///< forces spent on pilot runs
  std::string why{};        ///< one sentence for the log
};

/// |Q⁻¹Q̇|₂: the rate of an affine motion, which stands for the turning and stretching of the modes themselves.
double affine_rate(const Eigen::Matrix3d& Q, const Eigen::Matrix3d& Qdot);

/// Step at which RATTLE is stable with some reserve: safety · 2/(ω + rate), ω the largest frequency of small motions
/// and the rate that of the motion about which they are small.
inline double rattle_step_limit(double omega, double rate, double safety = 0.8) {
  return safety * Rattle::stability_limit / (omega + rate);
}

/// Step at which RATTLE's iteration on a force that depends on the velocity, which contracts by hγ/2, gains more than
/// half a digit each time, γ the largest rate of damping.
inline double damped_step_limit(double gamma, double safety = 0.8) { return safety * 0.5 / gamma; }

/// Whether auto takes a method only for systems whose stages are evaluated in lanes.
template <class Method>
inline constexpr bool wants_stages_in_lanes = requires {
  Method::for_stages_in_lanes;
};

/// Whether Method = auto considers a method for systems of type S, if `accepts` agrees. If forces are cheap, methods of
/// fixed step that are not symplectic are left to explicit requests, unless stages in lanes make their steps as cheap.
template <class Method, class S>
inline constexpr bool auto_considers = Method::chosen_by_auto &&
                                       (Method::adaptive || Method::symplectic || wants_stages_in_lanes<Method> ||
                                        has_costly_force<S>)&&method_fits<Method, S>();

namespace detail {

/// Among these methods, in the order of the table; `compensated`: whether the vectors of the system are summed so.
StepChoice choose_among(const std::vector<FixedStepMethod>& fixed, const std::vector<AdaptiveMethod>& adaptive,
                        bool compensated, const StepRequest& request);

/// The one that is asked for, or any that auto may take and whose promises hold. If a force costs much, an adaptive
/// method is for dissipative systems, to which no method of fixed step and high order is open. If they are stiff,
/// RATTLE alone is left, whose kicks solve for the velocity.
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

/// The cheapest method, or the step of the one that is asked for. Q_of(state) is the configuration to which the
/// tolerance applies: a matrix or vector of Eigen. `initial` is at t = 0. A pilot run that fails is repeated with half
/// the step. energies_of(state), if given, are the kinetic and the potential energy, of which methods that are not
/// symplectic may change the sum by the tolerance.
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
