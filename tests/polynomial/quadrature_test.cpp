/// The estimate of the error of Q by the quadrature (polynomial/quadrature_error.h) against the motion of the same body
/// with four points more in each direction: it holds the error, and is not a hundred times it. Points that follow a
/// tolerance meet it.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "polynomial/motions.h"
#include "polynomial/quadrature_error.h"

namespace pseudorigid::testing {
namespace {

using polynomial::QuadratureChoice;

Matrix3d released(double a) { return Vector3d(-a / 2, -a / 2, a).array().exp().matrix().asDiagonal(); }

/// The largest difference of Q from the body with more points, in a motion from x = Q₀X, ẋ = Q̇₀X until T with the same
/// steps, whose errors are far below.
template <class Body>
double error_of(const BodySetup& setup, const Matrix3d& Q, const Matrix3d& Qdot, double T) {
  const auto motion = [&](const Body& body) {
    const auto r = run<mechanics::Symmetric8>(body, {0, body.affine(Q), body.affine(Qdot)}, T, std::lround(8 * T),
                                              setup.degree < 5 ? 6 : 12);
    EXPECT_TRUE(r.finished()) << r.result.reason;
    return r.states;
  };
  BodySetup fine = setup;
  fine.n_points = setup.n_points.value_or(polynomial::PolynomialSpace::least_points(setup.degree)) + 4;
  fine.n_gravity_points = 2 * polynomial::BodyGravity::usual_points(setup.degree);
  const Body body(setup);
  const auto states = motion(body), exact = motion(Body(fine));
  double found = 0;
  for (std::size_t i = 0; i < states.size(); ++i)
    found = std::max(found, (body.space().affine_part(states[i].q) - body.space().affine_part(exact[i].q))
                                .template lpNorm<Eigen::Infinity>());
  return found;
}

template <class Body>
QuadratureChoice choice(const BodySetup& setup, const Matrix3d& Q, const Matrix3d& Qdot,
                        const polynomial::QuadratureRequest& request) {
  const Body body(setup);
  return polynomial::choose_quadrature(setup, body, {0, body.affine(Q), body.affine(Qdot)}, request);
}

template <class Body>
void expect_estimate(const char* name, const BodySetup& setup, const Matrix3d& Q, const Matrix3d& Qdot, double T) {
  const QuadratureChoice found = choice<Body>(setup, Q, Qdot, {.end = T});
  ASSERT_TRUE(found.error) << name << ": " << found.reason;
  EXPECT_EQ(found.n_points, setup.n_points.value_or(polynomial::PolynomialSpace::least_points(setup.degree))) << name;
  const double error = error_of<Body>(setup, Q, Qdot, T);
  EXPECT_GT(error, 1e-12) << name;
  EXPECT_GT(*found.error, error) << name;
  EXPECT_LT(*found.error, 100 * error) << name;
}

TEST(QuadratureError, HoldsThatOfTheMotion) {
  const Matrix3d Id = Matrix3d::Identity(), none = Matrix3d::Zero();
  Matrix3d shear;
  shear << 0.1, -0.4, 0.05, 0.3, -0.15, 0.1, 0, -0.05, 0.05;
  BodySetup gravitating{.degree = 3, .reflect = all_planes};
  gravitating.loads.get<loads::SelfGravity>().constant = 5 * 3 / (4 * std::numbers::pi);
  const BodySetup of_3{.degree = 3, .reflect = all_planes}, of_5{.degree = 5, .reflect = all_planes};
  expect_estimate<IncompressibleBody>("N = 3, a = 0.03", of_3, released(0.03), none, 5);
  expect_estimate<IncompressibleBody>("N = 3, a = 0.3", of_3, released(0.3), none, 40);
  expect_estimate<IncompressibleBody>("N = 3, one point more", {.degree = 3, .reflect = all_planes, .n_points = 4},
                                      released(0.1), none, 10);
  expect_estimate<IncompressibleBody>("N = 5, a = 0.1", of_5, released(0.1), none, 20);
  expect_estimate<IncompressibleBody>("N = 5, thrown", of_5, Id, released(0.4) - Id, 10);
  expect_estimate<IncompressibleBody>("N = 3, sheared and turning", {.degree = 3}, Id, shear, 5);
  expect_estimate<IncompressibleBody>("N = 3, gravity", gravitating, released(0.2), none, 20);
  expect_estimate<CompressibleBody>("compressible",
                                    {.degree = 3, .reflect = all_planes, .law = materials::CiarletGeymonat{1, 2}},
                                    released(0.2), none, 10);
}

TEST(QuadratureError, IsMetByPointsThatFollowATolerance) {
  for (const int degree : {3, 5}) {
    BodySetup setup{.degree = degree, .reflect = all_planes};
    const QuadratureChoice found = choice<IncompressibleBody>(setup, released(0.1), Matrix3d::Zero(),
                                                              {.end = 10, .tolerance = 1e-9, .adds_points = true});
    EXPECT_GT(found.n_points, polynomial::PolynomialSpace::least_points(degree));
    EXPECT_LE(found.error.value_or(1), 0.5e-9);
    setup.n_points = found.n_points;
    EXPECT_LT(error_of<IncompressibleBody>(setup, released(0.1), Matrix3d::Zero(), 10), 1e-9);
  }
}

/// Nothing of an affine motion depends on the rule.
TEST(QuadratureError, IsNothingForAnAffineMotion) {
  const BodySetup setup{.degree = 1, .reflect = all_planes};
  const QuadratureChoice found =
      choice<IncompressibleBody>(setup, released(0.3), Matrix3d::Zero(), {.end = 5, .adds_points = true});
  EXPECT_EQ(found.error.value_or(1), 0);
  EXPECT_EQ(found.n_force, 0);
  EXPECT_LT(error_of<IncompressibleBody>(setup, released(0.3), Matrix3d::Zero(), 5), 1e-12);
}

/// A motion that turns the body inside out at once.
TEST(QuadratureError, IsNotKnownIfThePilotsFail) {
  const QuadratureChoice found =
      choice<CompressibleBody>({.degree = 3, .reflect = all_planes, .law = materials::CiarletGeymonat{1, 0.1}},
                               Matrix3d::Identity(), Vector3d(-40, -40, 40).asDiagonal(), {.end = 10});
  EXPECT_FALSE(found.error);
  EXPECT_FALSE(found.reason.empty());
}

}  // namespace
}  // namespace pseudorigid::testing
