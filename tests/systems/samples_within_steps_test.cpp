/// Samples within the steps of Gauss collocation: their accuracy, steps that do not depend on them, memory, and a
/// choice of the step that is not bound by them.

#include <gtest/gtest.h>

#include "mechanics/core/memory.h"
#include "mechanics/methods/gauss_16.h"
#include "mechanics/steps/step_size.h"
#include "support/runs.h"
#include "systems/double_pendulum.h"
#include "systems/euler_top.h"

namespace pseudorigid::testing {
namespace {

using mechanics::Gauss16;
using mechanics::State;
using Pendulum = systems::DoublePendulum;

constexpr double end = 10, tolerance = 1e-8;

const Pendulum pendulum({1.3, 0.7, 0.8, 1.1, 0.9});

State<Pendulum> start() {
  State<Pendulum> state;
  pendulum.from_angles({0.6, 0.8}, {0.2, -0.3}, state.q, state.v);
  return state;
}

/// All samples in one stretch.
struct OneStretch : Recorder<Pendulum> {
  long n_samples = 1;
  template <class W>
  mechanics::Stretch stretch(long, const State<Pendulum>&, const W&) {
    return {0, n_samples, n_steps};
  }
};

struct DenseRun {
  mechanics::Cursor cursor{};
  State<Pendulum> state = start();
  std::vector<double> memory{};
  OneStretch hooks{};

  /// Goes on with a workspace of its own.
  mechanics::Outcome go_on() {
    mechanics::Gauss16Workspace<Pendulum> w(pendulum);
    w.interpolation_tolerance = tolerance;
    EXPECT_TRUE(memory.empty() || mechanics::restore_memory(w, memory));
    auto result = mechanics::run_time_loop<Gauss16>(pendulum, {end, hooks.n_samples}, state, cursor, w, hooks);
    mechanics::save_memory(w, memory);
    return result.outcome;
  }
};

DenseRun run_with(long n_samples, long n_steps = 30) {
  DenseRun run;
  run.hooks.n_samples = n_samples;
  run.hooks.n_steps = n_steps;
  EXPECT_EQ(run.go_on(), mechanics::Outcome::finished);
  EXPECT_EQ(run.hooks.states.size(), static_cast<std::size_t>(n_samples) + 1);
  return run;
}

TEST(SamplesWithinSteps, AreAsAccurateAsAsked) {
  const auto dense = run_with(500);
  const auto fine = run<Gauss16>(pendulum, start(), end, 500, 4);
  ASSERT_TRUE(fine.finished());
  double error = 0, constraint = 0;
  for (std::size_t k = 0; k < fine.states.size(); ++k) {
    error = std::max(error, distance(dense.hooks.states[k], fine.states[k]));
    Eigen::Vector2d g;
    ASSERT_TRUE(pendulum.constraint(dense.hooks.states[k].q, g));
    constraint = std::max(constraint, g.cwiseAbs().maxCoeff());
    EXPECT_DOUBLE_EQ(dense.hooks.states[k].t, fine.states[k].t);
  }
  EXPECT_LT(error, tolerance);
  EXPECT_GT(error, 1e-14);  // otherwise nothing was interpolated
  EXPECT_LT(constraint, 1e-15);
}

TEST(SamplesWithinSteps, DoNotChangeTheSteps) {
  const auto few = run_with(1), many = run_with(777);
  EXPECT_EQ(few.state.q, many.state.q);
  EXPECT_EQ(few.state.v, many.state.v);
}

/// A step that is too long for its polynomial between the ends is halved, and the samples are those of its parts.
TEST(SamplesWithinSteps, OfStepsThatAreHalved) {
  const auto dense = run_with(200, 8);
  const auto fine = run<Gauss16>(pendulum, start(), end, 200, 4);
  double error = 0;
  for (std::size_t k = 0; k < fine.states.size(); ++k)
    error = std::max(error, distance(dense.hooks.states[k], fine.states[k]));
  EXPECT_LT(error, 10 * tolerance);
}

TEST(SamplesWithinSteps, ResumeBitByBit) {
  const auto whole = run_with(100);
  DenseRun run;
  run.hooks.n_samples = 100;
  run.hooks.n_steps = 30;
  run.hooks.n_steps_allowed = 7;
  EXPECT_EQ(run.go_on(), mechanics::Outcome::interrupted);
  EXPECT_EQ(run.cursor.step, 7);
  EXPECT_EQ(run.hooks.states.size(), 24u);  // 7/30 of 100 samples and the first
  run.hooks.n_steps_allowed = -1;
  EXPECT_EQ(run.go_on(), mechanics::Outcome::finished);
  ASSERT_EQ(run.hooks.states.size(), whole.hooks.states.size());
  for (std::size_t k = 0; k < whole.hooks.states.size(); ++k) {
    EXPECT_EQ(run.hooks.states[k].q, whole.hooks.states[k].q);
    EXPECT_EQ(run.hooks.states[k].v, whole.hooks.states[k].v);
  }
}

TEST(SamplesWithinSteps, DoNotBindTheChoiceOfTheStep) {
  const auto step_with = [](double interval, std::optional<mechanics::MethodId> method) {
    mechanics::StepRequest request{.end = 100, .window = 20, .tolerance = 1e-6, .rattle_limit = 0.8};
    request.interval = interval;
    request.method = method;
    const auto choice = mechanics::choose_step(pendulum, start(), request, [](const auto& s) { return s.q; });
    EXPECT_TRUE(choice.status) << choice.status.reason();
    return choice.step;
  };
  const auto gauss = mechanics::id_of<Gauss16>;
  EXPECT_EQ(step_with(0.01, gauss), step_with(0.001, gauss));
  EXPECT_GT(step_with(0.01, gauss), 0.1);
  EXPECT_LE(step_with(0.01, mechanics::id_of<mechanics::Rattle8>), 0.01);
}

}  // namespace
}  // namespace pseudorigid::testing
