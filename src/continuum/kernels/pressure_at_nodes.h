#pragma once
/// The basis ψ_j of the multiplier at the nodes X_i of the displacements. For displacements of degree k, the ψ_j are
/// polynomials of total degree k − 1 on each cell. Pictures show λ_h at these nodes. The tangent of the forces needs
/// λ_h at the Gauss points. The preconditioner of the Gram operator uses the nodes as quadrature points to project its
/// coarse functions onto ψ_j:
///
///   λ_h(X_i) = Σ_j λ_j ψ_j(X_i),   ψ(X) = L⁻¹ monomials((X − X_c)/h_c)
///
/// with the Cholesky factor L of the Gram matrix of the monomials (pressure_basis.h). X_c is the centre of mass of the
/// cell, and h_c is half the edge of a cube with the volume of the cell.

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "continuum/kernels/cell_batches.h"
#include "continuum/kernels/local_kernels.h"

namespace pseudorigid::continuum {

/// Returns (X − X_c)/h_c at the nodes of the cells of batch b: [component][node].
template <int degree, int n_lanes>
auto local_node_positions(const CellBatches<degree, n_lanes>& batches, std::size_t b) {
  using Batches = CellBatches<degree, n_lanes>;
  auto local = std::make_unique<typename Batches::L[][Batches::n_nodes]>(3);
  batches.gather(batches.reference_positions, b, local.get());
  const auto& batch = batches.batches[b];
  for (int c = 0; c < 3; ++c)
    for (int i = 0; i < Batches::n_nodes; ++i) local[c][i] = (local[c][i] - batch.center[c]) / batch.scale;
  return local;
}

/// Calls use(coefficients, b, lane) once, for the batch b and the lane that contain the cell. The coefficients are
/// those of λ_h with respect to the monomials, with one cell of the batch in each lane.
template <int degree, int n_lanes, class Use>
void with_multiplier_of_cell(const CellBatches<degree, n_lanes>& batches, const double* lambda, unsigned int cell,
                             const Use& use) {
  using Batches = CellBatches<degree, n_lanes>;
  const std::size_t b = cell / Batches::n_lanes;
  typename Batches::L multiplier[Batches::n_pressure], coefficients[Batches::n_pressure];
  batches.load_multiplier(lambda, b, multiplier);
  batches.monomial_coefficients(multiplier, b, coefficients);
  use(coefficients, b, static_cast<int>(cell % Batches::n_lanes));
}

/// Implementation of LocalKernels::multiplier_at_nodes.
template <int degree, int n_lanes>
void multiplier_at_nodes(const CellBatches<degree, n_lanes>& batches, const double* lambda, unsigned int cell,
                         std::span<double> values) {
  using Batches = CellBatches<degree, n_lanes>;
  with_multiplier_of_cell(batches, lambda, cell, [&](const auto& coefficients, std::size_t b, int lane) {
    const auto local = local_node_positions(batches, b);
    for (int i = 0; i < Batches::n_nodes; ++i)
      values[i] = Batches::Monomials::evaluate(coefficients, local[0][i], local[1][i], local[2][i])[lane];
  });
}

/// Implementation of LocalKernels::multiplier_at_points.
template <int degree, int n_lanes>
void multiplier_at_points(const CellBatches<degree, n_lanes>& batches, const double* lambda, unsigned int cell,
                          std::span<double> values) {
  using Batches = CellBatches<degree, n_lanes>;
  with_multiplier_of_cell(batches, lambda, cell, [&](const auto& coefficients, std::size_t b, int lane) {
    const auto* points = batches.pressure_points(b);
    for (int q = 0; q < Batches::n_points; ++q) {
      const auto* X = points[q].position;
      values[q] = Batches::Monomials::evaluate(coefficients, X[0], X[1], X[2])[lane];
    }
  });
}

/// Implementation of LocalKernels::pressure_basis_at_nodes.
template <int degree, int n_lanes>
void pressure_basis_at_nodes(const CellBatches<degree, n_lanes>& batches, const UseRows& use) {
  using Batches = CellBatches<degree, n_lanes>;
  using L = typename Batches::L;
  constexpr int n_nodes = Batches::n_nodes, n_pressure = Batches::n_pressure;
  constexpr std::size_t size = std::size_t{n_pressure} * n_nodes;
  std::vector<double> values(Batches::n_lanes * size);
  for (std::size_t b = 0; b < batches.batches.size(); ++b) {
    const auto& batch = batches.batches[b];
    const auto local = local_node_positions(batches, b);
    for (int i = 0; i < n_nodes; ++i) {
      L monomials[n_pressure], psi[n_pressure];
      for (L& monomial : monomials) monomial = L(0.0);
      Batches::Monomials::add_moments(L(1.0), local[0][i], local[1][i], local[2][i], monomials);
      batches.from_moments(monomials, b, psi);
      for (int l = 0; l < batch.n_active; ++l)
        for (int j = 0; j < n_pressure; ++j) values[l * size + j * n_nodes + i] = psi[j][l];
    }
    for (int l = 0; l < batch.n_active; ++l) use(batch.first_cell + l, {values.data() + l * size, size});
  }
}

}  // namespace pseudorigid::continuum
