/// Euler angles (5.6.20, corrected): the angular velocities, the nodal line, continuity along a motion, the
/// singularity; correction 3.

#include "systems/euler_angles.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "mechanics/methods/methods.h"
#include "support/differences.h"
#include "support/runs.h"
#include "systems/conservative_checks.h"
#include "systems/rigid_motions.h"
#include "systems/sample_systems.h"

namespace pseudorigid::testing {

using Eigen::Matrix3d, Eigen::Vector3d;
using systems::FixedPointBody;

const systems::EulerAngles some_angles{0.7, 1.1, -2.3}, some_rates{0.4, -0.9, 1.3};

/// Ω and ω by differences of R(φ, θ, ψ) along a path through the angles.
std::array<Vector3d, 2> angular_velocities_by_differences() {
  const auto& [a, rate] = std::pair(some_angles, some_rates);
  const Matrix3d R = systems::rotation_of(a),
                 R_rate = derivative([&, a = a, rate = rate](double t) -> Matrix3d {
                   return systems::rotation_of({a.phi + t * rate.phi, a.theta + t * rate.theta, a.psi + t * rate.psi});
                 });
  return {axial_of_skew(R.transpose() * R_rate), axial_of_skew(R_rate * R.transpose())};
}

Vector3d space_angular_velocity(const systems::EulerAngles& a, const systems::EulerAngles& rate) {
  return {rate.theta * std::cos(a.phi) + rate.psi * std::sin(a.phi) * std::sin(a.theta),
          rate.theta * std::sin(a.phi) - rate.psi * std::cos(a.phi) * std::sin(a.theta),
          rate.phi + rate.psi * std::cos(a.theta)};
}

/// The Euler angles, (5.6.20) with θ̇ in A: Ω, ω and the way back from R and Ω.
TEST(Statement_5_6_20, EulerAnglesGiveTheAngularVelocities) {
  const auto [Omega, omega] = angular_velocities_by_differences();
  EXPECT_LT((systems::body_angular_velocity(some_angles, some_rates) - Omega).norm(), difference_tolerance);
  EXPECT_LT((space_angular_velocity(some_angles, some_rates) - omega).norm(), difference_tolerance);
  const auto rates = systems::rates_of(some_angles, Omega);
  EXPECT_NEAR(rates.phi, some_rates.phi, difference_tolerance);
  EXPECT_NEAR(rates.theta, some_rates.theta, difference_tolerance);
  EXPECT_NEAR(rates.psi, some_rates.psi, difference_tolerance);
}

/// φ turns e_x to the nodal line e_N = e_z × e₃/|e_z × e₃|, θ turns e_z to e₃, ψ turns e_N to e₁.
TEST(Statement_5_6_20, AnglesAreThoseOfTheNodalLine) {
  const Matrix3d R = systems::rotation_of(some_angles);
  const Vector3d nodal = Vector3d::UnitZ().cross(R.col(2)).normalized(), e1 = R.col(0), e3 = R.col(2);
  const auto turn = [](double angle, const Vector3d& axis) {
    return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  };
  EXPECT_LT((turn(some_angles.phi, Vector3d::UnitZ()) * Vector3d::UnitX() - nodal).norm(), 1e-15);
  EXPECT_LT((turn(some_angles.theta, nodal) * Vector3d::UnitZ() - e3).norm(), 1e-15);
  EXPECT_LT((turn(some_angles.psi, e3) * nodal - e1).norm(), 1e-15);
}

/// From one angle to another, without whole turns.
double turn_between(double from, double to) { return std::remainder(to - from, 2 * std::numbers::pi); }

/// "K = ½(I₁A² + I₂B² + I₃C²)" with the rates of the angles by differences along a motion, where they are continuous;
/// the program's rates from Ω are the same.
TEST(Statement_5_6_20, AnglesAlongAMotionAreContinuous) {
  const FixedPointBody body({generic_E0(), {}});
  const double h = 0.01;
  const auto r =
      run<mechanics::Rattle8>(body, systems::turning(systems::rotation_of(some_angles), {0.2, 0.1, 2.0}), 30, 3000, 1);
  ASSERT_TRUE(r.finished());
  std::vector<Vector3d> angles{Vector3d(some_angles.phi, some_angles.theta, some_angles.psi)};  // turns are counted
  for (std::size_t k = 1; k < r.states.size(); ++k) {
    const systems::EulerAngles a = systems::euler_angles_of(r.states[k].q);
    EXPECT_LT((systems::rotation_of(a) - r.states[k].q).norm(), 1e-14) << "round-off";
    const Vector3d before = angles.back();
    const Vector3d step(turn_between(before.x(), a.phi), a.theta - before.y(), turn_between(before.z(), a.psi));
    ASSERT_LT(step.cwiseAbs().maxCoeff(), 0.5) << "no jump";
    angles.push_back(before + step);
  }
  EXPECT_GT(std::abs(angles.back().z() - angles.front().z()), 6 * std::numbers::pi) << "several turns";

  for (int k = 4; k + 4 < static_cast<int>(angles.size()); k += 10) {
    const auto& s = r.states[k];
    const Vector3d rate = first_difference([&](int j) { return angles[k + j]; }, h);
    const systems::EulerAngles a{angles[k].x(), angles[k].y(), angles[k].z()}, rates{rate.x(), rate.y(), rate.z()};
    const Vector3d ABC = systems::body_angular_velocity(a, rates);
    EXPECT_NEAR(0.5 * ABC.dot(generic_moments.cwiseProduct(ABC)), body.kinetic_energy(s.v), 1e-9);
    const auto by_Omega = systems::rates_of(a, FixedPointBody::body_angular_velocity(s.q, s.v));
    EXPECT_LT((rate - Vector3d(by_Omega.phi, by_Omega.theta, by_Omega.psi)).norm(), 1e-9);
  }
}

/// Right: A = φ̇ sinψ sinθ + θ̇ cosψ. The printed A = φ̇ sinψ sinθ + ψ̇ cosψ is not the component of Ω.
TEST(Correction_3, PrintedFirstComponentOfOmegaIsWrong) {
  const Vector3d Omega = angular_velocities_by_differences()[0];
  const auto& a = some_angles;
  const double turning = some_rates.phi * std::sin(a.psi) * std::sin(a.theta);
  EXPECT_NEAR(turning + some_rates.theta * std::cos(a.psi), Omega.x(), difference_tolerance);
  EXPECT_GT(std::abs(turning + some_rates.psi * std::cos(a.psi) - Omega.x()), 1);
}

/// At sin θ = 0 one of φ and ψ is free: ψ = 0, by convention.
TEST(EulerAngles, TheTurnIsAllInPhiWhereTheChartIsSingular) {
  for (const auto& [theta, phi] : {std::pair(0.0, 0.3 + 0.4), {std::numbers::pi, 0.3 - 0.4}}) {
    const Matrix3d R = systems::rotation_of({0.3, theta, 0.4});
    const auto a = systems::euler_angles_of(R);
    EXPECT_NEAR(a.phi, phi, 1e-15);
    EXPECT_EQ(a.theta, theta);
    EXPECT_EQ(a.psi, 0);
    EXPECT_LT((systems::rotation_of(a) - R).norm(), 1e-15);
  }
  EXPECT_NEAR(systems::euler_angles_of(systems::rotation_of({0.3, 1e-6, 0.4})).phi, 0.3, 1e-9);
}

}  // namespace pseudorigid::testing
