/// The method energy-momentum on the finite-element ball: energy, angular momentum and constraints to round-off with
/// long steps. Its order is tested in order_test.cpp.

#include <gtest/gtest.h>

#include "continuum/balls.h"

namespace pseudorigid::testing {
namespace {

using Method = mechanics::EnergyMomentum;

loads::Loads self_gravity(double G) {
  loads::Loads loads;
  loads.get<loads::SelfGravity>().constant = G;
  return loads;
}

/// A pulsation with a spin and a flight, as far as the sector admits them.
template <class Ball>
State<Ball> pulsating(const Ball& ball, const Sector& sector) {
  Matrix3d Qdot;
  Qdot << 0.2, -0.4, 0.1, 0.4, 0.1, -0.2, -0.1, 0.2, -0.3;
  Vector3d flight(0.7, -0.2, 0.4);
  for (int c = 0; c < 3; ++c)
    if (sector.reflect[c]) flight[c] = 0;
  return {0, ball.affine_field(Matrix3d::Identity()), ball.affine_field(admissible(sector, Qdot), flight)};
}

template <class Ball>
void keeps_energy_and_momentum(const Ball& ball, const Sector& sector, double step) {
  const auto start = pulsating(ball, sector);
  const auto first = observed(ball, start);
  const auto r = run<Method>(ball, start, 3, 6, std::lround(0.5 / step));
  ASSERT_TRUE(r.finished()) << r.result.reason;
  for (const auto& state : r.states) {
    const auto o = observed(ball, state);
    EXPECT_NEAR(o.energy(), first.energy(), 2e-13 * first.kinetic);
    EXPECT_LT((o.angular_momentum - first.angular_momentum).norm(), 1e-13);
    EXPECT_LT((o.velocity - first.velocity).norm(), 1e-13);
  }
  // The motion is not that of a rigid body or of an affine one.
  const auto last = observed(ball, r.last());
  EXPECT_GT(std::abs(last.elastic - first.elastic), 1e-3 * first.kinetic);
  EXPECT_GT(last.nonaffine_displacement, 1e-4);
}

TEST(EnergyMomentumBall, IncompressibleBallsKeepEnergyAndMomentum) {
  for (const Sector& sector : all_sectors) {
    const ElasticBall ball(sector, sector.n_images() == 1 ? 2 : 3, 0, neo_hookean);
    keeps_energy_and_momentum(ball, sector, 0.0125);
  }
}

TEST(EnergyMomentumBall, CompressibleBallsKeepEnergyAndMomentum) {
  for (const Sector& sector : {octant, half}) {
    const CompressibleBall ball(sector, 3, 0, ciarlet_geymonat);
    keeps_energy_and_momentum(ball, sector, 0.01);
  }
}

TEST(EnergyMomentumBall, GravitatingBallsKeepEnergyAndMomentum) {
  const ElasticBall ball(half, 2, 0, {neo_hookean, 3}, self_gravity(1.2));
  keeps_energy_and_momentum(ball, half, 0.02);
}

TEST(EnergyMomentumBall, KeepsTheConstraint) {
  const ElasticBall ball(octant, 4, 0, neo_hookean);
  const auto r = run<Method>(ball, pulsating(ball, octant), 1, 4, 50);
  ASSERT_TRUE(r.finished()) << r.result.reason;
  continuum::Vector g = ball.make_multiplier(), rate = g;
  for (const auto& state : r.states) {
    ASSERT_TRUE(ball.constraint(state.q, g));
    ball.constraint_rate(state.q, state.v, rate);
    EXPECT_LT(g.linfty_norm(), 1e-12 * ball.multiplier_scale());
    EXPECT_LT(rate.linfty_norm(), 1e-11 * ball.multiplier_scale());
  }
}

TEST(EnergyMomentumBall, ForceIsMinusTheDerivativeOfThePotentialEnergy) {
  loads::Loads loads = self_gravity(0.8);
  loads.get<loads::Tide>().tensor[2][2] = -0.2;
  loads.get<loads::Traction>().nominal_stress[2][2] = 0.3;
  loads.get<loads::Pressure>().pressure = 0.4;
  for (const Sector& sector : {whole, half}) {
    std::mt19937 generator(5);
    const CompressibleBall ball(sector, 3, 0, ciarlet_geymonat, loads);
    continuum::Vector u = random_field(ball.make_vector(), generator), f = u;
    ball.apply_inverse_mass(u, u);  // 0 at the components that the planes fix
    u *= 0.02 / u.linfty_norm();
    continuum::Vector x = ball.affine_field(diagonal(1.1, 0.95, 1.02));
    x += u;
    auto workspace = ball.make_workspace();
    ASSERT_TRUE(ball.force(0, x, ball.make_vector(), workspace, f));
    const double h = 1e-3;
    const auto V = [&](double s) {
      continuum::Vector moved = x;
      moved.add(s, u);
      return ball.potential_energy(moved);
    };
    const double slope = (8 * (V(h) - V(-h)) - (V(2 * h) - V(-2 * h))) / (12 * h);
    EXPECT_GT(std::abs(slope), 1e-3);
    EXPECT_NEAR(slope, -(f * u), 1e-8 * std::abs(slope));
  }
}

/// The potential energy of the body is that of the tables, divided by the number of images of the sector.
TEST(EnergyMomentumBall, EnergiesOfTheSectorAreAPartOfTheWhole) {
  loads::Loads loads = self_gravity(0.8);
  loads.get<loads::Tide>().tensor[2][2] = -0.2;
  for (const Sector& sector : all_sectors) {
    const ElasticBall ball(sector, 3, 0, {neo_hookean, 3}, loads);
    const auto state = affine_state(ball, diagonal(1.1, 0.95, 1 / (1.1 * 0.95)), diagonal(0.1, 0.2, -0.3));
    const Eigen::Vector2d whole_ball = continuum::energies(ball, state);
    const int n_images = sector.n_images();
    EXPECT_NEAR(n_images * ball.kinetic_energy(state.v), whole_ball[0], 1e-13 * whole_ball[0]);
    EXPECT_NEAR(n_images * ball.potential_energy(state.q), whole_ball[1], 1e-12);
  }
}

}  // namespace
}  // namespace pseudorigid::testing
