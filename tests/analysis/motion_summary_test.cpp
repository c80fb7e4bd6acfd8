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
  const Table table = continuum_run(motion, ten, {}, change);
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

TEST(MotionSummary, FrequencyHasABarOnlyIfAllItsErrorsAreKnown) {
  EXPECT_TRUE(says(of_ball({}), " +- "));
  EXPECT_FALSE(says(of_ball({}, {}, reduced_pulsation, {.time = 1e-8}), " +- "));
  EXPECT_TRUE(says(of_ball({}, {}, reduced_pulsation, {.time = 1e-8}), "error in space not known"));
  EXPECT_TRUE(says(of_ball({}, {.load_frequencies = {pseudo_rigid_omega}}), "that of a load"));
}

}  // namespace
