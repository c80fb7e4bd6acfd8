#pragma once
/// The reaction of a multiplier λ, and its rate along a velocity v. With H = ∂x/∂ξ and the weights w of
/// cell_kernels_impl.h, the sums over the points are
///
///   (Gᵀλ)_n = Σ w λ_h H⁻ᵀ : ∂φ_n/∂ξ,   Σ_j λ_j D²g_j(v, ·)_n = −Σ w λ_h H⁻ᵀ (∂v/∂ξ)ᵀ H⁻ᵀ : ∂φ_n/∂ξ.

#include <cstddef>

#include "continuum/kernels/cell_planes.h"

namespace pseudorigid::continuum {

/// f ← f + Σ T : ∂φ/∂ξ with T = tensor_of(w λ_h, cof H, det H, point of the plane). The function calls at_plane(batch,
/// plane) before the points of each plane.
template <int degree, int n_lanes, class AtPlane, class TensorOf>
void add_pressure_stress(const CellPlanes<degree, n_lanes>& planes, const double* x, const double* lambda, double* f,
                         const AtPlane& at_plane, const TensorOf& tensor_of) {
  using Planes = CellPlanes<degree, n_lanes>;
  using Batches = typename Planes::Batches;
  using L = typename Planes::L;
  constexpr int n = Batches::n, plane = n * n;
  const Batches& batches = planes.batches;
  auto& buffers = planes.buffers();
  for (std::size_t b = 0; b < batches.batches.size(); ++b) {
    planes.load_layers(x, b, buffers.x);
    batches.load_multiplier(lambda, b, buffers.multiplier);
    L coefficients[Batches::n_pressure];
    batches.monomial_coefficients(buffers.multiplier, b, coefficients);
    for (int q3 = 0; q3 < n; ++q3) {
      at_plane(b, q3);
      planes.plane_gradient(buffers.x, q3, buffers.H);
      const auto* points = batches.pressure_points(b) + q3 * plane;
      for (int q = 0; q < plane; ++q) {
        const auto& p = points[q];
        prefetch(points + plane + q);
        const L pressure = Batches::Monomials::evaluate(coefficients, p.position[0], p.position[1], p.position[2]);
        const auto H = Planes::load(buffers.H, q), cof = materials::cofactor(H);
        Planes::store(tensor_of(p.weight * pressure, cof, materials::determinant(H, cof), q), q, buffers.H);
      }
      planes.integrate_plane(buffers.H, q3);
    }
    planes.distribute_layers();
    batches.scatter_add(buffers.result, b, f);
  }
}

/// Implementation of LocalKernels::add_reaction.
template <int degree, int n_lanes>
void add_reaction_of_cells(const CellPlanes<degree, n_lanes>& planes, const double* x, const double* lambda,
                           double* f) {
  add_pressure_stress(
      planes, x, lambda, f, [](std::size_t, int) {},
      [](const auto& pressure, const auto& cof, const auto& det, int) { return pressure / det * cof; });
}

/// Implementation of LocalKernels::add_reaction_rate.
template <int degree, int n_lanes>
void add_reaction_rate_of_cells(const CellPlanes<degree, n_lanes>& planes, const double* x, const double* v,
                                const double* lambda, double* f) {
  using Planes = CellPlanes<degree, n_lanes>;
  using Tensor = typename Planes::Tensor;
  using L = typename Planes::L;
  auto& buffers = planes.buffers();
  const auto at_plane = [&](std::size_t b, int q3) {
    if (q3 == 0) planes.load_layers(v, b, buffers.v);
    planes.plane_gradient(buffers.v, q3, buffers.dv);
  };
  add_pressure_stress(planes, x, lambda, f, at_plane, [&](const L& pressure, const Tensor& cof, const L& det, int q) {
    const Tensor dv = Planes::load(buffers.dv, q);
    Tensor A, T;  // cof (∂v/∂ξ)ᵀ, and the result
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) A(i, k) = cof(i, 0) * dv(k, 0) + cof(i, 1) * dv(k, 1) + cof(i, 2) * dv(k, 2);
    const L s = -pressure / (det * det);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) T(i, j) = s * (A(i, 0) * cof(0, j) + A(i, 1) * cof(1, j) + A(i, 2) * cof(2, j));
    return T;
  });
}

}  // namespace pseudorigid::continuum
