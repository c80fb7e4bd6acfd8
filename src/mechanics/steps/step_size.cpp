#include "mechanics/steps/step_size.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "mechanics/steps/step_search.h"
#include "mechanics/steps/tolerance_search.h"

namespace pseudorigid::mechanics {

double affine_rate(const Eigen::Matrix3d& Q, const Eigen::Matrix3d& Qdot) {
  const Eigen::Matrix3d L = Q.inverse() * Qdot;
  return std::sqrt(std::max(0.0, (L.transpose() * L).eval().selfadjointView<Eigen::Lower>().eigenvalues()(2)));
}

namespace detail {
namespace {

/// The search for the step of a method stops if the method needs this multiple of the least cost of a later method. If
/// force evaluations are cheap, only later methods of higher order count.
constexpr double clearly_dearer = 4;
/// If force evaluations are costly, a method is tried only if its least cost is below this fraction of the cost of the
/// best method so far. Otherwise its pilot runs would cost more than the method can save.
constexpr double worth_dear_pilots = 0.8;
/// A method that conserves the invariants of the motion may need up to this number of force evaluations for each force
/// evaluation of an adaptive method.
constexpr double price_of_invariants = 2;

/// Returns the sentence for the log. The sentence contains the chosen method, its step with the reason, its error and
/// cost, and the costs of the other methods.
std::string describe(const Trial& chosen, const StepRequest& request, const std::vector<Trial>& others) {
  std::ostringstream s;
  s.precision(3);
  s << method_name(chosen.method) << " with ";
  if (chosen.local_tolerance > 0)
    s << "steps of its own choice, local tolerance " << chosen.local_tolerance;
  else
    s << "steps of at most " << chosen.step << " internal time units ("
      << (chosen.set_by_energy                                                    ? "set by the drift of the energy"
          : chosen.step < 0.99 * chosen.limit                                     ? "set by accuracy"
          : std::min(request.step_bound, request.interval) <= chosen.limit * 1.01 ? "the bound given"
                                                                                  : "set by stability")
      << ")";
  s << ": estimated time error " << chosen.error << ", tolerance " << request.tolerance;
  if (chosen.at_round_off) s << ", which is below the accuracy of double precision over this run";
  s << "; " << chosen.n_forces_of_run << " forces";
  for (const Trial& other : others)
    if (other.method != chosen.method && other.verdict == Trial::Verdict::accepted)
      s << ", " << method_name(other.method) << " would need " << other.n_forces_of_run
        << (other.n_forces_of_run < chosen.n_forces_of_run ? ", but keeps no invariants" : "");
  return s.str();
}

/// Tries methods and chooses the best of them.
class MethodChoice {
 public:
  MethodChoice(bool compensated, const StepRequest& request) : compensated_(compensated), request_(request) {}

  /// Searches for the local tolerance of each adaptive method, and sets `adaptive_` if the method is accepted. The
  /// table of methods has one adaptive method. Sets `hopeless_` to true if the method fails or its error is above
  /// asymptotic_difference.
  void try_adaptive(const std::vector<AdaptiveMethod>& methods) {
    for (const AdaptiveMethod& method : methods) {
      trials_.push_back(search_tolerance(request_, compensated_, method, n_force_));
      const Trial& trial = trials_.back();
      if (trial.verdict == Trial::Verdict::accepted) adaptive_ = trial;
      hopeless_ = !adaptive_ || trial.error > asymptotic_difference;
    }
  }

  /// Searches for the step of each method with fixed steps, in the order of likely_forces. Skips methods whose least
  /// cost is too large. Sets `best_` to the cheapest accepted method if its cost is below adaptive_cost. Ends early if
  /// `hopeless_` is true.
  void try_fixed_steps(std::vector<FixedStepMethod> methods) {
    StepSearch search(request_, compensated_);
    std::stable_sort(methods.begin(), methods.end(), [&](const FixedStepMethod& a, const FixedStepMethod& b) {
      return likely_forces(search, a) < likely_forces(search, b);
    });
    for (auto method = methods.begin(); method != methods.end() && !hopeless_; ++method) {
      const double cheapest = least_cost();
      if (search.least_forces(*method) >= (request_.spare_pilots ? worth_dear_pilots : 1) * cheapest) continue;
      double least_later = HUGE_VAL;
      for (auto later = method + 1; later != methods.end(); ++later)
        if (request_.spare_pilots || later->order > method->order)
          least_later = std::min(least_later, likely_forces(search, *later));
      trials_.push_back(search.try_method(*method, std::min(cheapest, clearly_dearer * least_later)));
      const Trial& trial = trials_.back();
      hopeless_ = trial.verdict == Trial::Verdict::failed && !adaptive_;
      if (trial.verdict == Trial::Verdict::accepted && trial.n_forces_of_run < cheapest) best_ = trial;
    }
    n_force_ += search.n_force();
  }

  /// Returns the accepted adaptive method if its cost by adaptive_cost is least, or if no method with fixed steps is
  /// accepted. Otherwise returns the best method with fixed steps. If no method is accepted, the status is a failure.
  StepChoice result() {
    if (adaptive_ && (!best_ || adaptive_cost() < best_->n_forces_of_run)) best_ = adaptive_;
    StepChoice choice{.rattle_limit = request_.rattle_limit, .n_force = n_force_};
    if (!best_) {
      if (!trials_.empty()) choice.method = trials_.back().method;
      choice.status =
          Status::failure(trials_.empty() ? "no method fits"
                                          : "no step of " + std::string(method_name(trials_.back().method)) +
                                                " can be found: " + trials_.back().reason);
      return choice;
    }
    choice.method = best_->method;
    choice.step = best_->step;
    choice.local_tolerance = best_->local_tolerance;
    choice.error = best_->error;
    choice.at_round_off = best_->at_round_off;
    choice.round_off_rules_from = best_->round_off_rules_from;
    choice.why = describe(*best_, request_, trials_);
    return choice;
  }

 private:
  /// Returns the cost by which the methods are ordered: the least number of force evaluations. For a method of order 2
  /// this number is doubled, because accuracy seldom permits a step near its limit.
  static double likely_forces(const StepSearch& search, const FixedStepMethod& method) {
    return search.least_forces(method) * (method.order == 2 ? 2 : 1);
  }
  /// Returns the cost of the adaptive method that is compared with other methods: price_of_invariants times its number
  /// of force evaluations. The cost is infinite if no adaptive method is accepted, or if round-off prevents it from
  /// meeting the tolerance.
  double adaptive_cost() const {
    return adaptive_ && !adaptive_->at_round_off ? price_of_invariants * adaptive_->n_forces_of_run : HUGE_VAL;
  }
  double least_cost() const { return std::min(best_ ? best_->n_forces_of_run : HUGE_VAL, adaptive_cost()); }

  bool compensated_;
  const StepRequest& request_;
  std::vector<Trial> trials_;
  std::optional<Trial> best_, adaptive_;
  bool hopeless_ = false;  // true if no more methods are tried, because the motion ends early or is too sensitive
  long n_force_ = 0;
};

}  // namespace

StepChoice choose_among(const std::vector<FixedStepMethod>& fixed, const std::vector<AdaptiveMethod>& adaptive,
                        bool compensated, const StepRequest& request) {
  MethodChoice choice(compensated, request);
  choice.try_adaptive(adaptive);
  choice.try_fixed_steps(fixed);
  return choice.result();
}

}  // namespace detail

}  // namespace pseudorigid::mechanics
