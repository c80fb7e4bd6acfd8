/// The follower pressure on the finite-element ball, at states that are not affine (those that are: loads_test.cpp).

#include <gtest/gtest.h>

#include <vector>

#include "continuum/balls.h"
#include "support/differences.h"

namespace pseudorigid::testing {
namespace {

using continuum::Vector;

/// A compressible ball that is not affine, under a pressure and without.
struct PressedBall : ::testing::Test {
  static constexpr double p = 0.4;
  const CompressibleBall ball{whole, 3, 0, neo_hookean, {loads::Pressure{p}}}, free{whole, 3, 0, neo_hookean};

  Vector irregular(double size, int seed) const {
    std::mt19937 generator(seed);
    Vector x = random_field(ball.space().reference_positions(), generator);
    x *= size;
    return x;
  }
  Vector force_of_pressure(const Vector& x) const {
    CompressibleBall::Workspace workspace;
    Vector f = ball.make_vector(), without = f;
    EXPECT_TRUE(ball.force(0, x, x, workspace, f));
    EXPECT_TRUE(free.force(0, x, x, workspace, without));
    f -= without;
    return f;
  }
};

TEST_F(PressedBall, FeelsMinusTheGradientOfPressureTimesVolume) {
  Vector x = ball.affine_field(Matrix3d::Identity());
  x += irregular(0.02, 1);
  const Vector direction = irregular(1, 2), f = force_of_pressure(x);
  const double h = 0.005;
  const double by_difference = first_difference(
      [&](int k) {
        Vector moved = x;
        moved.add(k * h, direction);
        return p * ball.integrals(moved, moved).volume;
      },
      h);
  EXPECT_NEAR(-(f * direction), by_difference, 1e-11 * (1 + std::abs(by_difference)));
  EXPECT_GT(std::abs(by_difference), 1e-3);
  const auto o = observed(ball, {0, x, ball.make_vector()}, {{.multiplier = false}});
  EXPECT_NEAR(o.external, p * ball.volume() * o.volume_ratio, 1e-13);
}

TEST_F(PressedBall, IsNeitherPushedNorTurned) {
  Vector x = ball.affine_field(Matrix3d::Identity() + 0.1 * Matrix3d::Ones());
  x += irregular(0.02, 3);
  const Vector f = force_of_pressure(x);
  Vector3d sum = Vector3d::Zero(), torque = sum;
  double size = 0;
  for (unsigned int i = 0; i < f.locally_owned_size(); i += 3) {
    const Vector3d f_n(f.local_element(i), f.local_element(i + 1), f.local_element(i + 2)),
        x_n(x.local_element(i), x.local_element(i + 1), x.local_element(i + 2));
    sum += f_n;
    torque += x_n.cross(f_n);
    size += f_n.norm();
  }
  EXPECT_LT(sum.norm() + torque.norm(), 1e-14 * size);
}

/// W = (μ/2)(3a² − 3 − 6 ln a) at F = a Id: the ball rests at μ(a − 1/a) + p a² = 0, whatever the mesh.
TEST_F(PressedBall, RestsWhereItsLawCarriesThePressure) {
  double a = 1;
  for (int i = 0; i < 50; ++i) a -= (a - 1 / a + p * a * a) / (1 + 1 / (a * a) + 2 * p * a);
  ASSERT_LT(a, 0.9);
  CompressibleBall::Workspace workspace;
  for (const int degree : {1, 4}) {
    const CompressibleBall pressed(octant, degree, 0, neo_hookean, {loads::Pressure{p}});
    Vector f = pressed.make_vector();
    const Vector x = pressed.affine_field(a * Matrix3d::Identity());
    ASSERT_TRUE(pressed.force(0, x, x, workspace, f));
    EXPECT_LT(f.linfty_norm(), 1e-14);
  }
}

TEST(IncompressibleBall, FeelsNoPressure) {
  const ElasticBall pressed(octant, 3, 0, neo_hookean, {loads::Pressure{0.4}}), free(octant, 3, 0, neo_hookean);
  std::mt19937 generator(4);
  Vector x = random_field(free.space().reference_positions(), generator);
  x *= 0.02;
  x += free.affine_field(Matrix3d::Identity());
  auto workspace = free.make_workspace();
  Vector f = free.make_vector(), g = f;
  ASSERT_TRUE(pressed.force(0, x, x, workspace, f));
  ASSERT_TRUE(free.force(0, x, x, workspace, g));
  f -= g;
  EXPECT_EQ(f.linfty_norm(), 0);
}

}  // namespace
}  // namespace pseudorigid::testing
