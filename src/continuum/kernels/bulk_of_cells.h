#pragma once
/// The projected bulk term of the cells (stored_energy.h). With θ = Σ g_j ψ_j and the energy B of
/// materials/bulk_energy.h,
///
///   energy ∫B(θ) dX,   derivative b_j = ∫ψ_j B′(θ) dX.

#include <cmath>
#include <cstddef>

#include "continuum/kernels/cell_batches.h"
#include "materials/bulk_energy.h"

namespace pseudorigid::continuum {

/// e^x − 1 in every lane. Small x have Taylor's series, whose error is below the round-off.
template <int n_lanes, class L>
L exponential_minus_1(L x) {
  constexpr double small = 1.0 / 16;
  const L beyond = min(L(small * small) - x * x, L(0.0));
  if (!(beyond.sum(n_lanes) >= 0)) return L::of([&](int l) { return std::expm1(x[l]); });
  constexpr int n_terms = 9;
  L sum(1.0);
  for (int n = n_terms; n > 1; --n) sum = L(1.0) + sum * x * L(1.0 / n);
  return sum * x;
}

/// Implementation of LocalKernels::bulk: sets b, and returns the energy of the cells of this rank.
template <int degree, int n_lanes>
double bulk_of_cells(const CellBatches<degree, n_lanes>& batches, const materials::BulkEnergy& bulk, const double* g,
                     double* b) {
  using Batches = CellBatches<degree, n_lanes>;
  using L = typename Batches::L;
  double energy = 0;
  for (std::size_t batch = 0; batch < batches.batches.size(); ++batch) {
    L values[Batches::n_pressure], coefficients[Batches::n_pressure], moments[Batches::n_pressure], of_batch(0.0);
    batches.load_multiplier(g, batch, values);
    batches.monomial_coefficients(values, batch, coefficients);
    for (L& moment : moments) moment = L(0.0);
    const auto* points = batches.pressure_points(batch);
    for (int q = 0; q < Batches::n_points; ++q) {
      const auto& [weight, X] = points[q];
      const L theta = Batches::Monomials::evaluate(coefficients, X[0], X[1], X[2]);
      const L excess = exponential_minus_1<n_lanes>(L(2.0) * theta);
      of_batch += weight * bulk.energy(theta, excess);
      Batches::Monomials::add_moments(weight * bulk.rate_of(excess), X[0], X[1], X[2], moments);
    }
    batches.from_moments(moments, batch, values);
    batches.store_multiplier(values, batch, b);
    energy += of_batch.sum(batches.batches[batch].n_active);
  }
  return energy;
}

}  // namespace pseudorigid::continuum
