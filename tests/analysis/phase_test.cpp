/// Phases of sinusoids against their definition, and what a signal needs to have one.

#include "analysis/phase.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace {

using pseudorigid::analysis::phase;
constexpr double half_turn = std::numbers::pi;

std::vector<double> sampled(const std::function<double(double)>& y, double interval, int n) {
  std::vector<double> values;
  for (int k = 0; k < n; ++k) values.push_back(y(k * interval));
  return values;
}

TEST(Phase, OfASinusoidIsExact) {
  // 40.3 samples in a period; the mean is 10⁶ times the amplitude in the second case.
  const double omega = 2.7, interval = 2 * half_turn / omega / 40.3;
  for (const auto& [mean, amplitude, accuracy] : {std::tuple(0.3, 1.0, 1e-12), {1.0, 1e-6, 1e-8}}) {
    const auto y = sampled([&](double t) { return mean + amplitude * std::cos(omega * t + 2.9); }, interval, 1000);
    const auto phases = phase(y, interval, omega);
    ASSERT_EQ(phases.size(), y.size());
    for (std::size_t n = 0; n < y.size(); ++n)
      EXPECT_NEAR(phases[n], 2.9 + omega * interval * double(n), accuracy) << "sample " << n << ", mean " << mean;
  }
}

TEST(Phase, FollowsASlowModulation) {
  const double omega = 1, interval = 2 * half_turn / 50;
  const auto slow = [](double t) { return 3 * std::sin(0.02 * t); };  // in all 0.95 turns
  const auto phases = phase(sampled([&](double t) { return std::cos(t + slow(t)); }, interval, 5000), interval, omega);
  ASSERT_EQ(phases.size(), 5000u);
  for (std::size_t n = 25; n + 25 < phases.size(); ++n) {
    const double t = double(n) * interval;
    // If the frequency is off by δ, the means of cos² and sin² over the period differ by δ, and the phase is off by
    // δ/2. The curvature of the phase adds at most slow''·π²/2: together 0.03 + 0.006.
    EXPECT_NEAR(phases[n], t + slow(t), 0.036) << "t = " << t;
  }
}

TEST(Phase, OfAFaintSignalGoesOnWithItsFrequency) {
  const double omega = 3, interval = 0.05;
  const auto y =
      sampled([&](double t) { return t < 20 ? std::cos(omega * t) : 1e-4 * std::sin(17 * t * t); }, interval, 2000);
  const auto phases = phase(y, interval, omega);
  ASSERT_EQ(phases.size(), y.size());
  for (std::size_t n = 450; n + 1 < phases.size(); ++n)
    EXPECT_NEAR(phases[n + 1] - phases[n], omega * interval, 1e-9) << n;
}

TEST(Phase, NeedsAPeriodAndFourSamplesOfIt) {
  const auto y = sampled([](double t) { return std::cos(t); }, 0.1, 62);
  EXPECT_TRUE(phase(y, 0.1, 1).empty());  // 6.1 of a period of 6.28
  EXPECT_FALSE(phase(y, 0.1, 1.05).empty());
  EXPECT_TRUE(phase(y, 0.1, 2 * half_turn / 0.1 / 3.4).empty());  // 3.4 samples in a period
}

}  // namespace
