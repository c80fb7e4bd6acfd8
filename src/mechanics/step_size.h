#pragma once
/// Method and step from a tolerance of the time error of the configuration over a run (maximum norm over samples).
///
/// An adaptive method (tolerance_search.h) is tried first: it finds its way through motions of every kind, and bounds
/// what the search among the others may cost. It is taken where it needs less than half of their forces, for it does
/// not keep the invariants of the motion; that is on short runs, since its error grows like T², and on motions with
/// short violent phases. Methods of fixed step are tried by rising order (step_search.h), as long as the next one at
/// its stability limit would be cheaper than the best so far at the step that accuracy asks of it, and dropped as soon
/// as a pilot shows that a higher order must be cheaper.

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "mechanics/field_of.h"
#include "mechanics/step_search.h"
#include "mechanics/tolerance_search.h"

namespace pseudorigid::mechanics {

/// What to run with, or why nothing can be run. Times are those of the system, that is internal units.
struct [[nodiscard]] StepChoice {
  Status status{};
  MethodId method = id_of<Rattle>;
  double step = 0;             ///< outer (composed) step, an upper bound
  double local_tolerance = 0;  ///< of an adaptive method
  double error = 0;            ///< estimated error of the configuration over the run
  bool at_round_off = false;   ///< the tolerance is below what double precision gives
  double rattle_limit = 0;     ///< as requested
  long n_force = 0;            ///< forces spent on pilot runs
  std::string why{};           ///< one sentence for the log
};

/// |Q⁻¹Q̇|₂: the rate of an affine motion, which stands for the turning and stretching of the modes themselves.
inline double affine_rate(const Eigen::Matrix3d& Q, const Eigen::Matrix3d& Qdot) {
  const Eigen::Matrix3d L = Q.inverse() * Qdot;
  return std::sqrt(std::max(0.0, (L.transpose() * L).eval().selfadjointView<Eigen::Lower>().eigenvalues()(2)));
}

/// Step at which RATTLE is stable with some reserve: safety · 2/(ω + rate), ω the largest frequency of small motions
/// and the rate that of the motion about which they are small.
inline double rattle_step_limit(double omega, double rate, double safety = 0.8) {
  return safety * Rattle::stability_limit / (omega + rate);
}

/// Step at which RATTLE's iteration on a force that depends on the velocity, which contracts by hγ/2, gains more than
/// half a digit each time, γ the largest rate of damping.
inline double damped_step_limit(double gamma, double safety = 0.8) { return safety * 0.5 / gamma; }

namespace detail {

/// A method that needs this many times the least cost of a method of higher order is not pursued.
inline constexpr double clearly_dearer = 4;
/// What the invariants of the motion are worth: forces that a geometric method may need for each of an adaptive one.
inline constexpr double price_of_invariants = 2;

inline std::string describe(const Trial& chosen, const StepRequest& request, const std::vector<Trial>& others) {
  std::ostringstream s;
  s.precision(3);
  s << method_name(chosen.method) << " with ";
  if (chosen.local_tolerance > 0)
    s << "steps of its own choice, local tolerance " << chosen.local_tolerance;
  else
    s << "steps of at most " << chosen.step << " internal time units ("
      << (chosen.step < 0.99 * chosen.limit                                       ? "set by accuracy"
          : std::min(request.step_bound, request.interval) <= chosen.limit * 1.01 ? "the bound given"
                                                                                  : "set by stability")
      << ")";
  s << ": estimated time error " << chosen.error << ", tolerance " << request.tolerance;
  if (chosen.at_round_off) s << ", which is below what double precision gives over this run";
  s << "; " << chosen.n_forces_of_run << " forces";
  for (const Trial& other : others)
    if (other.method != chosen.method && other.verdict == Trial::Verdict::accepted)
      s << ", " << method_name(other.method) << " would need " << other.n_forces_of_run
        << (other.n_forces_of_run < chosen.n_forces_of_run ? ", but keeps no invariants" : "");
  return s.str();
}

template <class S, class QOf>
class MethodChoice {
 public:
  MethodChoice(const S& system, const State<S>& initial, const StepRequest& request, const QOf& Q_of)
      : system_(system), initial_(initial), request_(request), Q_of_(Q_of) {}

