/// choose_step on the reduced body: the tolerance is met, the cost is near the least, hopeless requests are told.

#include "mechanics/steps/step_size.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "mechanics/steps/largest_frequency.h"
#include "reduced/bodies.h"

namespace pseudorigid::testing {
namespace {

using mechanics::affine_rate;
using mechanics::choose_step;
using mechanics::id_of;
using mechanics::MethodId;
using mechanics::Rattle;
using mechanics::Rattle8;
using mechanics::StepChoice;
using mechanics::StepRequest;

constexpr double end = 40;
constexpr long n_samples = 40;

Matrix3d Q_of(const State<Sl3>& s) { return s.q; }

StepRequest request_for(const State<Sl3>& initial, double tolerance) {
  const Sl3 body = neo_hookean_sl3();
  Sl3::Workspace w;
  const auto frequency = mechanics::largest_frequency(body, initial, w, 12);
  EXPECT_TRUE(frequency.status);
  return {.end = end,
          .window = end / 5,
          .tolerance = tolerance,
          .rattle_limit = mechanics::rattle_step_limit(frequency.omega, affine_rate(initial.q, initial.v))};
}

StepChoice choose(const State<Sl3>& initial, const StepRequest& request) {
  auto choice = choose_step(neo_hookean_sl3(), initial, request, Q_of);
  EXPECT_TRUE(choice.status) << choice.status.reason();
  return choice;
}

/// Largest error of Q over the samples against a much finer run, infinite if the run fails; and the forces that it
/// counts for.
struct Cost {
  double error;
  double n_force;
};
template <class Method>
double forces(long n_steps) {
  return static_cast<double>(n_samples * n_steps) * mechanics::detail::forces_of_step<Method>(neo_hookean_sl3());
}
Cost measure(const State<Sl3>& initial, MethodId method, long n_steps, const RecordedRun<Sl3>& reference) {
  return mechanics::with_method(method, [&]<class Method>(Method) -> Cost {
    if constexpr (mechanics::method_fits<Method, Sl3>()) {
      const auto r = run<Method>(neo_hookean_sl3(), initial, end, n_samples, n_steps);
      double error = r.finished() ? 0 : HUGE_VAL;
      for (std::size_t k = 0; k < r.states.size(); ++k)
        error = std::max(error, (r.states[k].q - reference.states[k].q).cwiseAbs().maxCoeff());
      return {error, forces<Method>(n_steps)};
    } else {
      return {HUGE_VAL, 0};
    }
  });
}

RecordedRun<Sl3> reference_run(const State<Sl3>& initial) {
  return run<mechanics::Rattle8>(neo_hookean_sl3(), initial, end, n_samples, 36);
}
long steps_per_sample(double step) { return mechanics::SampleTimes{end, n_samples}.steps_per_interval(step); }

/// The least forces of any method that meets the tolerance, looked for below a bound.
double cheapest_below(double bound, double tolerance, const State<Sl3>& initial, const RecordedRun<Sl3>& reference) {
  mechanics::for_each_method([&]<class Method>(Method) {
    if constexpr (mechanics::auto_considers<Method, Sl3> && !Method::adaptive)
      for (long n = 1; forces<Method>(n) < bound; n += std::max(1L, n / 3))
        if (measure(initial, id_of<Method>, n, reference).error <= tolerance) bound = forces<Method>(n);
  });
  return bound;
}

struct NamedState {
  std::string name;
  State<Sl3> state;
};

class ChosenStep : public ::testing::TestWithParam<NamedState> {};

TEST_P(ChosenStep, MeetsTheToleranceAtAReasonableCost) {
  const auto initial = GetParam().state;
  const auto reference = reference_run(initial);
  for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
    const auto choice = choose(initial, request_for(initial, tolerance));
    const Cost cost = measure(initial, choice.method, steps_per_sample(choice.step), reference);
    EXPECT_LE(cost.error, tolerance) << choice.why;
    EXPECT_LE(choice.error, tolerance) << choice.why;
    const double least = cheapest_below(cost.n_force, tolerance, initial, reference);
    EXPECT_LE(cost.n_force, 2 * least) << choice.why;
    RecordProperty("at_" + std::to_string(-std::lround(std::log10(tolerance))),
                   choice.why + "; error " + std::to_string(cost.error / tolerance) + " of the tolerance, " +
                       std::to_string(cost.n_force / least) + " times the least cost");
  }
}

TEST_P(ChosenStep, MeetsTheToleranceWithAFixedMethod) {
  const auto initial = GetParam().state;
  const auto reference = reference_run(initial);
  mechanics::for_each_method([&]<class Method>(Method) {
    if constexpr (!Method::adaptive && mechanics::method_fits<Method, Sl3>()) {
      auto request = request_for(initial, 1e-5);
      request.method = id_of<Method>;
      const auto choice = choose(initial, request);
      ASSERT_EQ(choice.method, id_of<Method>);
      EXPECT_LE(measure(initial, id_of<Method>, steps_per_sample(choice.step), reference).error, 1e-5) << choice.why;
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Sl3, ChosenStep,
                         ::testing::Values(NamedState{"benchmark", benchmark_state<Sl3>()},
                                           NamedState{"stretched", stretched(2)}, NamedState{"spin", fast_spin()},
                                           NamedState{"small", small_motion()}, NamedState{"large", large_motion()}),
                         [](const auto& info) { return info.param.name; });

TEST(StepSize, IsDeterministic) {
  const auto initial = benchmark_state<Sl3>();
  const auto a = choose(initial, request_for(initial, 1e-7)), b = choose(initial, request_for(initial, 1e-7));
  EXPECT_EQ(a.step, b.step);
  EXPECT_EQ(a.method, b.method);
  EXPECT_EQ(a.why, b.why);
  EXPECT_EQ(a.n_force, b.n_force);
}

TEST(StepSize, GoesUpInOrderAsTheToleranceFalls) {
  const auto initial = small_motion();
  EXPECT_EQ(choose(initial, request_for(initial, 1e-1)).method, id_of<Rattle>);
  EXPECT_EQ(choose(initial, request_for(initial, 1e-9)).method, id_of<mechanics::Gauss16>);
}

TEST(StepSize, RespectsTheBoundGiven) {
  const auto initial = benchmark_state<Sl3>();
  auto request = request_for(initial, 1e-2);
  request.step_bound = 0.003;
  const auto choice = choose(initial, request);
  EXPECT_LE(choice.step, 0.003);
  EXPECT_NE(choice.why.find("the bound given"), std::string::npos) << choice.why;
}

TEST(StepSize, SaysWhenDoublePrecisionDoesNotReachTheTolerance) {
  const auto initial = benchmark_state<Sl3>();
  for (const double tolerance : {1e-14, 1e-30}) {
    const auto choice = choose(initial, request_for(initial, tolerance));
    EXPECT_NE(choice.why.find("below the accuracy of double precision"), std::string::npos) << choice.why;
    EXPECT_GT(choice.error, tolerance);
    EXPECT_LT(choice.error, 1e-10);
    EXPECT_GT(choice.step, 1e-3) << "no step is wasted on round-off";
  }
}

TEST(StepSize, OfABodyAtRestIsTheStabilityLimit) {
  const auto request = request_for(stretched(1), 1e-8);
  const auto choice = choose(stretched(1), request);
  EXPECT_EQ(choice.method, id_of<Rattle>);
  EXPECT_NEAR(choice.step, request.rattle_limit, 0.1 * request.rattle_limit);
}

/// Steps of an adaptive method are as long as it likes there, and would magnify kicks of round-off by themselves.
TEST(StepSize, ABodyAtRestIsNotCalledUnstable) {
  for (const double time : {10.0, 3.3e8}) {
    auto request = request_for(stretched(1), 1e-6);
    request.end = time;
    request.window = std::min(20.0, time);
    request.method = id_of<mechanics::DormandPrince8>;
    const auto choice = choose(stretched(1), request);
    EXPECT_FALSE(choice.round_off_rules_from) << choice.why;
    EXPECT_FALSE(choice.at_round_off) << choice.why;
    EXPECT_LT(choice.error, 1e-9) << choice.why;
  }
}

/// Round-off of regular motions grows slowly, and is no instability of theirs.
TEST(StepSize, ALongRegularMotionIsNotCalledUnstable) {
  auto request = request_for(small_motion(), 1e-6);
  request.end = 1e6;
  request.window = 20;
  request.method = id_of<mechanics::DormandPrince8>;
  const auto choice = choose(small_motion(), request);
  EXPECT_FALSE(choice.round_off_rules_from) << choice.why;
}

/// SL(3) has eight directions. Iterations beyond them once met a state (t = 84 of this motion) where round-off grew to
/// a frequency of 2e7, and the step fell to a millionth.
TEST(StepSize, FrequencyStaysThatOfTheBodyAlongALongMotion) {
  const Sl3 body = neo_hookean_sl3();
  const auto start = moving<Sl3>(diagonal(1.05, 1, 1 / 1.05), matrix({0, -0.9, 0.1, 0.9, 0, 0, 0.1, 0, 0}));
  const auto r = run<mechanics::Rattle4>(body, start, 200, 4000, 1);
  ASSERT_TRUE(r.finished()) << r.result.reason;
  Sl3::Workspace workspace;
  for (const auto& state : r.states) {
    const auto frequency = mechanics::largest_frequency(body, state, workspace, 24);
    ASSERT_TRUE(frequency.status) << frequency.status.reason();
    EXPECT_GT(frequency.omega, 2.5) << state.t;  // √10 at rest
    EXPECT_LT(frequency.omega, 4) << state.t;
  }
}

TEST(StepSize, HalvesTheStepWhereAPilotRunFails) {
  const auto initial = benchmark_state<Sl3>();
  auto request = request_for(initial, 1e-4);
  const double sound = choose(initial, request).step;
  request.rattle_limit *= 50;  // far beyond stability
  EXPECT_NEAR(choose(initial, request).step, sound, 0.5 * sound);
}

TEST(StepSize, ReportsWhyNoStepCanBeFound) {
  const auto inside_out = moving<Sl3>(diagonal(-1, 1, 1), Matrix3d::Zero());
  const StepRequest request{.end = 1, .window = 1, .tolerance = 1e-6, .rattle_limit = 0.5};
  const auto choice = choose_step(neo_hookean_sl3(), inside_out, request, Q_of);
  EXPECT_FALSE(choice.status);
  EXPECT_NE(choice.status.reason().find("turned inside out"), std::string::npos) << choice.status.reason();
}

TEST(StepSize, StabilityLimitSeesTheRateOfTheMotion) {
  const Matrix3d Id = Matrix3d::Identity();
  EXPECT_NEAR(mechanics::rattle_step_limit(4, affine_rate(Id, Matrix3d::Zero()), 1), 0.5, 1e-15);
  EXPECT_NEAR(mechanics::rattle_step_limit(4, affine_rate(Id, hat({0, 0, 6})), 1), 0.2, 1e-15);
  EXPECT_NEAR(mechanics::rattle_step_limit(0, affine_rate(2 * Id, diagonal(8, 0, 0)), 0.5), 0.25, 1e-15);
}

}  // namespace
}  // namespace pseudorigid::testing
