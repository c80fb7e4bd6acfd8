/// Self-gravity of the finite-element ball: what it is for affine motions, that it is a derivative, and that it neither
/// pushes nor turns.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numeric>

#include "analysis/frequency.h"
#include "analysis/sphere_frequencies.h"
#include "continuum/balls.h"
#include "gravity/ellipsoid_gravity.h"
#include "support/order_fit.h"

namespace pseudorigid::testing {
namespace {

using analysis::sphere_frequency;
using continuum::Vector;

const Matrix3d ellipsoid = (Vector3d(1.3, 1.1, 0.7) / std::cbrt(1.3 * 1.1 * 0.7)).asDiagonal();

ElasticBall gravitating_ball(const Sector& sector, int degree, int n_refinements, double G = 0.7) {
  loads::Loads loads;
  loads.get<loads::SelfGravity>().constant = G;
  return {sector, degree, n_refinements, neo_hookean, loads};
}

Vector force_of_gravity(const ElasticBall& ball, const Vector& x) {
  Vector f = ball.make_vector();
  EXPECT_TRUE(ball.gravity()->add(x, f));
  return f;
}

/// A plane of symmetry holds its own component.
void hold_planes(const ElasticBall& ball, Vector& u) {
  for (unsigned int i = 0; i < u.locally_owned_size(); ++i)
    if (ball.space().inverse_mass().local_element(i) == 0) u.local_element(i) = 0;
}

/// Σ f_n ⊗ x_n of the whole ball.
Matrix3d moment(const ElasticBall& ball, const Vector& f, const Vector& x) {
  Matrix3d sum = Matrix3d::Zero();
  for (unsigned int i = 0; i < x.locally_owned_size(); i += 3)
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) sum(r, c) += f.local_element(i + r) * x.local_element(i + c);
  return ball.whole_ball(sum);
}

Matrix3d traceless(const Matrix3d& A) { return A - A.trace() / 3 * Matrix3d::Identity(); }

/// Of the force on affine fields, relative to the closed form for the ellipsoid; both without a dilation.
double affine_error(int degree, int n_refinements) {
  const double G = 0.7;
  const ElasticBall ball = gravitating_ball(octant, degree, n_refinements, G);
  const Vector x = ball.affine_field(ellipsoid);
  const Matrix3d of_elements = moment(ball, force_of_gravity(ball, x), x);
  EXPECT_NEAR(of_elements.trace(), 0, 1e-12);
  const double mass = 4 * M_PI / 3;  // the mass of the ball; the points have its volume to the error that is asked for
  const gravity::EllipsoidGravity exact{0.6 * G * mass * mass};
  const Matrix3d expected = -traceless(exact.gradient(ellipsoid) * ellipsoid.transpose());
  return (traceless(of_elements) - expected).norm() / expected.norm();
}

TEST(ContinuumGravity, OnAffineMotionsIsThatOfTheEllipsoid) {
  EXPECT_LE(affine_error(4, 0), 1e-5);
  EXPECT_LE(affine_error(4, 1), 1e-6);
  EXPECT_LE(affine_error(6, 1), 1e-7);
}

TEST(ContinuumGravity, ConvergesWithOrderFourAndMore) {
  std::vector<ErrorPoint> errors;
  for (const int n_refinements : {0, 1, 2})
    errors.push_back({std::ldexp(1.0, -n_refinements), affine_error(3, n_refinements)});
  EXPECT_GE(fit_order(errors).order, 4) << errors[0].error << " " << errors[1].error << " " << errors[2].error;
}

/// Not affine, so that the surface is no ellipsoid.
Vector bent(const ElasticBall& ball) {
  Vector x = ball.affine_field(ellipsoid), wave = ball.make_vector();
  ball.fill_irregular(wave);
  x.add(0.01, wave);
  return x;
}

TEST(ContinuumGravity, IsTheDerivativeOfItsEnergy) {
  for (const Sector& sector : {quarter, whole}) {
    const ElasticBall ball = gravitating_ball(sector, 3, 0);
    const Vector x = bent(ball);
    Vector direction = ball.make_vector();
    ball.fill_irregular(direction);
    hold_planes(ball, direction);
    const auto energy = [&](double s) {
      Vector moved = x;
      moved.add(s, direction);
      return ball.gravity()->energy(moved);
    };
    const double h = 1e-4;
    const double difference = (8 * (energy(h) - energy(-h)) - (energy(2 * h) - energy(-2 * h))) / (12 * h);
    const double expected = -(force_of_gravity(ball, x) * direction);
    EXPECT_NEAR(difference, expected, 1e-9 * std::abs(expected) + 1e-10);
  }
}

/// The octant with the signs of a parity is the whole ball in a field of that parity.
TEST(ContinuumGravity, RateOfTheForceIsThatOfTheWholeBall) {
  const ElasticBall part = gravitating_ball(octant, 2, 0), all = gravitating_ball(whole, 2, 0);
  const Vector x = part.affine_field(ellipsoid), x_all = all.affine_field(ellipsoid);
  const Vector &X = part.space().reference_positions(), &X_all = all.space().reference_positions();
  for (const std::array<int, 3>& s : {std::array{1, 1, 1}, std::array{1, -1, 1}, std::array{-1, 1, -1}}) {
    // u_c is even or odd in x_j as the parity has it: u(R_j X) = s_j R_j u(X).
    const auto field = [&](const Vector& at, Vector u) {
      for (unsigned int i = 0; i < u.locally_owned_size(); ++i) {
        const unsigned int node = i - i % 3, component = i % 3;
        double value = std::cos(1.0 + component) + at.local_element(node) * at.local_element(node);
        for (unsigned int j = 0; j < 3; ++j)
          if ((j == component) == (s[j] > 0)) value *= std::sin(at.local_element(node + j));
        u.local_element(i) = value;
      }
      return u;
    };
    Vector rate = part.make_vector();
    part.gravity()->add_rate(x, field(X, part.make_vector()), s, rate);
    std::vector<unsigned int> entries(X.locally_owned_size());
    std::iota(entries.begin(), entries.end(), 0U);
    const Vector displacement = field(X, part.make_vector());
    const Eigen::Map<const Eigen::VectorXd> u_of_part(displacement.begin(), X.locally_owned_size()),
        rate_of_part(rate.begin(), X.locally_owned_size());
    EXPECT_LT((part.gravity()->hessian(x, s, entries) * u_of_part + rate_of_part).lpNorm<Eigen::Infinity>(),
              1e-13 * rate.linfty_norm());
    const Vector u = field(X_all, all.make_vector());
    const auto force = [&](double h) {
      Vector moved = x_all;
      moved.add(h, u);
      return force_of_gravity(all, moved);
    };
    const double h = 1e-3;
    Vector difference = force(h);
    difference.sadd(8, -8, force(-h));
    difference.add(-1, force(2 * h), 1, force(-2 * h));
    difference *= 1 / (12 * h);
    double largest = 0;
    for (unsigned int node = 0; node < X.locally_owned_size(); node += 3)
      for (unsigned int other = 0; other < X_all.locally_owned_size(); other += 3) {
        double distance = 0, least = 1;
        for (unsigned int c = 0; c < 3; ++c) {
          distance += std::abs(X.local_element(node + c) - X_all.local_element(other + c));
          least = std::min(least, X.local_element(node + c));
        }
        if (distance > 1e-12 || least < 1e-12) continue;  // on a plane the octant has a part of the force
        for (unsigned int c = 0; c < 3; ++c) {
          EXPECT_NEAR(rate.local_element(node + c), difference.local_element(other + c), 1e-9);
          largest = std::max(largest, std::abs(rate.local_element(node + c)));
        }
      }
    EXPECT_GT(largest, 1e-3);
  }
}

TEST(ContinuumGravity, NeitherPushesNorTurnsTheBall) {
  const ElasticBall ball = gravitating_ball(whole, 3, 0);
  const Vector x = bent(ball), f = force_of_gravity(ball, x);
  Vector3d force = Vector3d::Zero();
  for (unsigned int i = 0; i < f.locally_owned_size(); i += 3)
    for (int c = 0; c < 3; ++c) force[c] += f.local_element(i + c);
  const Matrix3d M = moment(ball, f, x);
  EXPECT_LT(force.norm(), 1e-14 * f.l1_norm());
  EXPECT_LT((M - M.transpose()).norm(), 1e-14 * f.l1_norm());
}

/// A ball at rest has neither force nor multiplier: its weight is in the pressure, which is known.
TEST(ContinuumGravity, BallAtRestStaysAtRest) {
  const ElasticBall ball = gravitating_ball(octant, 4, 0);
  Vector f = force_of_gravity(ball, ball.affine_field(Matrix3d::Identity()));
  hold_planes(ball, f);
  EXPECT_LT(f.linfty_norm(), 1e-6);
}

/// As in lamb_test.cpp: release from x = X with ẋ = ±εHX, half the difference of the two.
TEST(ContinuumGravity, FrequencyIsThatOfTheGravitatingSphere) {
  constexpr double epsilon = 1e-4, interval = 0.05;
  constexpr long n_samples = 400;
  for (const double gamma : {1.0, 5.0}) {
    const ElasticBall ball = gravitating_ball(octant, 4, 0, 3 * gamma / (4 * M_PI));
    std::vector<double> values(n_samples + 1, 0.0);
    for (const double sign : {1.0, -1.0}) {
      const auto start = affine_state(ball, Matrix3d::Identity(), sign * epsilon * diagonal(1, 1, -2));
      const auto r = run<mechanics::Rattle4>(ball, start, n_samples * interval, n_samples, 3);
      ASSERT_TRUE(r.finished()) << r.result.reason;
      for (std::size_t k = 0; k < r.states.size(); ++k)
        values[k] += sign * ball.mass_moment(r.states[k].q)(0, 0) / (2 * epsilon);
    }
    const auto fit = analysis::fit_frequency(values, interval);
    ASSERT_TRUE(fit) << fit.reason;
    EXPECT_NEAR(fit.dominant().frequency / sphere_frequency(true, 2, 0, gamma), 1, 4e-6)
        << gamma;  // as without gravity
  }
}

}  // namespace
}  // namespace pseudorigid::testing
