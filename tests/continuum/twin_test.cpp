/// The finite-element system restricted to x = QX is the pseudo-rigid body with the mesh's own inertia and volume
/// (PHYSICS 7.3), to round-off: energies, momenta, force, constraint, rate, curvature and reaction. The constant 1 has
/// coefficients c_j = ∫ψ_j in the pressure space, so that an affine constraint value s is the vector s c, and a
/// multiplier Λ of the body is the field Λ/Vol, the vector Λ c / Vol.

#include <gtest/gtest.h>

#include "continuum/balls.h"
#include "reduced/observe.h"

namespace pseudorigid::testing {
namespace {

using Body = reduced::PseudoRigidBody<CiarletGeymonat, true>;
using continuum::Vector;

class Twin : public ::testing::TestWithParam<int> {
 protected:
  static constexpr double tolerance = 1e-12;

  void expect_near(const Matrix3d& a, const Matrix3d& b, const char* what) {
    EXPECT_LT((a - b).norm(), tolerance * std::max(1.0, b.norm())) << what;
  }

  /// c, from tr Id = 3: G(X) X = 3c.
  static Vector constant_one(const ElasticBall& ball) {
    Vector c = ball.make_multiplier();
    const Vector& X = ball.space().reference_positions();
    ball.constraint_rate(X, X, c);
    c /= 3;
    return c;
  }

  static double distance_from_multiple(Vector r, double s, const Vector& c) {
    r.add(-s, c);
    return r.linfty_norm();
  }

  void compare_energies_and_momenta(const ElasticBall& ball, const Body& body, const Matrix3d& Q,
                                    const Matrix3d& Qdot) {
    const auto o = observed(ball, affine_state(ball, Q, Qdot), {{.multiplier = false}});
    Body::Workspace workspace;
    mechanics::ReducedObservables expected;
    ASSERT_TRUE(reduced::observe(body, {0, Q, Qdot}, workspace, {}, expected));
    EXPECT_NEAR(o.kinetic, expected.kinetic, tolerance * expected.kinetic);
    EXPECT_NEAR(o.elastic, expected.elastic, tolerance * std::max(1.0, expected.elastic));
    EXPECT_NEAR(o.volume_ratio, expected.volume_ratio, tolerance);
    EXPECT_LT((o.angular_momentum - expected.angular_momentum).norm(), tolerance);
    EXPECT_LT((o.semi_axes - expected.semi_axes).norm(), tolerance);
    expect_near(o.Q, Q, "mass moment");
    expect_near(o.Qdot, Qdot, "its rate");
    expect_near(o.F, Q, "mean deformation gradient");
    EXPECT_LT(o.nonaffine_kinetic_fraction + o.nonaffine_displacement, tolerance);
    EXPECT_NEAR(o.min_jacobian, expected.volume_ratio, tolerance);
    EXPECT_NEAR(o.volume_error, std::abs(std::log(expected.volume_ratio)), tolerance);
    EXPECT_NEAR(o.max_volume_error, o.volume_error, tolerance);
  }

  void compare_forces(const ElasticBall& ball, const Body& body, const Matrix3d& Q, double Lambda) {
    const Vector x = ball.affine_field(Q), v = ball.make_vector();
    auto workspace = ball.make_workspace();
    Vector f = ball.make_vector();
    ASSERT_TRUE(ball.force(0, x, v, workspace, f));
    Body::Workspace body_workspace;
    Matrix3d expected;
    ASSERT_TRUE(body.force(0, Q, Matrix3d::Zero(), body_workspace, expected));
    expect_near(moment_of_force(ball, f), expected, "force");

    Vector lambda = constant_one(ball);
    lambda *= Lambda / ball.volume();
    ball.add_reaction(x, lambda, f);
    body.add_reaction(Q, Lambda, expected);
    expect_near(moment_of_force(ball, f), expected, "force and reaction");
  }

  void compare_constraint(const ElasticBall& ball, const Body& body, const Matrix3d& Q, const Matrix3d& Qdot) {
    const Vector x = ball.affine_field(Q), v = ball.affine_field(Qdot), c = constant_one(ball);
    Vector r = ball.make_multiplier();
    double expected = 0;
    ASSERT_TRUE(ball.constraint(x, r));
    ASSERT_TRUE(body.constraint(Q, expected));
    EXPECT_LT(distance_from_multiple(r, expected, c), tolerance) << "constraint";
    ball.constraint_rate(x, v, r);
    body.constraint_rate(Q, Qdot, expected);
    EXPECT_LT(distance_from_multiple(r, expected, c), tolerance) << "rate";
    ball.constraint_curvature(x, v, r);
    body.constraint_curvature(Q, Qdot, expected);
    EXPECT_LT(distance_from_multiple(r, expected, c), tolerance) << "curvature";
  }
};

TEST_P(Twin, AffineRestrictionIsThePseudoRigidBody) {
  std::mt19937 generator(GetParam());
  for (const Sector& sector : all_sectors)
    for (const CiarletGeymonat& law : {neo_hookean, ciarlet_geymonat}) {
      const ElasticBall ball(sector, GetParam(), 0, law);
      const Body body(law, {ball.E0(), ball.volume()});
      for (int i = 0; i < 10; ++i) {
        const Matrix3d Q = admissible(sector, Matrix3d::Identity() + 0.3 * random_matrix(generator));
        const Matrix3d Qdot = admissible(sector, random_matrix(generator));
        ASSERT_GT(Q.determinant(), 0.1);
        compare_energies_and_momenta(ball, body, Q, Qdot);
        compare_forces(ball, body, Q, random_matrix(generator)(0, 0));
        compare_constraint(ball, body, Q, Qdot);
      }
    }
}

TEST_P(Twin, HoldsOnRefinedMeshes) {
  std::mt19937 generator(GetParam());
  const ElasticBall ball(octant, GetParam(), 1, ciarlet_geymonat);
  const Body body(ciarlet_geymonat, {ball.E0(), ball.volume()});
  const Matrix3d Q = diagonal(1.3, 0.9, 0.8), Qdot = diagonal(0.4, -0.7, 0.2);
  compare_energies_and_momenta(ball, body, Q, Qdot);
  compare_forces(ball, body, Q, 0.7);
  compare_constraint(ball, body, Q, Qdot);
}

INSTANTIATE_TEST_SUITE_P(Degree, Twin, ::testing::Range(2, 9));

}  // namespace
}  // namespace pseudorigid::testing
