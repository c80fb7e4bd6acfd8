/// Self-gravity of the finite-element ball: what it is for affine motions, that it is a derivative, and that it neither
/// pushes nor turns.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "analysis/frequency.h"
#include "analysis/order_fit.h"
#include "continuum/balls.h"
#include "continuum/lamb_modes.h"
#include "reduced/self_gravity.h"

namespace pseudorigid::testing {
namespace {

using continuum::Vector;

const Matrix3d ellipsoid = (Vector3d(1.3, 1.1, 0.7) / std::cbrt(1.3 * 1.1 * 0.7)).asDiagonal();

ElasticBall gravitating_ball(const Sector& sector, int degree, int n_refinements, double G = 0.7) {
  loads::Loads loads;
  loads.get<loads::SelfGravity>().constant = G;
  return {sector, degree, n_refinements, neo_hookean, loads};
}

Vector force_of_gravity(const ElasticBall& ball, const Vector& x) {
  Vector f = ball.make_vector();
  ball.gravity()->add(x, f);
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
  const reduced::SelfGravity exact{0.6 * G * mass * mass};
  const Matrix3d expected = -traceless(exact.gradient(ellipsoid) * ellipsoid.transpose());
  return (traceless(of_elements) - expected).norm() / expected.norm();
}

TEST(ContinuumGravity, OnAffineMotionsIsThatOfTheEllipsoid) {
  EXPECT_LE(affine_error(4, 0), 1e-5);
  EXPECT_LE(affine_error(4, 1), 1e-6);
  EXPECT_LE(affine_error(6, 1), 1e-7);
}

TEST(ContinuumGravity, ConvergesWithOrderFourAndMore) {
  std::vector<analysis::ErrorPoint> errors;
  for (const int n_refinements : {0, 1, 2})
    errors.push_back({std::ldexp(1.0, -n_refinements), affine_error(3, n_refinements)});
  EXPECT_GE(analysis::fit_order(errors).order, 4)
      << errors[0].error << " " << errors[1].error << " " << errors[2].error;
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

/// Spheroidal modes n = 2 of the gravitating elastic sphere (PHYSICS 3), γ = ρgr/μ with g = (4/3)πGρr: determinant of
///   −x² + 4 + 4γ/5    6[2(xj₂' − j₂) + 2γj₂/5]
///   2                 (10 − x²)j₂ − 2xj₂'
double determinant(double gamma, double x) {
  const double j = bessel_2(x), dj = bessel_2_derivative(x);
  return (4 - x * x + 0.8 * gamma) * ((10 - x * x) * j - 2 * x * dj) - 12 * (2 * (x * dj - j) + 0.4 * gamma * j);
}

/// Its only root in the interval.
double exact_frequency(double gamma, double low, double high) {
  const bool rises = determinant(gamma, high) > 0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    ((determinant(gamma, middle) > 0) == rises ? high : low) = middle;
  }
  return low;
}

/// As in lamb_test.cpp: release from x = X with ẋ = ±εHX, half the difference of the two.
TEST(ContinuumGravity, FrequencyIsThatOfTheGravitatingSphere) {
  EXPECT_NEAR(exact_frequency(0, 2, 3.5), 2.665622189236, 1e-11);
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
    EXPECT_NEAR(fit.dominant().frequency / exact_frequency(gamma, 2, 3.9), 1, 4e-6) << gamma;  // as without gravity
  }
}

}  // namespace
}  // namespace pseudorigid::testing
