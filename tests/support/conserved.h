#pragma once
/// What a conserving method must keep: energy, momenta ⟨M v, ξ_i(q)⟩, g and G v.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "mechanics/core/conservative_system.h"
#include "support/runs.h"

namespace pseudorigid::testing {

template <mechanics::ConservativeSystem S>
double energy(const S& system, const mechanics::State<S>& s) {
  return system.kinetic_energy(s.v) + system.potential_energy(s.q);
}

template <mechanics::ConservativeSystem S>
std::vector<double> momenta(const S& system, const mechanics::State<S>& s) {
  std::vector<double> result;
  auto dq = system.make_vector(), dv = dq, p = dq;
  system.apply_mass(s.v, p);
  for (int i = 0; i < system.n_symmetries(); ++i) {
    system.symmetry(i, s.q, s.v, dq, dv);
    result.push_back(mechanics::dot(p, dq));
  }
  return result;
}

/// Largest departures along a run: energy relative to |E| + K at the start, momenta relative to |p||q|, |g|, |G v|.
struct Departures {
  double energy = 0, momenta = 0, constraint = 0, constraint_rate = 0;
};

template <mechanics::ConservativeSystem S>
Departures departures(const S& system, const std::vector<mechanics::State<S>>& states) {
  Departures d;
  const auto& start = states.front();
  const double E = energy(system, start), E_scale = std::abs(E) + system.kinetic_energy(start.v);
  const auto J = momenta(system, start);
  auto p = system.make_vector();
  system.apply_mass(start.v, p);
  const double J_scale = std::sqrt(mechanics::dot(p, p) * mechanics::dot(start.q, start.q));
  for (const auto& s : states) {
    d.energy = std::max(d.energy, std::abs(energy(system, s) - E) / E_scale);
    const auto J_now = momenta(system, s);
    for (std::size_t i = 0; i < J.size(); ++i) d.momenta = std::max(d.momenta, std::abs(J_now[i] - J[i]) / J_scale);
    if constexpr (!mechanics::unconstrained<S>) {
      auto r = system.make_multiplier();
      EXPECT_TRUE(system.constraint(s.q, r));
      d.constraint = std::max(d.constraint, mechanics::max_norm(r));
      system.constraint_rate(s.q, s.v, r);
      d.constraint_rate = std::max(d.constraint_rate, mechanics::max_norm(r));
    }
  }
  return d;
}

/// A run of n steps of size h keeps everything to the bounds that the method promises at any step.
template <class Method, mechanics::ConservativeSystem S>
void expect_everything_kept(const S& system, const mechanics::State<S>& start, double h, long n_steps) {
  const auto r = run<Method>(system, start, h * static_cast<double>(n_steps), n_steps, 1);
  ASSERT_TRUE(r.finished()) << r.result.reason << " (h = " << h << ")";
  const Departures d = departures(system, r.states);
  EXPECT_LT(d.energy, 1e-13) << "h = " << h;
  EXPECT_LT(d.momenta, 1e-13) << "h = " << h;
  EXPECT_LT(d.constraint, 1e-14) << "h = " << h;
  EXPECT_LT(d.constraint_rate, 1e-13) << "h = " << h;
}

}  // namespace pseudorigid::testing
