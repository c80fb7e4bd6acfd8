/// The volumetric stabilisation U(J) = (κ/8)(J − 1/J)² of the finite elements.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "continuum/balls.h"

namespace pseudorigid::testing {
namespace {

using continuum::StoredEnergy;
using continuum::Vector;

constexpr double kappa = 2.5;

TEST(Stabilisation, EnergyOfAnAffineChangeOfVolumeIsKnown) {
  const CompressibleBall ball(octant, 3, 0, StoredEnergy(neo_hookean, kappa));
  const Matrix3d F = diagonal(1.2, 1.1, 0.9);
  const double J = F.determinant(),
               volume = ball.space().mesh().sector().n_images() * ball.kernels().reference_volume();
  const auto sums = ball.integrals(ball.affine_field(F), ball.make_vector());
  EXPECT_NEAR(8 * sums.volumetric, volume * kappa / 8 * (J - 1 / J) * (J - 1 / J), 1e-13);
  EXPECT_NEAR(8 * sums.elastic, volume * 0.5 * (F.squaredNorm() - 3 - 2 * std::log(J)), 1e-13);
  const auto o = observed(ball, affine_state(ball, F, Matrix3d::Zero()));
  EXPECT_NEAR(o.elastic, 8 * (sums.elastic + sums.volumetric), 1e-13);
  EXPECT_NEAR(o.volumetric, 8 * sums.volumetric, 1e-13);
}

TEST(Stabilisation, ForceIsTheDerivativeOfTheEnergy) {
  for (const StoredEnergy& stored : {StoredEnergy(neo_hookean, kappa), StoredEnergy(materials::Fluid{}, kappa)}) {
    const CompressibleBall ball(whole, 2, 0, stored);
    Vector x = ball.affine_field(diagonal(1.1, 1, 0.95)), direction = ball.make_vector(), wave = direction;
    ball.fill_irregular(wave);
    x.add(0.01, wave);
    std::mt19937 generator(3);
    direction = random_field(direction, generator);
    Vector f = ball.make_vector();
    ASSERT_GT(ball.kernels().force(x, f), 0);
    const auto energy = [&](double s) {
      Vector moved = x;
      moved.add(s, direction);
      const auto sums = ball.integrals(moved, moved);
      return sums.elastic + sums.volumetric;
    };
    const double h = 1e-4;
    const double difference = (8 * (energy(h) - energy(-h)) - (energy(2 * h) - energy(-2 * h))) / (12 * h);
    EXPECT_NEAR(-(f * direction), difference, 1e-8 * std::abs(difference));
  }
}

/// What preserves volume exactly has neither its energy nor its force.
TEST(Stabilisation, IsNotThereWhereVolumeIsPreserved) {
  const ElasticBall with(octant, 4, 0, StoredEnergy(neo_hookean, kappa)), without(octant, 4, 0, neo_hookean);
  const Vector x = with.affine_field(diagonal(1.25, 0.8, 1));
  Vector f = with.make_vector(), g = f;
  with.kernels().force(x, f);
  without.kernels().force(x, g);
  g.add(-1, f);
  EXPECT_LT(g.linfty_norm(), 1e-13);
  EXPECT_LT(std::abs(with.integrals(x, x).volumetric), 1e-15);
}

}  // namespace
}  // namespace pseudorigid::testing
