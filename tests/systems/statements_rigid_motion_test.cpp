/// Statements of Oliva 5.6 (rigid bodies) on free bodies, the general equations and the metric of k × SO(3) (5.6.14,
/// 5.6.15, 5.6.18, 5.6.19), and the corrections 4 and 5. Tops (5.6.16, 5.6.17) are in statements_tops_test.cpp, Euler
/// angles (5.6.20) in euler_angles_test.cpp.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "support/dense.h"
#include "support/differences.h"
#include "support/integrate.h"
#include "systems/conservative_checks.h"
#include "systems/rigid_motions.h"

namespace pseudorigid::testing {

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

/// (5.99): "⟨s, s̄⟩_h = ∫(sBξ, s̄Bξ)dm is left invariant", ⟨gs, gs̄⟩_gh = ⟨s, s̄⟩_h; it is right invariant only if E₀ is
/// a multiple of Id.
TEST(Statement_Eq5_99, MetricOfTheRotationsIsLeftInvariant) {
  const Matrix3d h = generic_rotation(), g = Eigen::AngleAxisd(1.3, some_X.normalized()).toRotationMatrix();
  const Matrix3d s = h * cross_matrix(some_Omega), s_bar = h * cross_matrix(some_Y);
  const auto inner = [](const Matrix3d& E0, const Matrix3d& a, const Matrix3d& b) {
    const FixedPointBody body({E0, {}});
    return 0.5 * (body.kinetic_energy(a + b) - body.kinetic_energy(a - b));
  };
  EXPECT_NEAR(inner(tilted_E0(), g * s, g * s_bar), inner(tilted_E0(), s, s_bar), 1e-14);
  EXPECT_GT(std::abs(inner(tilted_E0(), s * g, s_bar * g) - inner(tilted_E0(), s, s_bar)), 0.1);
  const Matrix3d round = 0.7 * Matrix3d::Identity();
  EXPECT_NEAR(inner(round, s * g, s_bar * g), inner(round, s, s_bar), 1e-14);

  double by_points = 0;  // ∫(sξ, s̄ξ)dm over the points of a body
  for (const auto& p : body_points()) by_points += p.mass * (s * p.xi).dot(s_bar * p.xi);
  EXPECT_NEAR(inner(MassDistribution::of_points(body_points()).E0, s, s_bar), by_points, 1e-14);
}

/// Exercise 5.6.18: "ḣ ↦ ḣh⁻¹ is a linear isomorphism of T_hSO(k; 3) onto the skew operators": of the velocities that
/// the program's constraints allow.
TEST(Statement_5_6_18, VelocitiesAtARotationAreSkewOperators) {
  const FixedPointBody body({tilted_E0(), {}});
  const Matrix3d h = generic_rotation();
  const auto allowed = [&](const Matrix3d& v) {
    FixedPointBody::Multiplier rate;
    body.constraint_rate(h, v, rate);
    return rate.norm() < 1e-15;
  };
  for (int i = 0; i < 3; ++i) {
    const Matrix3d A = cross_matrix(Vector3d::Unit(i));  // onto: each skew A is one of an allowed ḣ = Ah
    EXPECT_TRUE(allowed(A * h));
  }
  EXPECT_FALSE(allowed(Matrix3d(Vector3d(1, 0, 0).asDiagonal()) * h));
  // One to one: the allowed velocities have three dimensions, as G has the rank 6.
  Eigen::Matrix<double, 6, 9> G;
  for (int k = 0; k < 9; ++k) {
    Matrix3d e = Matrix3d::Zero();
    e(k) = 1;
    FixedPointBody::Multiplier rate;
    body.constraint_rate(h, e, rate);
    G.col(k) = rate;
  }
  EXPECT_GT(singular_values(G)(5), 0.5);
  const auto s = state_on_the_way();
  const Matrix3d of_motion = FreeBody::rotation(s.v) * FreeBody::rotation(s.q).transpose();
  EXPECT_LT((of_motion + of_motion.transpose()).norm(), 4e-15);
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

/// (5.104)–(5.107): the field h̄˙ = Ah along the motion, with a constant skew A, is not parallel but right-invariant,
/// and as such a Killing field of the left-invariant metric, ⟨q̇, D(Ah)/dt⟩ = 0: so that d/dt⟨ḣ, Ah⟩ = ⟨Dḣ/dt, Ah⟩ =
/// F(Ah), the moment of the loads about the axis of A. Left-invariant fields hA have no such law.
TEST(Statement_5_6_19, ExtensionByARightInvariantFieldIsAKillingField) {
  const FixedPointBody body({tilted_E0(), generic_loads()});
  const Matrix3d A = cross_matrix(some_Y);
  const auto start = systems::turning(generic_rotation(), some_Omega);
  const double h = 0.02;
  const auto r = run<mechanics::Rattle8>(body, start, 8 * h, 8, 4);
  ASSERT_TRUE(r.finished());
  const auto rate_of = [&](const auto& field) {
    return first_difference(
        [&](int k) {
          const auto& s = r.states[static_cast<std::size_t>(k + 4)];
          Matrix3d p;
          body.apply_mass(s.v, p);
          return mechanics::dot(p, field(s.q));
        },
        h);
  };
  const auto& middle = r.states[4];
  FixedPointBody::Workspace w;
  Matrix3d f;
  ASSERT_TRUE(body.force(0, middle.q, middle.v, w, f));
  const double right = rate_of([&](const Matrix3d& q) -> Matrix3d { return A * q; });
  EXPECT_NEAR(right, mechanics::dot(f, Matrix3d(A * middle.q)), 1e-10);
  const double left = rate_of([&](const Matrix3d& q) -> Matrix3d { return q * A; });
  EXPECT_GT(std::abs(left - mechanics::dot(f, Matrix3d(middle.q * A))), 0.05);
  // A parallel field would have |X| constant; along the motion |Ah| is not.
  const auto length = [&](const State<FixedPointBody>& s) { return body.kinetic_energy(A * s.q); };
  EXPECT_GT(std::abs(length(r.states[8]) - length(r.states[0])), 1e-3);
}

/// Right: Ω = (M*)⁻¹ω. The printed (Ṁ*)⁻¹ω does not exist: Ṁ* = (ω×)M* is singular.
TEST(Correction_4, OmegaInTheBodyNeedsTheInverseOfMNotOfItsRate) {
  const auto s = state_on_the_way();
  const Matrix3d M = FreeBody::rotation(s.q), M_rate = FreeBody::rotation(s.v);
  const Vector3d omega = axial_of_skew(M_rate * M.transpose());
  EXPECT_LT((M.transpose() * M_rate - cross_matrix(M.inverse() * omega)).norm(), 1e-14);
  const Vector3d sigma = singular_values(M_rate);
  EXPECT_LT(sigma(2), 1e-15 * sigma(0) * 10);
  EXPECT_GT(sigma(1), 0.5);
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
