#pragma once
/// What must hold of any ConservativeSystem at any state, on the constraints or off them:
///
///   f = −dV,   M⁻¹M = 1,   K = ½⟨v, Mv⟩,   G = Dg,   D²g(v, v) = D(Gv)v,   ⟨Gᵀλ, v⟩ = ⟨λ, Gv⟩,   D(Gᵀλ)v,
///   G(q₁)M⁻¹G(q₀)ᵀλ = r,   dV(ξ) = 0,   ⟨Mv, ξ̇(v)⟩ = 0,   Gξ = 0.
///
/// Derivatives are central differences of order 4 with the step 1e-3, so their error is about 1e-12 in units of
/// order 1.

#include <gtest/gtest.h>

#include <functional>

#include "mechanics/methods/energy_momentum.h"

namespace pseudorigid::testing {

/// d/ds u(s) at s = 0, for numbers and vectors.
template <class Function>
auto derivative(const Function& u) {
  constexpr double d = 1e-3;
  auto sum = u(d);
  sum = (8 * (u(d) - u(-d)) - (u(2 * d) - u(-2 * d))) / (12 * d);
  return sum;
}

inline constexpr double difference_tolerance = 1e-10;

template <class S>
typename S::Vector moved(const S&, typename S::Vector q, double s, const typename S::Vector& v) {
  mechanics::axpy(s, v, q);
  return q;
}

template <mechanics::ConservativeSystem S>
void expect_energies_and_force_agree(const S& system, const typename S::Vector& q, const typename S::Vector& v) {
  auto w = system.make_workspace();
  auto f = system.make_vector(), p = f, back = f;
  ASSERT_TRUE(system.force(0, q, system.make_vector(), w, f));
  const double slope = derivative([&](double s) { return system.potential_energy(moved(system, q, s, v)); });
  EXPECT_NEAR(mechanics::dot(f, v), -slope, difference_tolerance);

  system.apply_mass(v, p);
  EXPECT_NEAR(system.kinetic_energy(v), 0.5 * mechanics::dot(v, p), 1e-13);
  system.apply_inverse_mass(p, back);
  mechanics::axpy(-1.0, v, back);
  EXPECT_LT(mechanics::max_norm(back), 1e-13);
}

template <mechanics::ConservativeSystem S>
void expect_constraint_derivatives_agree(const S& system, const typename S::Vector& q, const typename S::Vector& v,
                                         const typename S::Multiplier& lambda) {
  auto g = system.make_multiplier(), rate = g, curvature = g;
  const auto g_at = [&](double s) {
    EXPECT_TRUE(system.constraint(moved(system, q, s, v), g));
    return g;
  };
  const auto rate_at = [&](double s) {
    system.constraint_rate(moved(system, q, s, v), v, rate);
    return rate;
  };
  const auto reaction_at = [&](double s) {
    auto f = system.make_vector();
    system.add_reaction(moved(system, q, s, v), lambda, f);
    return f;
  };
  system.constraint_rate(q, v, rate);
  EXPECT_LT(mechanics::max_norm(decltype(g)(derivative(g_at) - rate)), difference_tolerance);
  EXPECT_NEAR(mechanics::dot(reaction_at(0), v), mechanics::detail::pairing(lambda, rate), 1e-13);
  system.constraint_curvature(q, v, curvature);
  EXPECT_LT(mechanics::max_norm(decltype(g)(derivative(rate_at) - curvature)), difference_tolerance);
  auto reaction_rate = system.make_vector();
  system.add_reaction_rate(q, v, lambda, reaction_rate);
  EXPECT_LT(mechanics::max_norm(typename S::Vector(derivative(reaction_at) - reaction_rate)), difference_tolerance);
}

/// r = G(q₁)M⁻¹G(q₀)ᵀλ comes back as λ.
template <mechanics::ConservativeSystem S>
void expect_gram_solve_is_exact(const S& system, const typename S::Vector& q1, const typename S::Vector& q0,
                                const typename S::Multiplier& lambda) {
  auto f = system.make_vector();
  auto r = system.make_multiplier(), solved = r;
  auto w = system.make_workspace();
  system.add_reaction(q0, lambda, f);
  system.apply_inverse_mass(f, f);
  system.constraint_rate(q1, f, r);
  ASSERT_TRUE(system.solve_gram(q1, q0, r, w, solved).status);
  EXPECT_LT(mechanics::max_norm(typename S::Multiplier(solved - lambda)), 1e-13);
}

template <mechanics::ConservativeSystem S>
void expect_symmetries_hold(const S& system, const typename S::Vector& q, const typename S::Vector& v) {
  auto dq = system.make_vector(), dv = dq, p = dq;
  system.apply_mass(v, p);
  for (int i = 0; i < system.n_symmetries(); ++i) {
    system.symmetry(i, q, v, dq, dv);
    EXPECT_GT(mechanics::max_norm(dq), 1e-3) << "a symmetry that does nothing";
    EXPECT_NEAR(derivative([&](double s) { return system.potential_energy(moved(system, q, s, dq)); }), 0,
                difference_tolerance);
    EXPECT_NEAR(mechanics::dot(p, dv), 0, 1e-13);
    if constexpr (!mechanics::unconstrained<S>) {
      auto rate = system.make_multiplier();
      system.constraint_rate(q, dq, rate);
      EXPECT_LT(mechanics::max_norm(rate), 1e-13);
    }
  }
}

}  // namespace pseudorigid::testing
