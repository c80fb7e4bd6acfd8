/// The example of docs/adding_a_law.md: derivatives, symmetries, moduli, lanes, oscillations of the pseudo-rigid ball.

#include "examples/yeoh.h"

#include <gtest/gtest.h>

#include <numbers>

#include "materials/law_checks.h"
#include "reduced/turning_point.h"

namespace pseudorigid::testing {

using materials::Yeoh;
using YeohBall = reduced::PseudoRigidBody<Yeoh, true>;

constexpr double mu = 1.3, lambda = 0.8, s = 0.4;
constexpr Yeoh law{mu, lambda, s};

TEST(Yeoh, StressAndTangentAreDerivativesOfTheEnergy) {
  expect_stress_is_the_derivative_of_the_energy(law);
  expect_tangent_is_the_derivative_of_the_stress(law);
}

TEST(Yeoh, IsObjectiveAndIsotropic) { expect_objective_and_isotropic(law); }

TEST(Yeoh, HasItsModuliAtRest) { expect_free_of_stress_at_rest_with_moduli(law, mu, lambda + 2 * s * mu); }

/// At a stretch by ℓ along one axis and 1/√ℓ across: d = ℓ² + 2/ℓ − 3.
TEST(Yeoh, EnergyIsThatOfItsDefinition) {
  for (const double l : {0.5, 0.9, 1.0, 1.2, 3.0}) {
    const double d = l * l + 2 / l - 3;
    const auto F = materials::to_tensor(diagonal(1 / std::sqrt(l), 1 / std::sqrt(l), l));
    EXPECT_NEAR(law.energy(F), mu / 2 * (d + s / 2 * d * d), 1e-14 * (1 + d * d));
  }
}

TEST(Yeoh, LanesAreNumbers) { expect_lanes_are_numbers(law); }

/// In units μ = ρ = r = 1, so κ = 5. The energy is a function of d that rises with d: a ball let go turns where its d
/// is that of the start, for every s: ℓ² + 2/ℓ is 5 at ℓ = 2 and at √2 − 1.
TEST(Yeoh, BallsTurnWhereNeoHookeanOnesDo) {
  const YeohBall ball({1, 0, s}, reduced::ReferenceBody::unit_ball());
  EXPECT_NEAR(turning_point(ball, 2, 1, 0.02).l, std::numbers::sqrt2 - 1, 1e-10);
}

/// With y = ln ℓ: d = 3y² + …, so V has (κ/4)s d² = (9/4)κs y⁴ beside the quadratic (3/2)κy², and ω/ω₀ gains (9/8)s A²
/// over the −(5/48)A² of the neo-Hookean ball (PHYSICS section 5). ω₀ = √10 does not depend on s.
TEST(Yeoh, FrequencyRisesWithTheAmplitude) {
  const YeohBall ball({1, 0, s}, reduced::ReferenceBody::unit_ball());
  EXPECT_NEAR(frequency_shift(ball, std::sqrt(10.0)), 9.0 / 8 * s - 5.0 / 48, 1e-4);  // terms of order A⁴ remain
}

}  // namespace pseudorigid::testing
