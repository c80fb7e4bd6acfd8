/// What the tolerance of the constraint does to the invariants of a motion: the whole ball, k = 3, tumbling and
/// pulsating without symmetry, until t = 20 and back again with the velocity reversed.
///
///   constraint_tolerance          one core, about a minute
///
/// CSV: method, tolerance (of |g| and |G v|, scaled as in manifest.json), gram_iterations (a step), then largest over
/// 101 samples: energy (error of it over its start), J (likewise, Euclidean), volume (of the whole, relative), det (of
/// the mean of cells: the scaled |g|), rate (the scaled |G v|); return: |(q, v)|_∞ that is missing when the motion is
/// back.

#include <algorithm>
#include <cstdio>
#include <string>

#include "continuum/body/elastic_ball.h"
#include "continuum/output/observe.h"
#include "measuring.h"
#include "mechanics/methods/composition.h"
#include "mechanics/methods/symmetric_multistep.h"
#include "mechanics/methods/time_loop.h"

namespace {

using namespace pseudorigid;
using benchmarks::require;
using continuum::ElasticBall;
using mechanics::State;
using mechanics::Status;

constexpr double end_time = 20;
constexpr long n_samples = 100, n_steps = 10;

struct Errors {
  double energy = 0, momentum = 0, volume = 0, constraint = 0, rate = 0;
};

/// Hooks of the time loop.
class Watch {
 public:
  explicit Watch(const ElasticBall& ball) : ball_(ball), workspace_(ball.make_workspace()) {}

  template <class W>
  Status sample(long k, const State<ElasticBall>& state, const W&) {
    mechanics::ContinuumObservables o;
    if (Status status = continuum::observe(ball_, state, workspace_, {{.multiplier = false}}, o); !status)
      return status;
    if (k == 0) first_ = o;
    const auto raise = [](double& largest, double value) { largest = std::max(largest, std::abs(value)); };
    raise(errors.energy, o.energy() / first_.energy() - 1);
    raise(errors.momentum, (o.angular_momentum - first_.angular_momentum).norm() / first_.angular_momentum.norm());
    raise(errors.volume, o.volume_ratio - 1);
    auto residual = ball_.make_multiplier();
    if (Status status = ball_.constraint(state.q, residual); !status) return status;
    raise(errors.constraint, mechanics::max_norm(residual) / ball_.multiplier_scale());
    ball_.constraint_rate(state.q, state.v, residual);
    raise(errors.rate, mechanics::max_norm(residual) / ball_.multiplier_scale());
    return {};
  }
  template <class W>
  long steps_per_interval(long, const State<ElasticBall>&, const W&) const {
    return n_steps;
  }
  template <class W>
  bool step_done(mechanics::Cursor, const State<ElasticBall>&, const W&) const {
    return true;
  }

  Errors errors;

 private:
  const ElasticBall& ball_;
  typename ElasticBall::Workspace workspace_;
  mechanics::ContinuumObservables first_;
};

/// Moves the state to the end time, and returns the Gram iterations of a step.
template <class Method>
double move(const ElasticBall& ball, double tolerance, State<ElasticBall>& state, Errors& errors) {
  typename Method::template Workspace<ElasticBall> workspace(ball);
  workspace.constraint_tolerance = tolerance * ball.multiplier_scale();
  mechanics::Cursor cursor;
  Watch watch(ball);
  state.t = 0;
  const auto result = mechanics::run_time_loop<Method>(ball, {end_time, n_samples}, state, cursor, workspace, watch);
  if (result.outcome != mechanics::Outcome::finished) require(Status::failure(result.reason));
  errors = watch.errors;
  return static_cast<double>(workspace.counters.n_gram_iterations) / (n_samples * n_steps);
}

template <class Method>
void measure(const ElasticBall& ball, const State<ElasticBall>& start, double tolerance) {
  State<ElasticBall> state = start;
  Errors errors, on_the_way_back;
  const double n_iterations = move<Method>(ball, tolerance, state, errors);
  mechanics::scale(-1.0, state.v);
  move<Method>(ball, tolerance, state, on_the_way_back);
  mechanics::axpy(-1.0, start.q, state.q);
  mechanics::axpy(1.0, start.v, state.v);
  const double missing = std::max(mechanics::max_norm(state.q), mechanics::max_norm(state.v));
  std::printf("%s,%.0e,%.1f,%.1e,%.1e,%.1e,%.1e,%.1e,%.1e\n", Method::name, tolerance, n_iterations, errors.energy,
              errors.momentum, errors.volume, errors.constraint, errors.rate, missing);
  std::fflush(stdout);
}

}  // namespace

int main() {
  const ElasticBall ball(continuum::Sector{}, 3, 0, materials::CiarletGeymonat{1, 0});
  Eigen::Matrix3d L;  // traceless
  L << 0.1, -0.5, 0.2, 0.4, -0.15, 0.3, -0.1, -0.2, 0.05;
  const State<ElasticBall> start{0, ball.affine_field(Eigen::Matrix3d::Identity()), ball.affine_field(L)};
  std::printf("method,tolerance,gram_iterations,energy,J,volume,det,rate,return\n");
  for (const double tolerance : {1e-13, 1e-9, 1e-7, 1e-5}) {
    measure<mechanics::Rattle>(ball, start, tolerance);
    measure<mechanics::Rattle4>(ball, start, tolerance);
    measure<mechanics::Symmetric4>(ball, start, tolerance);
  }
}
