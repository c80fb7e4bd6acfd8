/// Statements of Oliva 5.6 (rigid bodies) on kinematics, inertia and momenta, up to 5.6.13. Free bodies and the general
/// equations are in statements_rigid_motion_test.cpp, moving frames (5.6.7) in moving_frame_test.cpp.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <utility>
#include <vector>

#include "mechanics/core/explicit_multiplier.h"
#include "support/dense.h"
#include "systems/conservative_checks.h"
#include "systems/moving_frame.h"
#include "systems/rigid_motions.h"

namespace pseudorigid::testing {

/// "M* preserves modulus, inner product, is linear, a bijection whose inverse is an isometry, and preserves the vector
/// product": for the isometry ξ ↦ x(ξ) of a body on its way.
TEST(Statement_5_6_1, PlacesOfABodyAreAProperIsometry) {
  const auto s = state_on_the_way();
  const auto M = [&](const Vector3d& X) { return FreeBody::place(s.q, X); };
  const auto M_star = [&](const Vector3d& X) -> Vector3d { return M(X) - M(Vector3d::Zero()); };
  EXPECT_NEAR(M_star(some_X).norm(), some_X.norm(), 2e-15);
  EXPECT_NEAR(M_star(some_X).dot(M_star(some_Y)), some_X.dot(some_Y), 2e-15);
  EXPECT_LT((M_star(2.5 * some_X - some_Y) - 2.5 * M_star(some_X) + M_star(some_Y)).norm(), 2e-15);
  EXPECT_LT((M_star(some_X.cross(some_Y)) - M_star(some_X).cross(M_star(some_Y))).norm(), 4e-15);
  const auto N = [&](const Vector3d& x) -> Vector3d {
    return FreeBody::rotation(s.q).transpose() * (x - M(Vector3d::Zero()));  // (5.47)
  };
  EXPECT_LT((N(M(some_X)) - some_X).norm(), 2e-15);
  EXPECT_NEAR((N(some_X) - N(some_Y)).norm(), (some_X - some_Y).norm(), 2e-15);
}

/// Exercise 5.6.2, property 5 of 5.6.1: "if M* is orientation preserving then M* preserves the vector product", for the
/// places of a body; a reflection changes its sign.
TEST(Statement_5_6_2, OrientationPreservingIsometriesKeepTheVectorProduct) {
  const auto s = state_on_the_way();
  const Matrix3d M = FreeBody::rotation(s.q), reflected = M * Vector3d(1, 1, -1).asDiagonal();
  EXPECT_NEAR(M.determinant(), 1, 4e-15);
  EXPECT_LT((M * some_X.cross(some_Y) - (M * some_X).cross(M * some_Y)).norm(), 4e-15);
  EXPECT_LT((reflected * some_X.cross(some_Y) + (reflected * some_X).cross(reflected * some_Y)).norm(), 4e-15);
}

/// "M_t has a unique decomposition M_t = T_t∘R_t": the places of four points determine R and r, and these are q.
TEST(Statement_5_6_3, RotationAndTranslationAreDeterminedByTheMotion) {
  const auto s = state_on_the_way();
  Eigen::Matrix<double, 4, 4> bodies, homogeneous;
  Eigen::Matrix<double, 3, 4> places;
  bodies << 1, 0, 0.3, -0.5, 0.2, 1, 0, 0.4, 0.1, -0.2, 1, 0.7, 1, 1, 1, 1;
  for (int k = 0; k < 4; ++k) places.col(k) = FreeBody::place(s.q, bodies.col(k).head<3>());
  EXPECT_LT((places * bodies.inverse() - s.q).norm(), 4e-15);
  EXPECT_GT((s.q - free_start().q).norm(), 1) << "the body has moved";
}

/// Exercise 5.6.4: "to a skew-symmetric A there is a unique ω with Ay = ω × y, and ω = 0 iff A = 0": the program's two
/// maps are inverse to each other, up to the factor of its axial vector, −2.
TEST(Statement_5_6_4, SkewOperatorsAreVectors) {
  for (const Vector3d& omega : {some_X, some_Y, some_Omega, Vector3d(0, 0, 0)}) {
    const Matrix3d A = cross_matrix(omega);
    EXPECT_EQ(A, -A.transpose());
    EXPECT_LT((A * some_Y - omega.cross(some_Y)).norm(), 1e-15);
    EXPECT_EQ(axial_of_skew(A), omega);
    EXPECT_EQ(A.isZero(0), omega.isZero(0));
  }
  const Matrix3d B = cross_matrix(some_X) + 0.3 * cross_matrix(some_Y);  // linear
  EXPECT_LT((axial_of_skew(B) - some_X - 0.3 * some_Y).norm(), 1e-15);
}

/// "There exist unique Ω ∈ K and ω ∈ k with M*⁻¹Ṁ* = Ω×, Ṁ*M*⁻¹ = ω×, and ω = M*Ω."
TEST(Statement_5_6_5, AngularVelocitiesInBodyAndSpace) {
  const auto s = state_on_the_way();
  const Matrix3d R = FreeBody::rotation(s.q), R_rate = FreeBody::rotation(s.v);
  const Matrix3d in_body = R.transpose() * R_rate, in_space = R_rate * R.transpose();
  EXPECT_LT((in_body + in_body.transpose()).norm(), 4e-15);
  EXPECT_LT((in_space + in_space.transpose()).norm(), 4e-15);
  EXPECT_LT((axial_of_skew(in_space) - R * axial_of_skew(in_body)).norm(), 4e-15);
  EXPECT_LT((FreeBody::body_angular_velocity(s.q, s.v) - axial_of_skew(in_body)).norm(), 1e-15);
  EXPECT_GT(axial_of_skew(in_body).norm(), 0.5);
}

/// "To each time corresponds an axis of rotation, whose points have zero velocity; each other point has a velocity
/// orthogonal to the axis and proportional to the distance from it."
TEST(Statement_5_6_6, InstantaneousAxisOfRotation) {
  const FixedPointBody body({tilted_E0(), generic_loads()});
  const auto r = run<mechanics::Rattle8>(body, systems::turning(generic_rotation(), some_Omega), 3, 1, 60);
  ASSERT_TRUE(r.finished());
  const auto& s = r.last();
  const Vector3d Omega = FixedPointBody::body_angular_velocity(s.q, s.v), omega = s.q * Omega;
  const auto velocity = [&](const Vector3d& X) -> Vector3d { return s.v * X; };
  EXPECT_LT(velocity(1.7 * Omega).norm(), 1e-14);
  for (const Vector3d& X : {some_X, some_Y}) {
    const double distance = (s.q * X).cross(omega.normalized()).norm();
    EXPECT_NEAR(velocity(X).dot(omega), 0, 1e-14);
    EXPECT_NEAR(velocity(X).norm(), omega.norm() * distance, 1e-14);
    EXPECT_GT(distance, 0.1);
  }
}

/// "q̇(t, ξ) = ġ(t) + ω(t) × [q(t, ξ) − g(t)]", g the centre of mass, wherever the origin of K is.
TEST(Statement_5_6_8, VelocityFieldOfARigidMotion) {
  const auto s = state_on_the_way();
  const Vector3d omega = FreeBody::rotation(s.q) * FreeBody::body_angular_velocity(s.q, s.v);
  const auto place = [&](const Vector3d& xi) { return FreeBody::place(s.q, xi); };
  const auto velocity = [&](const Vector3d& xi) -> Vector3d {  // by differences along the states' line
    return derivative([&](double t) { return FreeBody::place(s.q + t * s.v, xi); });
  };
  for (const Vector3d& G : {Vector3d(0, 0, 0), Vector3d(0.4, 0.1, -0.8)})
    EXPECT_LT((velocity(some_X) - velocity(G) - omega.cross(place(some_X) - place(G))).norm(), 1e-11);
}

/// "The inertia operator is symmetric and positive; definite if two radii vectors are independent": A X = ∫ξ×(X×ξ)dm
/// is tr(E₀)Id − E₀.
TEST(Statement_5_6_9, InertiaOperatorFromTheSecondMoment) {
  const auto points = body_points();
  const Matrix3d A = systems::inertia_operator(MassDistribution::of_points(points).E0);
  Vector3d AX = Vector3d::Zero();
  for (const auto& p : points) AX += p.mass * p.xi.cross(some_X.cross(p.xi));
  EXPECT_LT((A * some_X - AX).norm(), 1e-14);
  EXPECT_NEAR((A * some_X).dot(some_Y), some_X.dot(A * some_Y), 1e-14);
  EXPECT_LT((systems::second_moment(A) - MassDistribution::of_points(points).E0).norm(), 1e-14);
  const auto smallest = [](const Matrix3d& B) { return symmetric_spectrum(B).values(0); };
  EXPECT_GT(smallest(A), 0.1);
  const std::vector<WeightedPoint> two{{some_X, 1.0}, {some_Y, 2.0}}, collinear{{some_X, 1.0}, {-2 * some_X, 2.0}};
  EXPECT_GT(smallest(systems::inertia_operator(MassDistribution::of_points(two).E0)), 0.1);
  EXPECT_NEAR(smallest(systems::inertia_operator(MassDistribution::of_points(collinear).E0)), 0, 1e-13);
}

/// "P = AΩ, K = ½(AΩ, Ω)" (5.82) for the motion with a fixed point, against the sums over the points of the body.
TEST(Statement_5_6_9, MomentumAndEnergyOfAFixedPointMotion) {
  const auto points = body_points();
  const FixedPointBody body({MassDistribution::of_points(points).E0, {}});
  const auto s = systems::turning(generic_rotation(), some_Omega);
  Vector3d p = Vector3d::Zero();
  double K = 0;
  for (const auto& point : points) {
    p += point.mass * (s.q * point.xi).cross(s.v * point.xi);
    K += 0.5 * point.mass * (s.v * point.xi).squaredNorm();
  }
  EXPECT_LT((body.angular_momentum(s.q, s.v) - p).norm(), 1e-14);
  EXPECT_LT((body.inertia() * body.body_angular_velocity(s.q, s.v) - s.q.transpose() * p).norm(), 1e-14);
  EXPECT_NEAR(body.kinetic_energy(s.v), K, 1e-14);
  EXPECT_NEAR(0.5 * some_Omega.dot(body.inertia() * some_Omega), K, 1e-14);
}

/// "S rotates around an axis with constant ω: distances ρ(ξ) from it are constant, K = ½I_e|ω|², Ω is constant; the
/// eigenvalues of A are the moments about the principal axes." M = exp(tω×)M₀ here.
TEST(Statement_5_6_10, RotationAboutAFixedAxis) {
  const Vector3d omega(0.4, -1.1, 0.7), e = omega.normalized();
  systems::FrameMotion motion;
  motion.M0 = generic_rotation();
  motion.precession = omega;
  const auto points = body_points();
  const Matrix3d A = systems::inertia_operator(MassDistribution::of_points(points).E0);
  const Vector3d Omega0 = motion.at(0).Omega;
  for (const double t : {0.0, 0.7, 5.1}) {
    const auto pose = motion.at(t);
    double K = 0, I_e = 0;
    for (const auto& p : points) {
      const Vector3d q = pose.M * p.xi;
      EXPECT_NEAR(q.cross(e).norm(), (motion.M0 * p.xi).cross(e).norm(), 1e-14);
      K += 0.5 * p.mass * (pose.M * pose.Omega.cross(p.xi)).squaredNorm();
      I_e += p.mass * q.cross(e).squaredNorm();
    }
    EXPECT_LT((pose.Omega - Omega0).norm(), 1e-14);
    EXPECT_NEAR(K, 0.5 * I_e * omega.squaredNorm(), 1e-14);
    EXPECT_NEAR(K, 0.5 * pose.Omega.dot(A * pose.Omega), 1e-14);
  }
  const auto [moments, axes] = symmetric_spectrum(A);
  for (int i = 0; i < 3; ++i) {
    double moment = 0;
    for (const auto& p : points) moment += p.mass * Vector3d(axes.col(i)).cross(p.xi).squaredNorm();
    EXPECT_NEAR(moments(i), moment, 1e-14);
  }
}

/// A free body that turns about a principal axis goes on so: the fixed axis of 5.6.10 as a motion of the program.
TEST(Statement_5_6_10, AFreeBodyTurnsUniformlyAboutAPrincipalAxis) {
  const FixedPointBody body({generic_E0(), {}});
  const Vector3d Omega(0, 0, 1.3);
  const auto r = run<mechanics::Rattle8>(body, systems::turning(generic_rotation(), Omega), 10, 10, 100);
  ASSERT_TRUE(r.finished());
  for (const auto& s : r.states) {
    const Matrix3d expected = generic_rotation() * Eigen::AngleAxisd(1.3 * s.t, Vector3d::UnitZ()).toRotationMatrix();
    EXPECT_LT((s.q - expected).norm(), 1e-13);
  }
}

/// Steiner: "the moment of inertia about an axis is that about the parallel axis through the centre of mass plus m d²".
TEST(Statement_5_6_11, SteinersTheorem) {
  const auto points = body_points();
  const auto about_origin = MassDistribution::of_points(points);
  const Vector3d c(0.8, -0.3, 1.4), e = Vector3d(1, 2, -2) / 3;
  double direct = 0;
  for (const auto& p : points) direct += p.mass * e.cross(p.xi - c).squaredNorm();
  const auto moment = [&](const MassDistribution& d) { return e.dot(systems::inertia_operator(d.E0) * e); };
  const double d = e.cross(about_origin.center - c).norm();
  const auto about_center = about_origin.about(about_origin.center);
  EXPECT_NEAR(moment(about_center) + about_origin.mass * d * d, direct, 1e-14);
  EXPECT_NEAR(moment(about_origin.about(c)), direct, 1e-14);
  EXPECT_LT(about_center.center.norm(), 1e-15);
  EXPECT_GT(d, 0.5);
}

/// "The proper isometries are diffeomorphic to k × SO(k; 3)", Φ(M) = (M(0), M*), Ψ(r, h) = (X ↦ r + hX): the program's
/// coordinates q = [R | x] are these, and what its places say of them they are again.
TEST(Statement_5_6_12, IsometriesArePairsOfAPlaceAndARotation) {
  const auto Psi = [](const Vector3d& r, const Matrix3d& h) {
    return systems::turning(h, Vector3d::Zero(), r, Vector3d::Zero()).q;
  };
  const auto Phi = [](const FreeBody::Vector& q) {
    const Vector3d r = FreeBody::place(q, Vector3d::Zero());
    Matrix3d h;
    for (int i = 0; i < 3; ++i) h.col(i) = FreeBody::place(q, Vector3d::Unit(i)) - r;
    return std::pair(r, h);
  };
  const auto s = state_on_the_way();
  const auto [r, h] = Phi(s.q);
  EXPECT_LT((Psi(r, h) - s.q).norm(), 2e-15);
  EXPECT_LT((h.transpose() * h - Matrix3d::Identity()).norm(), 1e-14);
  EXPECT_NEAR(h.determinant(), 1, 1e-14);
  const auto [r_again, h_again] = Phi(Psi(some_X, generic_rotation()));
  EXPECT_LT((r_again - some_X).norm() + (h_again - generic_rotation()).norm(), 2e-15);
  // Six dimensions: of the twelve entries of q the six constraints leave six.
  Eigen::Matrix<double, 6, 12> G;
  for (int k = 0; k < 12; ++k) {
    FreeBody::Vector e = FreeBody::Vector::Zero();
    e(k) = 1;
    FreeBody::Multiplier rate;
    loaded_free_body().constraint_rate(s.q, e, rate);
    G.col(k) = rate;
  }
  EXPECT_GT(singular_values(G)(5), 0.5);
}

/// q̈ by the explicit multiplier.
template <class Body>
typename Body::Vector acceleration_of(const Body& body, const State<Body>& s) {
  const mechanics::ExplicitMultiplier<Body> field(body);
  auto w = field.make_workspace();
  auto a = body.make_vector();
  EXPECT_TRUE(field.acceleration(s.t, s.q, s.v, w, a));
  return a;
}
/// "dK/dt = ∫(q̇, df) = (ġ, F) + (ω, P_g)", F the total force and P_g its moment about the centre of mass.
TEST(Statement_5_6_13, PowerOfTheExternalForces) {
  const auto body = loaded_free_body();
  const auto s = state_on_the_way();
  auto p = body.make_vector();
  body.apply_mass(acceleration_of(body, s), p);
  const double K_rate = s.v.cwiseProduct(p).sum();

  double power = 0;
  Vector3d F = Vector3d::Zero(), P_g = Vector3d::Zero();
  const auto place = [&](const Vector3d& xi) { return FreeBody::place(s.q, xi); };
  ASSERT_TRUE(body.parameters().loads.apply(place, [&](const Vector3d& xi, const Vector3d& df) {
    power += FreeBody::place(s.v, xi).dot(df);  // q̇(ξ) = Ṙξ + ẋ
    F += df;
    P_g += (place(xi) - s.q.col(3)).cross(df);
  }));
  const Vector3d omega = FreeBody::rotation(s.q) * FreeBody::body_angular_velocity(s.q, s.v);
  EXPECT_NEAR(K_rate, power, 1e-13);
  EXPECT_NEAR(power, s.v.col(3).dot(F) + omega.dot(P_g), 1e-13);
  EXPECT_GT(std::abs(power), 0.05);
}

}  // namespace pseudorigid::testing
