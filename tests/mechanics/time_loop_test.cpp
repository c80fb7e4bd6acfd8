/// Sample times, whole numbers of steps, interruption and resumption.

#include "mechanics/methods/time_loop.h"
#include "mechanics/core/memory.h"

#include <gtest/gtest.h>

#include "mechanics/toy_systems.h"
#include "support/runs.h"

namespace pseudorigid::testing {
namespace {

using mechanics::Cursor;
using mechanics::Outcome;
using mechanics::Rattle8;
using mechanics::RattleWorkspace;
using mechanics::SampleTimes;
using mechanics::State;

TEST(SampleTimes, LastOneIsTheEndExactly) {
  for (const double end : {0.1, 1.0, 10.0 / 3, 7.7e5})
    for (const long n : {1L, 3L, 7L, 49L, 1000L}) EXPECT_EQ((SampleTimes{end, n}[n]), end);
}

TEST(SampleTimes, StepIsAnUpperBoundAndNotCutWithoutNeed) {
  EXPECT_EQ((SampleTimes{1, 10}.steps_per_interval(0.1)), 1);
  EXPECT_EQ((SampleTimes{1, 10}.steps_per_interval(0.02)), 5);
  EXPECT_EQ((SampleTimes{1, 10}.steps_per_interval(0.0199)), 6);
  EXPECT_EQ((SampleTimes{1, 10}.steps_per_interval(5)), 1);
  for (const double step : {0.013, 0.3, 0.07}) {
    const SampleTimes times{3, 7};
    const double h = times.interval() / static_cast<double>(times.steps_per_interval(step));
    EXPECT_LE(h, step * (1 + 1e-12));
  }
}

/// Steps beyond the range of whole numbers are not cut down to one, and steps that time does not resolve are refused.
TEST(TimeLoop, StepsBelowTheResolutionOfTimeAreRefused) {
  EXPECT_GT((SampleTimes{10, 10}.steps_per_interval(1e-300)), 1'000'000'000'000'000'000);
  mechanics::State<SphericalPendulum> state = SphericalPendulum::swinging();
  Cursor cursor;
  RattleWorkspace<SphericalPendulum> workspace{SphericalPendulum{}};
  struct Hooks {
    mechanics::Status sample(long, const mechanics::State<SphericalPendulum>&,
                             const RattleWorkspace<SphericalPendulum>&) {
      return {};
    }
    long steps_per_interval(long, const mechanics::State<SphericalPendulum>&,
                            const RattleWorkspace<SphericalPendulum>&) const {
      return SampleTimes{10, 10}.steps_per_interval(1e-18);
    }
    bool step_done(Cursor, const mechanics::State<SphericalPendulum>&,
                   const RattleWorkspace<SphericalPendulum>&) const {
      return true;
    }
  } hooks;
  const auto result =
      mechanics::run_time_loop<mechanics::Rattle>(SphericalPendulum{}, {10, 10}, state, cursor, workspace, hooks);
  EXPECT_EQ(result.outcome, Outcome::failed);
  EXPECT_EQ(result.reason, "the step is shorter than the least difference of times in double precision");
}

TEST(TimeLoop, SamplesAreAtTheirTimesExactly) {
  const auto r = run<mechanics::Rattle4>(SphericalPendulum{}, SphericalPendulum::swinging(), 10.0 / 3, 7, 3);
  ASSERT_EQ(r.states.size(), 8u);
  for (long k = 0; k <= 7; ++k) EXPECT_EQ(r.states[static_cast<std::size_t>(k)].t, (SampleTimes{10.0 / 3, 7}[k]));
  EXPECT_EQ(r.result.t, 10.0 / 3);
}

TEST(TimeLoop, SamplesDoNotDisturbTheSteps) {
  const auto once = run<Rattle8>(SphericalPendulum{}, SphericalPendulum::swinging(), 8, 1, 64);
  const auto often = run<Rattle8>(SphericalPendulum{}, SphericalPendulum::swinging(), 8, 32, 2);
  EXPECT_LT(distance(once.last(), often.last()), 1e-13);
  EXPECT_EQ(once.counters.n_force, often.counters.n_force);
}

TEST(TimeLoop, IdenticalRunsAreBitwiseEqual) {
  const auto a = run<Rattle8>(SphericalPendulum{}, SphericalPendulum::swinging(), 8, 5, 11);
  const auto b = run<Rattle8>(SphericalPendulum{}, SphericalPendulum::swinging(), 8, 5, 11);
  EXPECT_EQ(distance(a, b), 0);
}

/// Interrupts after n steps, goes on from a copy of what a checkpoint keeps, and returns all samples.
template <class Method>
std::vector<State<SphericalPendulum>> interrupted_run(const SampleTimes& times, long n_steps, long n_before) {
  const SphericalPendulum pendulum;
  Recorder<SphericalPendulum> hooks{n_steps, n_before};
  auto state = SphericalPendulum::swinging();
  Cursor cursor;
  RattleWorkspace<SphericalPendulum> before(pendulum);
  const auto stopped = mechanics::run_time_loop<Method>(pendulum, times, state, cursor, before, hooks);
  EXPECT_EQ(stopped.outcome, Outcome::interrupted);
  EXPECT_EQ(cursor.sample * n_steps + cursor.step, n_before);

  RattleWorkspace<SphericalPendulum> after(pendulum);
  std::vector<double> memory;
  mechanics::save_memory(before, memory);
  EXPECT_TRUE(mechanics::restore_memory(after, memory));
  State<SphericalPendulum> restored{state.t, state.q, state.v};
  const auto finished = mechanics::run_time_loop<Method>(pendulum, times, restored, cursor, after, hooks);
  EXPECT_EQ(finished.outcome, Outcome::finished);
  return hooks.states;
}

template <class Method>
void expect_bitwise_resumption() {
  const SampleTimes times{6, 4};
  const auto whole = run<Method>(SphericalPendulum{}, SphericalPendulum::swinging(), times.end, times.n_samples, 10);
  for (const long n_before : {1L, 7L, 10L, 23L}) {
    const auto resumed = interrupted_run<Method>(times, 10, n_before);
    ASSERT_EQ(resumed.size(), whole.states.size());
    for (std::size_t k = 0; k < resumed.size(); ++k)
      EXPECT_EQ(distance(resumed[k], whole.states[k]), 0) << "sample " << k << ", stopped after " << n_before;
  }
}

TEST(TimeLoop, ResumesBitwiseFromTheMiddleOfAnInterval) {
  expect_bitwise_resumption<mechanics::Rattle>();
  expect_bitwise_resumption<mechanics::Rattle4>();
  expect_bitwise_resumption<mechanics::Rattle8>();
}

}  // namespace
}  // namespace pseudorigid::testing
