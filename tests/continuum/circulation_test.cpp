/// The circulation Z = ∫ρ X × (Fᵀẋ) dV of the finite-element ball. Of an affine motion it is that of the pseudo-rigid
/// body with the inertia that the quadrature of the kernels gives; of any other it is the integral itself, here by a
/// quadrature that knows neither mesh nor shape functions: in spherical coordinates, of a motion known in closed form.

#include <deal.II/base/quadrature_lib.h>
#include <gtest/gtest.h>

#include <numbers>

#include "continuum/balls.h"
#include "reduced/observe.h"

namespace pseudorigid::testing {
namespace {

using continuum::Vector;

/// x = X + s p(X), ẋ = BX + r(X) with cubic p and r. Odd, so that the centre of mass stays in the origin; nothing else
/// about them is symmetric.
struct CubicMotion {
  static constexpr double s = 0.1;
  Matrix3d B = (Matrix3d() << 0.3, -0.8, 0.2, 0.5, 0.1, -0.4, 0.3, 0.6, -0.2).finished();

  Vector3d position(const Vector3d& X) const {
    return X + s * Vector3d(X[0] * X[1] * X[1], X[0] * X[0] * X[2], X[2] * (X[0] * X[0] - X[1] * X[1]));
  }
  Matrix3d gradient(const Vector3d& X) const {
    Matrix3d D;
    D << X[1] * X[1], 2 * X[0] * X[1], 0,  //
        2 * X[0] * X[2], 0, X[0] * X[0],   //
        2 * X[0] * X[2], -2 * X[1] * X[2], X[0] * X[0] - X[1] * X[1];
    return Matrix3d::Identity() + s * D;
  }
  Vector3d velocity(const Vector3d& X) const {
    return B * X + Vector3d(X[1] * X[1] * X[2], X[0] * X[2] * X[2], X[0] * X[0] * X[1] - X[0] * X[1] * X[2]);
  }

  /// Exact for polynomials of degree 11.
  Vector3d circulation() const {
    const dealii::QGauss<1> gauss(8);
    constexpr int n_angles = 16;
    Vector3d Z = Vector3d::Zero();
    for (unsigned int i = 0; i < gauss.size(); ++i)
      for (unsigned int j = 0; j < gauss.size(); ++j)
        for (int k = 0; k < n_angles; ++k) {
          const double radius = gauss.point(i)[0], height = 2 * gauss.point(j)[0] - 1;
          const double angle = 2 * std::numbers::pi * k / n_angles, across = std::sqrt(1 - height * height);
          const Vector3d X = radius * Vector3d(across * std::cos(angle), across * std::sin(angle), height);
          const double weight =
              gauss.weight(i) * radius * radius * 2 * gauss.weight(j) * 2 * std::numbers::pi / n_angles;
          Z += weight * X.cross(gradient(X).transpose() * velocity(X));
        }
    return Z;
  }
};

template <class Field>
Vector at_nodes(const BallBody& ball, const Field& field) {
  const Vector& X = ball.space().reference_positions();
  Vector values = ball.make_vector();
  for (unsigned int i = 0; i < X.locally_owned_size(); i += 3) {
    const Vector3d value = field(Vector3d(X.local_element(i), X.local_element(i + 1), X.local_element(i + 2)));
    for (unsigned int c = 0; c < 3; ++c) values.local_element(i + c) = value[c];
  }
  return values;
}

class Circulation : public ::testing::TestWithParam<int> {};

TEST_P(Circulation, OfAnAffineMotionIsThatOfThePseudoRigidBody) {
  std::mt19937 generator(GetParam());
  for (const Sector& sector : all_sectors) {
    const ElasticBall ball(sector, GetParam(), 0, neo_hookean);
    const Vector& X = ball.space().reference_positions();
    const auto sums = ball.integrals(X, X).X_pulled_back;  // ∫X Xᵀ
    Matrix3d E;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) E(i, j) = sums[i][j];
    E = ball.whole_ball(E);
    const reduced::PseudoRigidBody<CiarletGeymonat, true> body(neo_hookean, {E, ball.volume()});
    for (int n = 0; n < 5; ++n) {
      const Matrix3d Q = admissible(sector, Matrix3d::Identity() + 0.3 * random_matrix(generator));
      const Matrix3d Qdot = admissible(sector, random_matrix(generator));
      reduced::PseudoRigidBody<CiarletGeymonat, true>::Workspace workspace;
      mechanics::ReducedObservables expected;
      ASSERT_TRUE(reduced::observe(body, {0, Q, Qdot}, workspace, {{.multiplier = false}}, expected));
      const auto o = observed(ball, affine_state(ball, Q, Qdot), {{.multiplier = false}});
      EXPECT_LT((o.circulation - expected.circulation).norm(), 1e-12);
      if (sector.n_images() == 1) {
        EXPECT_GT(expected.circulation.norm(), 1e-2);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Degree, Circulation, ::testing::Range(2, 9));

TEST(CirculationOfAnyMotion, IsTheIntegralOverTheBall) {
  const CubicMotion motion;
  const Vector3d exact = motion.circulation();
  ASSERT_GT(exact.cwiseAbs().minCoeff(), 0.03);
  const struct {
    int degree;
    double error;
  } expected[] = {{3, 2e-4}, {5, 1e-7}, {7, 1e-11}};
  for (const auto& [degree, error] : expected) {
    const ElasticBall ball(whole, degree, 0, neo_hookean);
    const auto o = observed(ball,
                            {0, at_nodes(ball, [&](const Vector3d& X) { return motion.position(X); }),
                             at_nodes(ball, [&](const Vector3d& X) { return motion.velocity(X); })},
                            {{.multiplier = false}});
    EXPECT_LT((o.circulation - exact).norm(), error) << "degree " << degree;
  }
}

}  // namespace
}  // namespace pseudorigid::testing
