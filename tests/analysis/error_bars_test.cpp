/// The errors of some runs are known. Their bars of a frequency and of all differences contain the effects of these
/// errors.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "analysis/frequency_error.h"
#include "analysis/samples.h"
#include "synthetic_runs.h"

namespace {

using namespace pseudorigid::analysis;
using namespace synthetic;

constexpr double end = 20, omega = exact_omega, amplitude = 1e-3;
const std::vector<double> samples = times(401, end);

/// The pulsation, its phase wrong by `phase(t/end)` times `size`.
Motion with_phase(const std::function<double(double)>& phase, double size) {
  const Eigen::Matrix3d H = Eigen::Vector3d(-0.5, -0.5, 1).asDiagonal();
  const auto Q = [=](double t) -> Eigen::Matrix3d {
    return Eigen::Matrix3d::Identity() + amplitude * std::cos(omega * t + size * phase(t / end)) * H;
  };
  constexpr double h = 1e-5;
  return {Q, [=](double t) -> Eigen::Matrix3d {
            const double before = std::max(t - h, 0.0);
            return (Q(t + h) - Q(before)) / (t + h - before);
          }};
}

/// Largest entry of the error of Q.
double error_of(const Motion& motion) {
  const Motion exact = pulsation(omega, amplitude);
  double largest = 0;
  for (const double t : samples) largest = std::max(largest, (motion.Q(t) - exact.Q(t)).cwiseAbs().maxCoeff());
  return largest;
}

TEST(ErrorBars, TimeErrorsThatGrowAreHeld) {
  struct Shape {
    const char* name;
    std::function<double(double)> phase;
    double part;  ///< of the bar that it reaches at least
  };
  const std::vector<Shape> shapes{{"linear", [](double s) { return s; }, 0.6},
                                  {"quadratic", [](double s) { return s * s; }, 0.6},
                                  {"root", [](double s) { return std::sqrt(s); }, 0.4},
                                  {"cubic", [](double s) { return s * s * s; }, 0.5},
                                  {"jump", [](double s) { return s < 0.5 ? 0.0 : 1.0; }, 0.9}};
  for (const Shape& shape : shapes)
    for (const double size : {1e-4, 1e-2}) {
      const Motion motion = with_phase(shape.phase, size);
      const Table run = continuum_run(motion, samples);
      const Comparison c = compare(run, run, {}, {.continuum = {.time = error_of(motion), .space = 0}});
      ASSERT_TRUE(c.reference.frequency) << shape.name;
      const double error = std::abs(c.reference.frequency.dominant().frequency - omega);
      const double bar = *c.reference.frequency_error.time;
      EXPECT_LE(error, 1.01 * bar) << shape.name << size;  // 1 %: of samples, which are no integral
      EXPECT_GE(error, shape.part * bar) << shape.name << size;
    }
}

TEST(ErrorBars, SpaceErrorFollowsFromAnotherResolution) {
  const Table coarse = continuum_run(pulsation(1.02 * omega), samples),
              fine = continuum_run(pulsation(1.005 * omega), samples);
  const OtherResolution other{coarse, 0.5, 0.5};
  const Table reduced = reduced_run(reduced_pulsation, samples);
  const Comparison c = compare(reduced, fine, {}, {.continuum = {.time = 0, .space = 1e-3, .other = &other}});
  EXPECT_NEAR(*c.reference.frequency_error.space, 0.5 * 0.015 * omega, 1e-6);
  EXPECT_EQ(*c.model.frequency_error.space, 0);
  EXPECT_LE(std::abs(c.ratio->value - incompressible_ball_ratio), *c.ratio->error.total());
  // Of a space error of Q alone nothing follows for a frequency, and a motion that broke off says nothing.
  EXPECT_FALSE(compare(reduced, fine, {}, {.continuum = {.time = 0, .space = 1e-3}}).ratio->error.space);
  const OtherResolution broken_off{continuum_run(pulsation(omega), times(100, 5)), 0.5, 0.5};
  EXPECT_FALSE(
      compare(reduced, fine, {}, {.continuum = {.time = 0, .space = 1e-3, .other = &broken_off}}).ratio->error.space);
}

/// The largest of (a ± δa)/(b ± δb), not its linear part.
TEST(ErrorBars, RatioHoldsTheCornersOfItsFrequencies) {
  const Table coarse = continuum_run(pulsation(1.25 * omega), samples),
              fine = continuum_run(pulsation(1.1 * omega), samples);
  const OtherResolution other{coarse, 1, 1};
  const Comparison c =
      compare(reduced_run(reduced_pulsation, samples), fine, {},
              {.reduced = {.time = 1e-5, .space = 0}, .continuum = {.time = 1e-5, .space = 1e-3, .other = &other}});
  const auto bar_of = [](const ModelSummary& m) { return *m.frequency_error.total(); };
  const double a = c.model.frequency.dominant().frequency, b = c.reference.frequency.dominant().frequency;
  const double corner = (a + bar_of(c.model)) / (b - bar_of(c.reference));
  EXPECT_NEAR(*c.ratio->error.total(), corner - a / b, 1e-12);
  EXPECT_LT((a - bar_of(c.model)) / (b + bar_of(c.reference)), corner);
}

/// Expects that every series is as in `exact`, within its bar. Only the non-affine fraction has none.
void expect_within_bars(const Comparison& c, const Comparison& exact) {
  EXPECT_GE(c.series.size(), 13);
  for (const Series& s : c.series) {
    const auto bar = s.error.total();
    ASSERT_EQ(bar.has_value(), s.name != "nonaffine_kinetic_fraction") << s.name;
    if (!bar) continue;
    const Series& of_exact = *exact.find(s.name);
    constexpr double round_off = 1e-12;
    EXPECT_LE(std::abs(s.max - of_exact.max), *bar + round_off) << s.name;
    EXPECT_LE(std::abs(s.rms - of_exact.rms), *bar + round_off) << s.name;
  }
}

TEST(ErrorBars, DifferencesHoldErrorsInTime) {
  const Table reduced = reduced_run(pulsation(pseudo_rigid_omega, amplitude), samples);
  const Comparison exact = compare(reduced, continuum_run(pulsation(omega, amplitude), samples));
  for (const double size : {1e-3, 0.03, -0.1}) {
    const Motion motion = with_phase([](double s) { return s; }, size);
    // Near the end, where the phase is most wrong, Q may happen to be nearly right at the samples.
    const RunErrors errors{.time = 1.05 * error_of(motion), .space = 0};
    expect_within_bars(compare(reduced, continuum_run(motion, samples), {}, {.continuum = errors}), exact);
    // The same error of the other model, or of its quadrature, has the same bar.
    const auto bar_of = [&](const RunErrors& of_model, const char* series) {
      return *compare(reduced, reduced, {}, {.reduced = of_model}).find(series)->error.total();
    };
    for (const char* series : {"q_difference", "strain_difference", "a3_difference", "kinetic_difference"})
      EXPECT_DOUBLE_EQ(bar_of(errors, series), bar_of({.time = 0, .space = 0, .quadrature = errors.time}, series));
  }
}

/// A relative difference has the values of model r as its divisor. An error of this model therefore counts more.
TEST(ErrorBars, ErrorsOfDivisorsCount) {
  const Table reduced = reduced_run(pulsation(pseudo_rigid_omega, 0.1), ten),
              continuum = continuum_run(pulsation(omega, 0.1), ten);
  const RunErrors wrong{.time = 1e-4, .space = 0};
  const Comparison of_model = compare(reduced, continuum, {}, {.reduced = wrong});
  const Comparison of_reference = compare(reduced, continuum, {}, {.continuum = wrong});
  for (const char* name : {"q_difference", "a1_difference", "a3_difference"}) {
    const Series& s = *of_model.find(name);
    EXPECT_GT(s.max, 0.05) << name;
    EXPECT_NEAR(*s.error.time / *of_reference.find(name)->error.time, 1 + s.max, 1e-12) << name;
  }
}

TEST(ErrorBars, DifferencesHoldErrorsInSpace) {
  const Table reduced = reduced_run(pulsation(pseudo_rigid_omega, amplitude), samples);
  const Table truth = continuum_run(pulsation(omega, amplitude), samples);
  const Table fine = continuum_run(pulsation(1.005 * omega, amplitude), samples);
  const OtherResolution other{continuum_run(pulsation(1.02 * omega, amplitude), samples), 0.5, 0.5};
  const auto Q = read<Eigen::Matrix3d>(fine, Q_columns), Q_other = read<Eigen::Matrix3d>(other.samples, Q_columns);
  const double relative = 0.5 * largest(each(ratio_or_zero, distances(Q, Q_other), norms(Q)));
  const KnownErrors errors{.continuum = {.time = 0, .space = relative, .other = &other}};
  const Comparison c = compare(reduced, fine, {}, errors);
  expect_within_bars(c, compare(reduced, truth));
  const Series& kinetic = *c.find("kinetic_difference");
  const double apart = largest(each(std::minus{}, fine.column("kinetic"), other.samples.column("kinetic")));
  // The elastic energy, which completes the kinetic one to 1, has the same error. The divisor has both.
  EXPECT_NEAR(*kinetic.error.space, 0.5 * apart / kinetic.reference * (1 + 2 * kinetic.max), 1e-15);
  // Without samples on another discretisation only functions of Q have a bar.
  const Comparison without = compare(reduced, fine, {}, {.continuum = {.time = 0, .space = relative}});
  EXPECT_TRUE(without.find("strain_difference")->error.total());
  EXPECT_TRUE(without.find("a1_difference")->error.total());
  EXPECT_FALSE(without.find("kinetic_difference")->error.total());
  EXPECT_FALSE(without.find("phase_difference")->error.total());
}

/// A momentum is a constant of the motion if no load acts: its error is its drift. With a load, its error is unknown
/// without the error of Q.
TEST(ErrorBars, ConstantsOfTheMotionHaveTheirDrift) {
  const Motion spinning = turning(pulsation(omega, 0.1), 0.3);
  const auto with_drift = [&](double drift) {
    return continuum_run(spinning, ten, {.orbit = false}, [drift](double t, auto& o) {
      o.angular_momentum = Eigen::Vector3d::UnitZ() * (1 + drift * t / 10);
    });
  };
  const Table steady = with_drift(0), drifting = with_drift(1e-3);
  const KnownErrors unknown_in_time{.reduced = {.time = {}, .space = 0}, .continuum = {.time = {}, .space = 0}};
  const ComparisonOptions free{.facts = {.is_free = true}};
  const auto bar = [&](const Table& table, const ComparisonOptions& options) {
    return compare(steady, table, options, unknown_in_time).find("angular_momentum_difference")->error.time;
  };
  EXPECT_NEAR(*bar(drifting, free), 1e-3, 2e-6);  // and 1 + the difference 1e-3
  EXPECT_EQ(*bar(steady, free), 0);
  EXPECT_FALSE(bar(drifting, {}));
}

TEST(ErrorBars, PartsAreNamed) {
  EXPECT_EQ(*ErrorBar({.fit = 1, .time = 2, .space = 4}).total(), 7);
  EXPECT_FALSE(ErrorBar({.fit = 1, .time = 2}).total());
  EXPECT_EQ(*ErrorBar({.time = 1, .space = 2, .quadrature = 4}).total(), 7);
  EXPECT_FALSE(ErrorBar({.time = 1, .space = 2, .quadrature = {}}).total());
  EXPECT_EQ(in_short({.time = 0.5, .space = 1}), " +- 2");
  EXPECT_NE(in_short({.time = 1}).find("space not known"), std::string::npos);
  EXPECT_NE(in_short({.time = 1, .space = 1, .quadrature = {}}).find("quadrature not known"), std::string::npos);
  EXPECT_NE(parts_in_words({.time = 1, .space = 1, .quadrature = 2}).find("quadrature 2"), std::string::npos);
  EXPECT_NE(parts_in_words({.fit = 0.1, .space = 1}).find("time not known"), std::string::npos);
}

}  // namespace
