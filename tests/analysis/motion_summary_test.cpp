#include "analysis/motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "synthetic_runs.h"

namespace {

using namespace pseudorigid::analysis;
using namespace synthetic;

bool says(const MotionSummary& summary, const std::string& words) {
  return terminal_table(summary).find(words) != std::string::npos;
}

/// Rows of time, kinetic, potential and energy.
MotionSummary of_system(double (*kinetic)(double), double (*potential)(double)) {
  Table table{.columns = {"time", "kinetic", "potential", "energy"}, .values = {}};
  for (const double t : ten) {
    const double K = kinetic(t), U = potential(t);
    table.values.insert(table.values.end(), {t, K, U, K + U});
  }
  return summarize_system({"system", "system", table});
}

double noise(double t) { return 3e-16 * std::sin(97 * t); }

/// Of a free body the kinetic energy is constant but for round-off, which is no measure of a drift.
TEST(MotionSummary, DriftIsComparedWithTheEnergyThatThereIs) {
  const MotionSummary free = of_system([](double t) { return 0.5 + noise(t); }, [](double) { return 0.0; });
  EXPECT_LT(*free.model.energy_drift, 1e-14);
  EXPECT_TRUE(says(free, "constant to round-off"));
  // At rest at a height: all is round-off of the potential.
  const MotionSummary rest = of_system([](double) { return 1e-33; }, [](double t) { return -3 + noise(t); });
  EXPECT_LT(*rest.model.energy_drift, 1e-14);
  // A pendulum that loses a thousandth of what goes to and fro, on a height that does not matter.
  const auto K = [](double t) { return std::pow(std::sin(t), 2) * (1 - 1e-4 * t); };
  const MotionSummary swings = of_system(K, [](double t) { return 100 + std::pow(std::cos(t), 2); });
  EXPECT_NEAR(*swings.model.energy_drift, 1e-3, 5e-4);
  EXPECT_FALSE(says(swings, "constant"));
}

MotionSummary of_ball(const std::function<void(double, ContinuumObservables&)>& change, const SceneFacts& facts = {},
                      const Motion& motion = reduced_pulsation, const RunErrors& errors = {.time = 1e-8, .space = 0}) {
  const Table table = continuum_run(motion, ten, {.orbit = false}, change);
  return summarize_motion({"continuum", "elastic", table, errors}, facts);
}

TEST(MotionSummary, EnergiesOfABallAtRestAreRoundOff) {
  const auto at_rest = [](double gravity) {
    return [=](double t, ContinuumObservables& o) {
      o.kinetic = 1e-31 * (1 + std::sin(t));
      o.elastic = 1e-32;
      o.gravitational = -gravity * (1 + noise(t));
    };
  };
  const SceneFacts facts{.energy_unit = 1};
  for (const double gravity : {0.0, 0.6})
    EXPECT_LT(*of_ball(at_rest(gravity), facts).model.energy_drift, 1e-14) << gravity;
  // A small motion is a motion: E = 1e-10 of the unit, which loses a hundredth.
  const auto small = [](double t, ContinuumObservables& o) {
    o.kinetic = 1e-10 * (1 - 1e-3 * t);
    o.elastic = 0;
  };
  EXPECT_NEAR(*of_ball(small, facts).model.energy_drift, 1e-2, 1e-9);
}

/// The energy falls by 2e-3 a unit of time, from 1: to within 1 % until t = 5, and to within 4τ|Q|/D sooner.
TEST(MotionSummary, EnergyBeyondItsBoundIsReportedWithItsTime) {
  const auto leaks = [](double rate) {
    return [=](double t, ContinuumObservables& o) {
      o.kinetic = 1;
      o.elastic = -rate * t;
    };
  };
  EXPECT_FALSE(of_ball(leaks(0.9e-3)).model.energy_beyond_since);
  EXPECT_TRUE(energy_clause(of_ball(leaks(0.9e-3)).model).empty());
  const MotionSummary lost = of_ball(leaks(2e-3));
  const double interval = ten[1] - ten[0];
  EXPECT_GE(*lost.model.energy_beyond_since, 5);
  EXPECT_LE(*lost.model.energy_beyond_since, 5 + 1.01 * interval);
  EXPECT_TRUE(says(lost, "the elastic ball changes by up to 2 %"));
  const MotionSummary precise = of_ball(leaks(2e-3), {.tolerance = 1e-5});
  const double bound = 4e-5 * std::sqrt(3.0) / precise.model.departure;
  EXPECT_LT(bound, 0.005);
  EXPECT_GE(*precise.model.energy_beyond_since, bound / 2e-3);
  EXPECT_LE(*precise.model.energy_beyond_since, bound / 2e-3 + 1.01 * interval);
}

TEST(MotionSummary, FailedStepsAreCounted) {
  ModelSummary summary;
  summary.name = "continuum", summary.adjective = "elastic";
  EXPECT_TRUE(failure_clause(summary).empty());
  summary.n_failed_intervals = 3;
  EXPECT_NE(failure_clause(summary).find("elastic"), std::string::npos);
  EXPECT_NE(failure_clause(summary).find("3 times"), std::string::npos);
}

TEST(MotionSummary, FrequencyHasABarOnlyIfAllItsErrorsAreKnown) {
  EXPECT_TRUE(says(of_ball({}), " +- "));
  EXPECT_FALSE(says(of_ball({}, {}, reduced_pulsation, {.time = 1e-8}), " +- "));
  EXPECT_TRUE(says(of_ball({}, {}, reduced_pulsation, {.time = 1e-8}), "error in space not known"));
  EXPECT_TRUE(says(of_ball({}, {.load_frequencies = {pseudo_rigid_omega}}), "that of a load"));
}

}  // namespace
