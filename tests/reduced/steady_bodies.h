#pragma once
/// Bodies of the tests of steady motions: the potential, and the body that moves in it. Internal units, μ = ρ = r = 1
/// where there is elasticity (κ = 5), πGρ = 1 for the fluid.

#include <gtest/gtest.h>

#include <memory>
#include <numbers>
#include <string_view>

#include "reduced/bodies.h"
#include "reduced/equilibrium_families.h"
#include "reduced/potential.h"

namespace pseudorigid::testing {

inline constexpr double m_bar = 4 * std::numbers::pi / 15;

struct SteadyBody {
  reduced::Potential potential;

  /// of a law and πGρ
  SteadyBody(std::string_view law, double pi_G_rho, bool incompressible = true)
      : potential(materials::make_law(law, {}, incompressible), reduced::ReferenceBody::unit_ball(),
                  {.gravity_constant = pi_G_rho / std::numbers::pi}) {}

  reduced::IsotropicBody<reduced::Potential> isotropic(bool incompressible = true) const {
    return {potential, m_bar, incompressible};
  }
  reduced::PseudoRigidBody<reduced::Potential, true> moving() const {
    return {potential, reduced::ReferenceBody::unit_ball()};
  }
  reduced::PseudoRigidBody<reduced::Potential, false> moving_freely() const {
    return {potential, reduced::ReferenceBody::unit_ball()};
  }
};

inline const SteadyBody& fluid_of_gravity() {
  static const SteadyBody body("none", 1);
  return body;
}
inline const SteadyBody& neo_hookean() {
  static const SteadyBody body("neo-hookean", 0);
  return body;
}

inline reduced::EquilibriumPoint described(const SteadyBody& body, const reduced::SteadyMotion& motion) {
  reduced::EquilibriumPoint point;
  const auto status = reduced::describe_equilibrium(body.isotropic(), motion, 0, point);
  EXPECT_TRUE(status) << status.reason();
  return point;
}

/// The frequencies of the rates in the upper half-plane that are on the imaginary axis, rising.
inline std::vector<double> frequencies(const reduced::LinearStability& stability) {
  std::vector<double> f;
  for (const auto& rate : stability.rates)
    if (rate.s.imag() > 0 && std::abs(rate.s.real()) < 1e-6) f.push_back(rate.s.imag());
  return f;
}

/// Of the special points of that kind, in the order of the family.
template <class Family>
std::vector<reduced::EquilibriumPoint> special_points(const Family& family, reduced::SpecialKind kind) {
  std::vector<reduced::EquilibriumPoint> points;
  for (const auto& special : family.special)
    if (special.kind == kind) points.push_back(special.point);
  return points;
}

}  // namespace pseudorigid::testing
