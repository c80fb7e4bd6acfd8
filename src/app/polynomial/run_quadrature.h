#pragma once
/// The quadrature rule of a polynomial body in a run, and the error of Q that this rule causes. Q is the affine part of
/// the motion, a dimensionless 3×3 matrix. The error is estimated as in polynomial/quadrature_error.h. Numbers of
/// points in this file count the points in each direction of an octant of the body.
///
/// By default the rule has the fewest points that the degree admits. Its error is then below the truncation error of
/// the degree. If Time/Tolerance is below its default 1e-6, the user requests the exact motion of this polynomial body.
/// The program then adds points one by one until the estimated error is at most half of the tolerance. It stops earlier
/// after 8 added points, after a point that does not halve the error, or if a pilot run fails. The program does not add
/// points if the scene sets Time/Step or Polynomial/Quadrature points, or for viscoelastic bodies. It never adds points
/// on the surface, which are for self-gravity. The force of gravity is a sum over pairs of these points. The cost of
/// this sum grows as the fourth power of the number of surface points in each direction.

#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "app/run/run_context.h"
#include "polynomial/quadrature_error.h"

namespace pseudorigid::app {

/// Chooses the rule, estimates its error, and saves both in checkpoints.
template <class Body>
class RunQuadrature {
 public:
  /// `model` is the name of the model for messages. The object refers to `context` and to the text of `model`. `setup`
  /// is the setup of the body of the run.
  RunQuadrature(const RunContext& context, std::string_view model, polynomial::BodySetup setup)
      : context_(context), model_(model), setup_(std::move(setup)) {}

  /// If follows() is true, adds the points that the tolerance requires, and replaces `body` by the body with these
  /// points. Also stores the estimated error of the rule. Must be called before the search for the step. `state` is the
  /// initial state of the run.
  void choose(Body& body, const polynomial::BodyState& state) {
    if (!follows()) return;
    take(polynomial::choose_quadrature(setup_, body, state, request(state, 0, true)), state.t, body);
  }
  /// Estimates the error of the rule if the scene needs this error and it is not known. Must be called after the search
  /// for the step. `stable_step` is the stable step of RATTLE in internal units, or 0 if this step is not known.
  void estimate(Body& body, const polynomial::BodyState& state, double stable_step) {
    if (is_known_ || !context_.needs.quadrature_error) return;
    take(polynomial::choose_quadrature(setup_, body, state, request(state, stable_step, false)), state.t, body);
  }

  /// Three numbers for a checkpoint. The first is the number of points in each direction of an octant, and the second
  /// is the estimated error of Q. The third is the duration, in internal time, of the run for which this error was
  /// estimated. The error is −1 if it was not estimated, and `failed` if the estimate failed. A resumed run uses the
  /// rule of the checkpoint even if the end of the run has changed.
  static constexpr std::size_t n_numbers = 3;
  std::array<double, n_numbers> numbers(const Body& body) const {
    return {static_cast<double>(body.space().n_points_in_direction()), error_.value_or(is_known_ ? failed : -1),
            length_};
  }
  /// Restores the data of `numbers`, and gives `body` the stored number of points.
  void take_numbers(std::span<const double, n_numbers> numbers, Body& body) {
    set_points(static_cast<int>(numbers[0]), body);
    if (numbers[1] >= 0) error_ = numbers[1];
    is_known_ = error_ || numbers[1] == failed;
    length_ = numbers[2];
  }

  /// Adds the number of points in each direction to the counters of `statistics`. Also adds the force evaluations of
  /// the estimates if there are any, and the error if it is known. If the run is now longer than the duration T of the
  /// estimate by a factor a > 1, the error is multiplied by a^quadrature_growth.
  void report(const Body& body, io::Manifest::Model& statistics) const {
    auto& counters = statistics.counters;
    counters["quadrature_points"] = body.space().n_points_in_direction();
    if (n_force_ > 0) counters["quadrature_pilot_forces"] = static_cast<double>(n_force_);
    if (!error_) return;
    const double longer = std::max(1.0, context_.internal_time(context_.scene.time.end) / length_);
    counters["estimated_quadrature_error"] = *error_ * std::pow(longer, polynomial::quadrature_growth);
  }

 private:
  static constexpr double failed = -2;  ///< value of the error in `numbers` if the estimate failed

  /// True if the program may add points. The tolerance is then below its default, and the scene sets neither Time/Step
  /// nor Polynomial/Quadrature points. False for viscoelastic bodies, because the internal strains of their branches
  /// are values at the quadrature points.
  bool follows() const {
    const scene::Scene& scene = context_.scene;
    return setup_.loads.get<loads::Viscoelasticity>().moduli.empty() && !scene.polynomial.quadrature_points &&
           !scene.time.step && scene.time.tolerance < scene::Scene::Time{}.tolerance;
  }

  /// The request for the choice of the rule for a run from `state` to Time/End. `adds_points` is true if points may be
  /// added.
  polynomial::QuadratureRequest request(const polynomial::BodyState& state, double stable_step,
                                        bool adds_points) const {
    return {.end = context_.internal_time(context_.scene.time.end) - state.t,
            .stable_step = stable_step,
            .tolerance = context_.scene.time.tolerance,
            .adds_points = adds_points,
            .give_up = [this] { return context_.interrupted(); }};
  }

  /// Stores the choice for a run from the internal time t, gives `body` the chosen points, and logs the error or a
  /// warning. The function does not log anything for degree 1, and does nothing after an interrupt.
  void take(const polynomial::QuadratureChoice& choice, double t, Body& body) {
    if (context_.interrupted()) return;  // a resumed run chooses again
    error_ = choice.error;
    is_known_ = true;
    length_ = context_.internal_time(context_.scene.time.end) - t;
    n_force_ += choice.n_force;
    set_points(choice.n_points, body);
    if (setup_.degree == 1) return;
    if (!error_)
      context_.log->warn("{}: the error of the quadrature is not known: {}", model_, choice.reason);
    else
      context_.log->info("{}: {} points of quadrature in a direction of an octant, estimated error of Q {:.1e}", model_,
                         choice.n_points, *error_);
    if (follows() && error_ && *error_ > context_.scene.time.tolerance)
      context_.log->warn("{}: the tolerance is below the error of the quadrature", model_);
  }

  /// Replaces the body by a body with n_points points in each direction of an octant, unless it already has this
  /// number.
  void set_points(int n_points, Body& body) {
    setup_.n_points = n_points;
    if (n_points != body.space().n_points_in_direction()) body = Body(setup_);
  }

  const RunContext& context_;
  std::string_view model_;
  polynomial::BodySetup setup_;
  std::optional<double> error_{};  ///< estimated error of Q for a run of duration length_; empty if it is not known
  bool is_known_ = false;          ///< true if the error was estimated, or if the estimate failed
  double length_ = 1;              ///< duration to which error_ applies, in internal units of time
  long n_force_ = 0;               ///< force evaluations of the estimates since this process started
};

}  // namespace pseudorigid::app
