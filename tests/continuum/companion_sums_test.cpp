/// The full potential of companions on the finite-element ball: a ball at rest attracts as a point, forces are
/// derivatives of the energy, far companions act by degree 2, and sectors are parts of the whole.

#include <gtest/gtest.h>

#include "continuum/balls.h"
#include "continuum/body/companion_sums.h"
#include "support/differences.h"
#include "support/order_fit.h"

namespace pseudorigid::testing {
namespace {

using continuum::CompanionSums;
using continuum::Vector;
using mechanics::Orbit;

constexpr double G = 0.3;

mechanics::Companions two_companions(const Vector3d& first, const Vector3d& second) {
  mechanics::Companions companions{{.mass = 2, .position = first, .velocity = Vector3d::Zero()},
                                   {.mass = 0.7, .position = second, .velocity = Vector3d::Zero()}};
  companions.full_potential = true;
  return companions;
}
const Vector3d first(1.5, 0.4, 0.3), second(-0.5, 2, 0.8);

CompanionSums sums_of(const ElasticBall& ball, const Orbit& orbit, const Vector& x) {
  return continuum::companion_sums(orbit, ball.space(), x, ball.mean(x), orbit.relative(orbit.position()));
}
Matrix3d generic_map() { return (Matrix3d() << 1.1, 0.2, -0.1, 0.1, 0.9, 0.15, -0.2, 0.1, 1).finished(); }

/// Newton: the potential of a homogeneous ball outside is that of a point. The companions are 1.6 and 2.2 radii away.
TEST(CompanionSums, OfABallTendToThoseOfAPoint) {
  std::vector<double> errors, torques;
  for (const int degree : {2, 4, 6}) {
    const ElasticBall ball(whole, degree, 1, neo_hookean);
    const Orbit orbit(two_companions(first, second), G, ball.mass());
    const CompanionSums sums = sums_of(ball, orbit, ball.affine_field(Matrix3d::Identity()));
    const double expected = -G * ball.mass() * (2 / first.norm() + 0.7 / second.norm());
    errors.push_back(std::abs(sums.energy / expected - 1));
    torques.push_back(sums.torque.norm());
  }
  for (const auto& falling : {errors, torques}) {
    EXPECT_LT(falling[1], falling[0] / 5);
    EXPECT_LT(falling[2], falling[1] / 5);
    EXPECT_LT(falling[2], 1e-8);
  }
}

TEST(CompanionSums, ForcesAreDerivativesOfTheEnergy) {
  std::mt19937 generator(4);
  const ElasticBall ball(whole, 3, 0, neo_hookean);
  const Orbit orbit(two_companions(first, second), G, ball.mass());
  const Orbit::Columns r = orbit.relative(orbit.position());
  Vector x = ball.affine_field(generic_map(), {0.1, -0.2, 0.05});
  x.add(0.02, random_field(x, generator));
  const Vector u = random_field(x, generator);
  const CompanionSums sums = sums_of(ball, orbit, x);
  Vector f = ball.make_vector();
  continuum::add_companion_forces(orbit, ball.space(), x, ball.mean(x), r, sums, ball.mass(), f);
  const double slope = first_difference(
      [&](int k) {
        Vector there = x;
        there.add(1e-2 * k, u);
        return sums_of(ball, orbit, there).energy;
      },
      1e-2);
  EXPECT_NEAR(f * u, -slope, 1e-9 * std::abs(slope));
  for (int i = 0; i < 2; ++i)
    for (int c = 0; c < 3; ++c) {
      const double by_r = first_difference(
          [&](int k) {
            Orbit::Columns moved = r;
            moved(c, i) += 1e-2 * k;
            return continuum::companion_sums(orbit, ball.space(), x, ball.mean(x), moved).energy;
          },
          1e-2);
      EXPECT_NEAR(sums.on_companions(c, i), -by_r, 1e-9);
    }
  const Eigen::Vector3d on_orbit =
      r.col(0).cross(sums.on_companions.col(0)) + r.col(1).cross(sums.on_companions.col(1));
  EXPECT_LT((sums.torque + on_orbit).norm(), 1e-13);
  Vector a = ball.make_vector();
  ball.apply_inverse_mass(f, a);
  EXPECT_LT(ball.mean(a).norm(), 1e-14) << "the forces have no resultant";
}

/// An affine body has no moment of degree 3, so the difference to degree 2 is of degree 4: the energy falls as d⁻⁵.
TEST(CompanionSums, OfFarCompanionsAreOfDegreeTwo) {
  const ElasticBall ball(whole, 4, 0, neo_hookean);
  const Vector x = ball.affine_field(generic_map());
  std::vector<ErrorPoint> of_energy, of_force;
  for (const double d : {4, 8, 16, 32}) {
    const Orbit orbit(two_companions(d * first, d * second), G, ball.mass());
    const Orbit::Columns r = orbit.relative(orbit.position());
    const CompanionSums sums = sums_of(ball, orbit, x);
    const Eigen::Matrix3d S = ball.second_moment(x);
    const double expected = orbit.energy(S, orbit.position()) - orbit.energy_of_companions(r);
    of_energy.push_back({1 / d, std::abs(sums.energy - expected)});
    of_force.push_back(
        {1 / d, (orbit.force_on_coordinates(r, sums.on_companions) - orbit.force(S, orbit.position())).norm()});
  }
  EXPECT_NEAR(fit_order(of_energy).order, 5, 0.1);
  EXPECT_NEAR(fit_order(of_force).order, 6, 0.15);
}

TEST(CompanionSums, OfASectorAreThoseOfTheWholeBall) {
  const Vector3d in_plane(1.5, 0.4, 0), other(-0.5, 2, 0);
  const Matrix3d Q = admissible(half, generic_map());
  const ElasticBall ball(whole, 3, 0, neo_hookean), part(half, 3, 0, neo_hookean);
  const Orbit orbit(two_companions(in_plane, other), G, ball.mass());
  const CompanionSums expected = sums_of(ball, orbit, ball.affine_field(Q)),
                      found = sums_of(part, orbit, part.affine_field(Q));
  EXPECT_NEAR(found.energy, expected.energy, 1e-13);
  EXPECT_LT((found.on_companions - expected.on_companions).norm(), 1e-13);
  EXPECT_LT((found.torque - expected.torque).norm(), 1e-13);
}

}  // namespace
}  // namespace pseudorigid::testing
