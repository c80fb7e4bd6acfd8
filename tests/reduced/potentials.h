#pragma once
/// Bodies under sums of potentials, for the tests: every law with gravity and a quadratic potential, in internal units
/// (μ = ρ = r = 1; G = 1/π where time is in 1/√(πGρ)), and the spheroids diag(1/√ℓ, 1/√ℓ, ℓ).

#include <numbers>
#include <string_view>
#include <vector>

#include "materials/law_table.h"
#include "reduced/bodies.h"
#include "reduced/potential.h"

namespace pseudorigid::testing {

using LoadedSl3 = reduced::PseudoRigidBody<reduced::Potential, true>;
using LoadedGl3 = reduced::PseudoRigidBody<reduced::Potential, false>;

inline constexpr double fluid_time_G = std::numbers::inv_pi;  // time in 1/√(πGρ)

/// What besides the law acts on the body, and on which body.
struct Loads {
  double G = 0;
  Matrix3d quadratic = Matrix3d::Zero();
  reduced::ReferenceBody reference = reduced::ReferenceBody::unit_ball();
};
template <class Body>
Body loaded_body(const materials::AnyLaw& law, const Loads& loads) {
  return {{law, loads.reference, {.gravity_constant = loads.G, .quadratic = loads.quadratic}}, loads.reference};
}
inline LoadedSl3 elastic_sl3(const Loads& loads) { return loaded_body<LoadedSl3>(Law{1, 0}, loads); }
inline LoadedSl3 fluid_sl3(const Loads& loads) { return loaded_body<LoadedSl3>(materials::Fluid{}, loads); }

/// A confining T without symmetry, with principal axes that are not the coordinate axes.
inline Matrix3d generic_quadratic() { return matrix({0.6, 0.1, 0, 0.1, 0.3, -0.15, 0, -0.15, 0.2}); }

/// A dead traction without symmetry.
inline Matrix3d generic_traction() { return matrix({0.4, 0.1, -0.2, 0.3, -0.1, 0.15, 0.05, -0.25, 0.2}); }

/// Every law of the table, each on SL(3) and GL⁺(3) (`none` has nothing that resists compression and is left out
/// there).
struct LawOfTable {
  std::string_view name;
  materials::AnyLaw law;
};
inline std::vector<LawOfTable> laws(bool incompressible) {
  std::vector<LawOfTable> result;
  for (const auto& law : materials::law_table)
    if (incompressible || law.name != "none")
      result.push_back({law.name, law.make({.lame_lambda = 3, .mooney_fraction = 0.3}, incompressible)});
  return result;
}

inline Matrix3d spheroid(double l) { return diagonal(1 / std::sqrt(l), 1 / std::sqrt(l), l); }
/// dV/dℓ along the spheroids.
template <class Body>
double spheroid_force(const Body& body, double l) {
  const double side_rate = -0.5 * std::pow(l, -1.5);
  return mechanics::dot(body.energy_density().gradient(spheroid(l)), diagonal(side_rate, side_rate, 1));
}
/// ℓ at rest near a guess, dV/dℓ = 0, by Newton's iteration with differences.
template <class Body>
double spheroid_at_rest(const Body& body, double l) {
  constexpr double d = 1e-4;
  for (int i = 0; i < 30; ++i)
    l -= spheroid_force(body, l) * 2 * d / (spheroid_force(body, l + d) - spheroid_force(body, l - d));
  return l;
}
/// Ω of the spheroid of that ℓ < 1 in steady rotation: V − ½Ω²·2m̄/ℓ does not change with ℓ.
template <class Body>
double steady_spin(const Body& body, double l) {
  return std::sqrt(-spheroid_force(body, l) * l * l / body.m_bar());
}
template <class Body>
State<Body> spinning_spheroid(const Body& body, double l) {
  return moving<Body>(spheroid(l), hat({0, 0, steady_spin(body, l)}) * spheroid(l));
}

}  // namespace pseudorigid::testing
