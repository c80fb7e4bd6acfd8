/// A gravitating fluid ball: W = 0, held by its own gravity and the volumetric stabilisation.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "analysis/frequency.h"
#include "continuum/balls.h"

namespace pseudorigid::testing {
namespace {

using continuum::BallMesh;
using continuum::StoredEnergy;

/// Kelvin's oscillation of degree 2, ω² = (16/15)πGρ, as half the difference of two motions from x = X with ẋ = ±εHX:
/// the ball at rest is none of the finite elements, whose slow flow cancels. Twelve points in a direction of a face, as
/// that flow and the frequency are those of the error of gravity's quadrature.
TEST(Fluid, PulsatesWithKelvinsFrequency) {
  constexpr double G = 1, epsilon = 1e-3, interval = 0.05;
  constexpr long n_samples = 300;
  loads::Loads loads;
  loads.get<loads::SelfGravity>().constant = G;
  const ElasticBall ball(BallMesh(octant, 0), 4, StoredEnergy(materials::Fluid{}, 2), loads, 12);
  std::vector<double> values(n_samples + 1, 0.0);
  for (const double sign : {1.0, -1.0}) {
    const auto start = affine_state(ball, Matrix3d::Identity(), sign * epsilon * diagonal(1, 1, -2));
    const auto r = run<mechanics::Rattle4>(ball, start, n_samples * interval, n_samples, 2);
    ASSERT_TRUE(r.finished()) << r.result.reason;
    for (std::size_t k = 0; k < r.states.size(); ++k)
      values[k] += sign * ball.mass_moment(r.states[k].q)(0, 0) / (2 * epsilon);
  }
  const auto fit = analysis::fit_frequency(values, interval);
  ASSERT_TRUE(fit) << fit.reason;
  EXPECT_NEAR(fit.dominant().frequency / std::sqrt(16 * std::numbers::pi * G / 15), 1, 1e-5);
}

}  // namespace
}  // namespace pseudorigid::testing