  StepChoice choose() {
    try_adaptive();
    if (!hopeless_) try_fixed_steps();
    if (adaptive_ && (!best_ || adaptive_cost() < best_->n_forces_of_run)) best_ = adaptive_;
    StepChoice choice{.rattle_limit = request_.rattle_limit, .n_force = n_force_};
    if (!best_) {
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
    choice.why = describe(*best_, request_, trials_);
    return choice;
  }

 private:
  template <class Method>
  bool is_candidate() const {
    if (request_.method) return *request_.method == id_of<Method>;
    if constexpr (Method::chosen_by_auto)
      return fits<Method>(system_) && Method::accepts(form_for<Method>(system_)).ok();
    return false;
  }

  void try_fixed_steps() {
    if constexpr (ConstrainedSystem<S>) {
      StepSearch<S, QOf> search(system_, initial_, request_, Q_of_);
      for_each_method([&]<class Method>(Method) {
        if constexpr (!Method::adaptive && method_fits<Method, S>()) {
          if (hopeless_ || !is_candidate<Method>()) return;
          const double cheapest = least_cost();
          if (search.template least_forces<Method>() >= cheapest) return;
          const double to_beat = std::min(cheapest, clearly_dearer * least_forces_above<Method>(search));
          trials_.push_back(search.template try_method<Method>(id_of<Method>, to_beat));
          const Trial& trial = trials_.back();
          hopeless_ = trial.verdict == Trial::Verdict::failed && !adaptive_;
          if (trial.verdict == Trial::Verdict::accepted && trial.n_forces_of_run < cheapest) best_ = trial;
        }
      });
      n_force_ += search.n_force();
    }
  }

  /// The least that a later method of the table can cost, if there is a choice.
  template <class Method, class Search>
  double least_forces_above(const Search& search) const {
    double least = HUGE_VAL;
    if (request_.method) return least;
    for_each_method([&]<class Other>(Other) {
      if constexpr (!Other::adaptive && method_fits<Other, S>())
        if (id_of < Other >> id_of<Method> && is_candidate<Other>())
          least = std::min(least, search.template least_forces<Other>());
    });
    return least;
  }

  /// What the adaptive method counts for among the others; beyond reach where it misses the tolerance.
  double adaptive_cost() const {
    return adaptive_ && !adaptive_->at_round_off ? price_of_invariants * adaptive_->n_forces_of_run : HUGE_VAL;
  }
  double least_cost() const { return std::min(best_ ? best_->n_forces_of_run : HUGE_VAL, adaptive_cost()); }

  void try_adaptive() {
    for_each_method([&]<class Method>(Method) {
      if constexpr (Method::adaptive && method_fits<Method, S>()) {
        if (!is_candidate<Method>()) return;
        const auto& field = field_of(system_);
        ToleranceSearch<FieldOf<S>, QOf> search(field, initial_, request_, Q_of_);
        trials_.push_back(search.template try_method<Method>());
        n_force_ += search.n_force();
        const Trial& trial = trials_.back();
        if (trial.verdict == Trial::Verdict::accepted) adaptive_ = trial;
        hopeless_ = !adaptive_ || trial.error > asymptotic_difference;
      }
    });
  }

  const S& system_;
  const State<S>& initial_;
  const StepRequest& request_;
  const QOf& Q_of_;
  std::vector<Trial> trials_;
  std::optional<Trial> best_, adaptive_;
  bool hopeless_ = false;  // a motion that ends within the window, or is too sensitive, is so for every method
  long n_force_ = 0;
};

}  // namespace detail

/// The cheapest method, or the step of the one that is asked for. Q_of(state) is the configuration that the tolerance
/// speaks of: a matrix or vector of Eigen. `initial` is at t = 0. A pilot run that fails is repeated with half the
/// step.
template <class S, class QOf>
StepChoice choose_step(const S& system, const State<S>& initial, const StepRequest& request, const QOf& Q_of) {
  return detail::MethodChoice<S, QOf>(system, initial, request, Q_of).choose();
}

}  // namespace pseudorigid::mechanics
