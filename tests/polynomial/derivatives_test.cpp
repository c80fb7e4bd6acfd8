/// Forces of polynomial bodies are derivatives of their energies, for every law and every load, and what dissipates is
/// a linear, symmetric function of the velocity whose power is accounted for.

#include <gtest/gtest.h>

#include "polynomial/samples.h"
#include "support/differences.h"
#include "systems/conservative_checks.h"

namespace pseudorigid::testing {
namespace {

template <class Body>
class Forces : public ::testing::Test {
 protected:
  static constexpr double time = 0.7;

  /// A body of degree 3, on an ellipsoid so that no direction is special.
  static Body body(const Planes& planes, const materials::AnyLaw& law, const loads::Loads& loads) {
    return Body(BodySetup{.degree = 3,
                          .reflect = planes,
                          .semi_axes = {1.2, 0.9, 1},
                          .law = law,
                          .volumetric_stiffness = 0.4,
                          .loads = loads});
  }
  static VectorXd force(const Body& body, double t, const VectorXd& q, const VectorXd& v) {
    auto workspace = body.make_workspace();
    VectorXd f = body.make_vector();
    EXPECT_TRUE(body.force(t, q, v, workspace, f));
    return f;
  }
  static loads::Loads dissipation() { return {loads::Viscosity{0.3}, loads::Drag{0.2}}; }
  static const materials::CiarletGeymonat law() { return {1, 3}; }
};
using Bodies = ::testing::Types<IncompressibleBody, CompressibleBody>;
TYPED_TEST_SUITE(Forces, Bodies);

TYPED_TEST(Forces, AreMinusTheGradientOfTheEnergyForEveryLawAndLoad) {
  std::mt19937 generator(1);
  constexpr bool keeps_volume = incompressible<TypeParam>;
  for (const auto& named : materials::law_table)
    for (const Planes& planes : {no_planes, Planes{false, false, true}, all_planes})
      for (const auto& [name, loads] : single_loads(keeps_volume, planes)) {
        SCOPED_TRACE(std::string(named.name) + ", " + name);
        const auto body = this->body(planes, generic(named, keeps_volume), loads);
        const VectorXd q = random_position(body, generator), f = this->force(body, this->time, q, body.make_vector());
        VectorXd u = random_direction(body, generator);
        u.tail(u.size() - body.space().n_unknowns()).setZero();
        const auto energy_at = [&](int k) { return body.potential_energies(this->time, q + 2e-4 * k * u).total(); };
        EXPECT_NEAR(f.dot(u), -first_difference(energy_at, 2e-4), 1e-11 * (std::abs(energy_at(0)) + f.norm()));
      }
}

/// What loads that depend on time give to the body: the derivative of the energy at rest.
TYPED_TEST(Forces, ThePowerOfLoadsInTimeIsTheRateOfTheirEnergy) {
  std::mt19937 generator(2);
  const auto tide = with_entries<loads::PeriodicTide>(no_planes);
  const auto body = this->body(no_planes, this->law(), tide);
  ASSERT_TRUE(body.time_dependent());
  const VectorXd q = random_position(body, generator), f = this->force(body, this->time, q, body.make_vector());
  const auto energy_at = [&](int k) { return body.potential_energies(this->time + 1e-2 * k, q).external; };
  EXPECT_NEAR(f[body.space().n_unknowns() + 1], first_difference(energy_at, 1e-2), 1e-13);
  EXPECT_NEAR(f[body.space().n_unknowns()], 0, 0);
}

TYPED_TEST(Forces, DissipationIsLinearAndSymmetricInTheVelocityAndItsPowerIsAccountedFor) {
  std::mt19937 generator(3);
  for (const Planes& planes : {no_planes, all_planes}) {
    const auto body = this->body(planes, this->law(), this->dissipation());
    const int n = body.space().n_unknowns();
    const VectorXd q = random_position(body, generator), at_rest = this->force(body, 0, q, body.make_vector());
    const auto damping = [&](const VectorXd& v) { return VectorXd((this->force(body, 0, q, v) - at_rest).head(n)); };
    const VectorXd u = random_direction(body, generator), v = random_direction(body, generator);
    const double scale = damping(u).norm();
    EXPECT_LT((damping(u + 0.5 * v) - damping(u) - 0.5 * damping(v)).norm(), 1e-13 * scale);
    EXPECT_NEAR(damping(u).dot(v.head(n)), damping(v).dot(u.head(n)), 1e-13 * scale);
    EXPECT_LT(damping(u).dot(u.head(n)), -0.1);
    EXPECT_NEAR(this->force(body, 0, q, u)[n], -damping(u).dot(u.head(n)), 1e-13 * scale);
  }
}

/// The power ∫2ηJ d:d + c ∫ρẋ², point by point from the functions.
TYPED_TEST(Forces, PowerOfDissipationIsItsIntegral) {
  std::mt19937 generator(4);
  const auto body = this->body(no_planes, this->law(), this->dissipation());
  const auto& space = body.space();
  const VectorXd q = random_position(body, generator), v = random_direction(body, generator);
  double power = 0;
  for (int p = 0; p < space.n_points(); ++p) {
    const auto jets = space.functions_at(space.points()[p]);
    const Matrix3d F = space.gradient(jets, q), L = space.gradient(jets, v) * F.inverse(), d = (L + L.transpose()) / 2;
    power +=
        space.weights()[p] * (2 * 0.3 * F.determinant() * d.squaredNorm() + 0.2 * space.value(jets, v).squaredNorm());
  }
  EXPECT_NEAR(this->force(body, 0, q, v)[space.n_unknowns()], power, 1e-12 * power);
}

TYPED_TEST(Forces, ViscosityDoesNotActOnRigidMotions) {
  std::mt19937 generator(5);
  const auto body = this->body(no_planes, this->law(), loads::Viscosity{0.3});
  const VectorXd q = random_position(body, generator);
  VectorXd v = body.make_vector(), unused = v;
  ASSERT_EQ(body.n_symmetries(), 6);
  for (int i = 0; i < 6; ++i) {
    body.symmetry(i, q, q, v, unused);
    EXPECT_GT(v.norm(), 0.5);
    EXPECT_LT((this->force(body, 0, q, v) - this->force(body, 0, q, body.make_vector())).norm(), 1e-13);
  }
}

TYPED_TEST(Forces, RigidMotionsAreSymmetriesWhereThePlanesLeaveThem) {
  std::mt19937 generator(6);
  loads::Loads loads;
  if constexpr (incompressible<TypeParam>) loads = loads::SelfGravity{0.5};
  for (const Planes& planes : all_sectors()) {
    const auto body = this->body(planes, this->law(), loads);
    const int n_planes = planes[0] + planes[1] + planes[2];
    const int n_turns = n_planes == 0 ? 3 : n_planes == 1 ? 1 : 0, n_translations = 3 - n_planes;
    EXPECT_EQ(body.n_symmetries(), n_turns + n_translations);
    expect_symmetries_hold(body, random_position(body, generator), random_direction(body, generator));
  }
  const auto loaded = this->body(no_planes, this->law(), with_entries<loads::Tide>(no_planes));
  EXPECT_EQ(loaded.n_symmetries(), 0);
}

TYPED_TEST(Forces, WhatIsNoDeformationIsRefusedWithItsPlace) {
  const auto body = this->body(no_planes, this->law(), {});
  auto workspace = body.make_workspace();
  VectorXd f = body.make_vector();
  const VectorXd inside_out = body.affine(Vector3d(1, -0.5, 1).asDiagonal());
  const auto status = body.force(0, inside_out, f, workspace, f);
  ASSERT_FALSE(status);
  EXPECT_NE(status.reason().find("turned inside out or is not finite: det F = -0.5 at X/r = ("), std::string::npos)
      << status.reason();
  EXPECT_EQ(body.potential_energy(inside_out), HUGE_VAL);

  VectorXd not_a_number = body.affine(Matrix3d::Identity());
  not_a_number[5] = NAN;
  EXPECT_FALSE(body.force(0, not_a_number, body.make_vector(), workspace, f));
  EXPECT_FALSE(body.admissible(not_a_number));
  auto g = body.make_multiplier();
  if constexpr (incompressible<TypeParam>) {
    EXPECT_FALSE(body.constraint(inside_out, g));
    EXPECT_FALSE(body.constraint(not_a_number, g));
  }

  const auto chains = this->body(no_planes, materials::Gent{1, 0, 2}, {});
  const auto beyond = chains.admissible(chains.affine(Vector3d(2, 0.5, 1).asDiagonal()));  // I − 3 = 2.25 > 2
  ASSERT_FALSE(beyond);
  EXPECT_EQ(beyond.reason().find("inside out"), std::string::npos) << beyond.reason();
}

}  // namespace
}  // namespace pseudorigid::testing
