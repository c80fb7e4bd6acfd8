/// Statements of Oliva 5.6 (rigid bodies): kinematics, inertia, momenta, the general equations, and the corrections 4
/// and 5. Tops (5.6.16, 5.6.17) are in statements_tops_test.cpp, Euler angles (5.6.20) in euler_angles_test.cpp, moving
/// frames (5.6.7) in moving_frame_test.cpp.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "mechanics/core/explicit_multiplier.h"
#include "mechanics/methods/methods.h"
#include "support/integrate.h"
#include "support/runs.h"
#include "systems/conservative_checks.h"
#include "systems/mass_distribution.h"
#include "systems/moving_frame.h"
#include "systems/sample_systems.h"

namespace pseudorigid::testing {

using Eigen::Matrix3d, Eigen::Vector3d;
using mechanics::axial_vector, mechanics::cross_matrix, mechanics::State;
using systems::FixedPointBody, systems::FreeBody, systems::MassDistribution, systems::WeightedPoint;

const Vector3d some_X(0.4, -1.3, 0.7), some_Y(1.1, 0.2, -0.6), some_Omega(0.6, -0.9, 1.1);

FreeBody loaded_free_body() { return FreeBody({tilted_E0(), generic_loads_about_the_center()}); }
State<FreeBody> free_start() {
  return systems::turning(generic_rotation(), some_Omega, {0.3, 0.1, -0.2}, {0.5, -0.4, 0.2});
}
/// A state in the middle of the motion of a loaded free body, by RATTLE of order 8.
State<FreeBody> state_on_the_way() {
  const auto r = run<mechanics::Rattle8>(loaded_free_body(), free_start(), 3, 1, 60);
  EXPECT_TRUE(r.finished()) << r.result.reason;
  return r.last();
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
Vector3d axial_of_skew(const Matrix3d& W) { return -0.5 * axial_vector(W); }

/// A body of mass points without symmetry.
std::vector<WeightedPoint> body_points() {
  return {{{0.3, -0.2, 0.9}, 1.2}, {{-0.7, 0.5, 0.1}, 0.8}, {{0.4, 1.0, -0.6}, 1.5}, {{-0.2, -0.9, -0.4}, 0.7}};
}

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
  const auto smallest = [](const Matrix3d& B) { return Eigen::SelfAdjointEigenSolver<Matrix3d>(B).eigenvalues()(0); };
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
  EXPECT_LT((body.body_momentum(s.q, s.v) - s.q.transpose() * p).norm(), 1e-14);
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
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(A);
  for (int i = 0; i < 3; ++i) {
    double moment = 0;
    for (const auto& p : points) moment += p.mass * Vector3d(solver.eigenvectors().col(i)).cross(p.xi).squaredNorm();
    EXPECT_NEAR(solver.eigenvalues()(i), moment, 1e-14);
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

/// "If S is free, its centre of mass moves uniformly; the kinetic momentum and the kinetic energy are constant."
TEST(Statement_5_6_14, FreeBodyConservesMomentumAndEnergy) {
  const FreeBody body({tilted_E0(), {}});
  const auto start = free_start();
  const auto r = run<mechanics::Rattle8>(body, start, 50, 10, 100);
  ASSERT_TRUE(r.finished());
  for (const auto& s : r.states) {
    EXPECT_LT((s.q.col(3) - start.q.col(3) - s.t * start.v.col(3)).norm(), 1e-12);
    EXPECT_LT((s.v.col(3) - start.v.col(3)).norm(), 1e-14);
    EXPECT_LT((body.angular_momentum(s.q, s.v) - body.angular_momentum(start.q, start.v)).norm(), 1e-12);
    EXPECT_NEAR(body.kinetic_energy(s.v), body.kinetic_energy(start.v), 1e-12);
  }
  EXPECT_GT((FreeBody::rotation(r.last().q) - FreeBody::rotation(start.q)).norm(), 0.1);
}

/// "A free rigid body rotates around its center of mass as if the center of mass were fixed."
TEST(Statement_5_6_15, FreeBodyRotatesAsIfItsCentreWereFixed) {
  const auto free = run<mechanics::Rattle8>(FreeBody({tilted_E0(), {}}), free_start(), 20, 1, 400);
  const auto fixed = run<mechanics::Rattle8>(FixedPointBody({tilted_E0(), {}}),
                                             systems::turning(generic_rotation(), some_Omega), 20, 1, 400);
  ASSERT_TRUE(free.finished() && fixed.finished());
  EXPECT_LT((FreeBody::rotation(free.last().q) - fixed.last().q).norm(), 1e-12);
}

/// The general equations EG₁, EG₂ of the loaded free body, m g̈ = F and Ṗ = P × Ω + N about the centre of mass, as a
/// field on (quaternion, centre).
struct GeneralEquations {
  using Vector = Eigen::Matrix<double, 7, 1>;
  struct Workspace {};
  Matrix3d A;
  systems::BodyLoads loads;

  mechanics::Status acceleration(double, const Vector& q, const Vector& v, Workspace&, Vector& a) const {
    using Top = systems::EulerTop<>;
    const Eigen::Vector4d quaternion = q.head<4>(), rate = v.head<4>();
    const Matrix3d R = Top::rotation(quaternion);
    const Vector3d g = q.tail<3>(), Omega = Top::body_angular_velocity(quaternion, rate);
    Vector3d F = Vector3d::Zero(), N = Vector3d::Zero();
    if (auto status = loads.apply([&](const Vector3d& xi) -> Vector3d { return R * xi + g; },
                                  [&](const Vector3d& xi, const Vector3d& df) {
                                    F += df;
                                    N += xi.cross(R.transpose() * df);
                                  });
        !status)
      return status;
    const Vector3d Omega_rate = A.inverse() * ((A * Omega).cross(Omega) + N);
    const auto times = [](const Eigen::Vector4d& p, const Vector3d& w) {
      return (Eigen::Quaterniond(p) * Eigen::Quaterniond(0, w.x(), w.y(), w.z())).coeffs();
    };
    a << 0.5 * (times(rate, Omega) + times(quaternion, Omega_rate)), F / loads.mass;
    return {};
  }
  Vector make_vector() const { return Vector::Zero(); }
  Workspace make_workspace() const { return {}; }
};

/// "The general equations EG₁, EG₂ are equivalent to the generalized Newton law on k × SO(3)": the constrained body by
/// RATTLE and the general equations have the same motion.
TEST(Statement_5_6_19, NewtonsLawOnKTimesSO3IsTheGeneralEquations) {
  const auto body = loaded_free_body();
  const auto r = run<mechanics::Rattle8>(body, free_start(), 10, 10, 60);
  ASSERT_TRUE(r.finished()) << r.result.reason;

  const auto rotation = systems::EulerTop<>::turning(generic_rotation(), some_Omega);
  State<GeneralEquations> start{};
  start.q << rotation.q, free_start().q.col(3);
  start.v << rotation.v, free_start().v.col(3);
  const GeneralEquations equations{body.inertia(), body.parameters().loads};
  const auto samples = integrate_samples(equations, start, 10, 10, 1e-14);
  ASSERT_EQ(samples.size(), r.states.size());
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const Eigen::Vector4d q = samples[k].q.head<4>(), q_rate = samples[k].v.head<4>();
    const auto& s = r.states[k];
    EXPECT_LT((FreeBody::rotation(s.q) - systems::EulerTop<>::rotation(q)).norm(), 1e-10);
    EXPECT_LT((s.q.col(3) - samples[k].q.tail<3>()).norm(), 1e-10);
    EXPECT_LT((s.v.col(3) - samples[k].v.tail<3>()).norm(), 1e-10);
    EXPECT_LT(
        (FreeBody::body_angular_velocity(s.q, s.v) - systems::EulerTop<>::body_angular_velocity(q, q_rate)).norm(),
        1e-10);
  }
  const auto energy = [&](const State<FreeBody>& s) { return body.kinetic_energy(s.v) + body.potential_energy(s.q); };
  EXPECT_NEAR(energy(r.last()), energy(r.states.front()), 1e-11);
}

/// Right: Ω = (M*)⁻¹ω. The printed (Ṁ*)⁻¹ω does not exist: Ṁ* = (ω×)M* is singular.
TEST(Correction_4, OmegaInTheBodyNeedsTheInverseOfMNotOfItsRate) {
  const auto s = state_on_the_way();
  const Matrix3d M = FreeBody::rotation(s.q), M_rate = FreeBody::rotation(s.v);
  const Vector3d omega = axial_of_skew(M_rate * M.transpose());
  EXPECT_LT((M.transpose() * M_rate - cross_matrix(M.inverse() * omega)).norm(), 1e-14);
  const Vector3d singular_values = M_rate.jacobiSvd().singularValues();
  EXPECT_LT(singular_values(2), 1e-15 * singular_values(0) * 10);
  EXPECT_GT(singular_values(1), 0.5);
}

/// Smallest singular value of the differential of (K, p) : T SO(3) → R⁴ at a state with the angular velocity Ω, by
/// differences in the six directions of T T SO(3) (turns of R with Ω held, and changes of Ω).
double smallest_singular_value(const FixedPointBody& body, const Vector3d& Omega) {
  Eigen::Matrix<double, 4, 6> D;
  for (int i = 0; i < 6; ++i)
    D.col(i) = derivative([&, Omega](double t) -> Eigen::Vector4d {
      const Vector3d e = Vector3d::Unit(i % 3);
      const Matrix3d turn = Eigen::AngleAxisd(i < 3 ? t : 0, e).toRotationMatrix();
      const auto s = systems::turning(generic_rotation() * turn, i < 3 ? Omega : Vector3d(Omega + t * e));
      Eigen::Vector4d K_p;
      K_p << body.kinetic_energy(s.v), body.angular_momentum(s.q, s.v);
      return K_p;
    });
  return D.jacobiSvd().singularValues()(3);
}

/// "(K, p) has no critical points if K₀ > 0" is false at steady rotations about principal axes, where |p|² = 2I_iK, and
/// true elsewhere.
TEST(Correction_5, SteadyRotationsAreCriticalPointsOfEnergyAndMomentum) {
  const FixedPointBody body({generic_E0(), {}});
  for (int i = 0; i < 3; ++i) {
    const auto s = systems::turning(generic_rotation(), 1.3 * Vector3d::Unit(i));
    const double K = body.kinetic_energy(s.v);
    EXPECT_GT(K, 0.5);
    EXPECT_NEAR(body.angular_momentum(s.q, s.v).squaredNorm(), 2 * generic_moments(i) * K, 1e-13);
    EXPECT_LT(smallest_singular_value(body, 1.3 * Vector3d::Unit(i)), difference_tolerance) << "critical, axis " << i;
  }
  EXPECT_GT(smallest_singular_value(body, some_Omega), 0.05) << "regular";
}

}  // namespace pseudorigid::testing
