/// The search for a step when pilot runs contain an oscillation that no step resolves. The pilot runs are formulas, so
/// the true error is known.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "mechanics/steps/step_search.h"

namespace pseudorigid::testing {
namespace {

using namespace mechanics;
using namespace mechanics::detail;

constexpr double bound = 9e-5, tolerance = 1e-4, end = 20;

/// The choice for a method of order 4 whose error at the time t with the step h is `error`. Pilot runs fail with steps
/// above `unstable`.
Trial choice(const std::function<double(double h, double t)>& error, double unstable = HUGE_VAL) {
  const StepRequest request{.end = end, .window = 1, .tolerance = tolerance, .rattle_limit = 0.1, .unresolved = bound};
  FixedStepMethod method{id_of<Symmetric4>, 4, 1, Symmetric4::stability_limit, {}};
  method.pilot = [&](double window, long n_samples, long n_steps) {
    const double h = window / static_cast<double>(n_samples * n_steps);
    PilotRun run;
    run.status = h > unstable ? Status::failure("unstable") : Status();
    run.t = window;
    for (long k = 0; k <= n_samples; ++k) {
      const double t = window * static_cast<double>(k) / static_cast<double>(n_samples);
      run.q.push_back(Eigen::VectorXd::Constant(1, error(h, t)));
    }
    run.speed = 1;
    run.n_force = n_samples * n_steps;
    return run;
  };
  return StepSearch(request, false).try_method(method, HUGE_VAL);
}

double oscillation(double h, double t) { return 0.3 * bound * std::sin(50 * t + 1 / h) * std::min(1.0, 10 * t); }

}  // namespace

TEST(UnresolvedOscillation, DoesNotMakeTheStepShort) {
  const Trial trial = choice([](double h, double t) { return std::pow(h, 4) * t + oscillation(h, t); });
  ASSERT_EQ(trial.verdict, Trial::Verdict::accepted) << trial.reason;
  EXPECT_GT(trial.step, 0.005);  // with three halvings, the errors of order 2 are known to be small
  EXPECT_LT(std::pow(trial.step, 4) * end, tolerance);
}

TEST(UnresolvedOscillation, DoesNotHideAnErrorThatFallsSlowly) {
  const auto error = [](double h, double t) { return 0.02 * h * h * t; };
  const Trial trial = choice(error);
  ASSERT_EQ(trial.verdict, Trial::Verdict::accepted) << trial.reason;
  EXPECT_LT(error(trial.step, end), tolerance);
  EXPECT_GT(trial.error, 0.8 * error(trial.step, end));
}

TEST(UnresolvedOscillation, DoesNotHideAnErrorThatIsSmallerThanIt) {
  const auto error = [](double h, double t) { return 0.02 * h * h * t; };
  const Trial trial = choice([&](double h, double t) { return error(h, t) + oscillation(h, t); });
  ASSERT_EQ(trial.verdict, Trial::Verdict::accepted) << trial.reason;
  EXPECT_LT(error(trial.step, end), tolerance);
  EXPECT_GT(trial.error, 0.8 * error(trial.step, end));
  EXPECT_GT(trial.step, 0.001);
}

TEST(UnresolvedOscillation, IsNotSeenWithoutADifferenceBefore) {
  const auto error = [](double h, double t) { return 0.02 * h * h * t; };
  const Trial trial = choice(error, 0.05);  // the first pilot run fails
  ASSERT_EQ(trial.verdict, Trial::Verdict::accepted) << trial.reason;
  EXPECT_LT(error(trial.step, end), tolerance);
  EXPECT_GT(trial.error, 0.8 * error(trial.step, end));
}

}  // namespace pseudorigid::testing
