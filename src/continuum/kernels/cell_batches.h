#pragma once
/// Batches of cells of the ball, with one cell in each lane of a SIMD vector, and the data of the batches that the
/// kernels read. The data are the node numbers, and the weights and positions of the Gauss points for the constraint.
/// For elements of degree k, the data also contain the basis ψ of P_{k−1}, which is orthonormal in L². With the vector
/// m of the monomials (pressure_basis.h) and the Cholesky factor L of ∫m ⊗ m = LLᵀ, the basis is ψ = L⁻¹ m. If the last
/// batch has fewer cells than lanes, the remaining lanes repeat its first cell, and their results are not used.

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "continuum/kernels/local_kernels.h"
#include "continuum/kernels/pressure_basis.h"
#include "continuum/kernels/quadrature_point.h"
#include "continuum/kernels/sum_factorization.h"
#include "materials/tensor.h"
#include "mechanics/core/huge_pages.h"

namespace pseudorigid::continuum {

template <int degree, int lanes>
class CellBatches {
 public:
  static constexpr int n_lanes = lanes, n = degree + 1, n_nodes = n * n * n, n_points = n_nodes;
  using L = Lanes<n_lanes>;
  using PressurePoint = continuum::PressurePoint<n_lanes>;
  using Monomials = PressureMonomials<degree - 1>;
  static constexpr int n_pressure = Monomials::size;
  static constexpr int n_packed = n_pressure * (n_pressure + 1) / 2;

  struct Batch {
    unsigned int first_cell;
    int n_active;        ///< number of lanes that do not repeat the first cell
    L center[3], scale;  ///< X = center + scale · PressurePoint::position
    L cell_volume;
  };

  explicit CellBatches(const LocalCells& cells) : factorization(cells.reference), reference_positions(cells.positions) {
    const auto& w = cells.reference.point_weights;
    for (int q = 0; q < n_points; ++q) unit_weights[q] = w[q % n] * w[q / n % n] * w[q / n / n];
    const std::size_t n_batches = (cells.nodes.size() + n_lanes - 1) / n_lanes;
    pressure_points_.reserve(n_batches * n_points);  // avoids unused memory of a growing vector
    offsets_.reserve(n_batches * n_nodes);
    basis_.reserve(n_batches * n_packed);
    batches.reserve(n_batches);
    for (unsigned int cell = 0; cell < cells.nodes.size(); cell += n_lanes) add_batch(cells, cell);
  }

  const PressurePoint* pressure_points(std::size_t batch) const { return &pressure_points_[batch * n_points]; }
  const L* basis(std::size_t batch) const { return &basis_[batch * n_packed]; }

  /// Sets u[c][node] to component c of the vector x at the nodes of the batch.
  void gather(const double* x, std::size_t batch, L (*u)[n_nodes]) const {
    const auto* offsets = &offsets_[batch * n_nodes];
    for (int i = 0; i < n_nodes; ++i) L::load_triples(x, offsets[i].data(), u[0][i], u[1][i], u[2][i]);
  }

  /// Prefetches the entries of x at one layer of nodes of the next batch, if there is a next batch. A layer has the n²
  /// nodes with the index `layer` in the third local direction.
  void prefetch_layer(const double* x, std::size_t batch, int layer) const {
    if (batch + 1 == batches.size()) return;
    const auto* offsets = &offsets_[(batch + 1) * n_nodes + layer * n * n];
    for (int i = 0; i < n * n; ++i)
      for (int l = 0; l < n_lanes; ++l) __builtin_prefetch(x + offsets[i][l]);
  }

  /// f ← f + u for the nodal values u of the cells of the batch. Lanes that repeat the first cell are skipped.
  void scatter_add(const L (*u)[n_nodes], std::size_t batch, double* f) const {
    const auto* offsets = &offsets_[batch * n_nodes];
    const int n_active = batches[batch].n_active;
    for (int i = 0; i < n_nodes; ++i) L::add_triples(u[0][i], u[1][i], u[2][i], n_active, f, offsets[i].data());
  }

  /// Sets `coefficients` to the coefficients of λ_h = Σ λ_j ψ_j with respect to the monomials.
  void monomial_coefficients(const L* lambda, std::size_t batch, L* coefficients) const {
    const L* entry = basis(batch);
    for (int j = 0; j < n_pressure; ++j) coefficients[j] = L(0.0);
    for (int i = 0; i < n_pressure; ++i)
      for (int j = 0; j <= i; ++j) coefficients[j] += *entry++ * lambda[i];
  }

  /// Sets `result` to the integrals ∫ψ_j s of a function s. `moments` contains the integrals of s times each monomial.
  void from_moments(const L* moments, std::size_t batch, L* result) const {
    const L* entry = basis(batch);
    for (int i = 0; i < n_pressure; ++i) {
      L sum(0.0);
      for (int j = 0; j <= i; ++j) sum += *entry++ * moments[j];
      result[i] = sum;
    }
  }

  /// Sets `values` to the multipliers of the cells of the batch. Lanes that repeat the first cell get its multipliers.
  void load_multiplier(const double* lambda, std::size_t batch, L* values) const {
    const Batch& b = batches[batch];
    const double* entries = lambda + b.first_cell * n_pressure;
    for (int j = 0; j < n_pressure; ++j)
      values[j] = L::of([&](int l) { return entries[(l < b.n_active ? l : 0) * n_pressure + j]; });
  }

  /// Sets the multipliers of the cells of the batch in `lambda` to `values`. Lanes that repeat the first cell are
  /// skipped.
  void store_multiplier(const L* values, std::size_t batch, double* lambda) const {
    const Batch& b = batches[batch];
    for (int l = 0; l < b.n_active; ++l)
      for (int j = 0; j < n_pressure; ++j) lambda[(b.first_cell + l) * n_pressure + j] = values[j][l];
  }

  std::size_t memory() const {
    return pressure_points_.size() * sizeof(PressurePoint) + offsets_.size() * sizeof(offsets_[0]) +
           basis_.size() * sizeof(L) + batches.size() * sizeof(Batch);
  }

  SumFactorization<n> factorization;
  std::array<double, n_points> unit_weights;  ///< quadrature weights on the reference cell
  const double* reference_positions;          ///< X of own and ghost nodes, entry 3·node + component
  mechanics::HugePageVector<Batch> batches;

 private:
  void add_batch(const LocalCells& cells, unsigned int first_cell) {
    Batch batch{};
    batch.first_cell = first_cell;
    batch.n_active = static_cast<int>(std::min<std::size_t>(n_lanes, cells.nodes.size() - first_cell));
    for (int i = 0; i < n_nodes; ++i) {
      auto& offsets = offsets_.emplace_back();
      for (int l = 0; l < n_lanes; ++l) offsets[l] = 3 * cells.nodes[first_cell + (l < batch.n_active ? l : 0)][i];
    }
    const std::size_t index = batches.size();
    batches.push_back(batch);
    compute_geometry(index);
    orthonormalize(index);
  }

  /// Computes the weights and local coordinates of the points, and the volume, the centre and the scale of each cell of
  /// a batch. The scale is half the edge of a cube with the volume of the cell.
  void compute_geometry(std::size_t index) {
    auto nodes = std::make_unique<L[][n_nodes]>(3);
    gather(reference_positions, index, nodes.get());
    for (int c = 0; c < 3; ++c) factorization.interpolate_layers(nodes[c]);

    Batch& batch = batches[index];
    for (int q3 = 0; q3 < n; ++q3) {
      L X[3][n * n], jacobian[9][n * n];
      for (int c = 0; c < 3; ++c)
        factorization.plane_gradient(nodes[c], q3, X[c], jacobian[3 * c], jacobian[3 * c + 1], jacobian[3 * c + 2]);
      for (int q = 0; q < n * n; ++q) {
        materials::Tensor<L> T;
        for (int k = 0; k < 9; ++k) T(k / 3, k % 3) = jacobian[k][q];
        const L weight = materials::determinant(T) * unit_weights[q3 * n * n + q];
        pressure_points_.push_back({weight, {X[0][q], X[1][q], X[2][q]}});
        batch.cell_volume += weight;
        for (int c = 0; c < 3; ++c) batch.center[c] += weight * X[c][q];
      }
    }
    for (int c = 0; c < 3; ++c) batch.center[c] = batch.center[c] / batch.cell_volume;
    batch.scale = L::of([&](int l) { return 0.5 * std::cbrt(batch.cell_volume[l]); });
    for (auto point = pressure_points_.end() - n_points; point != pressure_points_.end(); ++point)
      for (int c = 0; c < 3; ++c) point->position[c] = (point->position[c] - batch.center[c]) / batch.scale;
  }

  /// Computes L⁻¹, with the Cholesky factor L of the Gram matrix of the monomials. Appends the lower triangle of L⁻¹ to
  /// the basis, row by row.
  void orthonormalize(std::size_t index) {
    std::vector<L> gram(n_pressure * n_pressure, L(0.0)), monomials(n_pressure),
        inverse(n_pressure * n_pressure, L(0.0));
    for (int q = 0; q < n_points; ++q) {
      const PressurePoint& p = pressure_points(index)[q];
      std::fill(monomials.begin(), monomials.end(), L(0.0));
      Monomials::add_moments(L(1.0), p.position[0], p.position[1], p.position[2], monomials.data());
      for (int i = 0; i < n_pressure; ++i)
        for (int j = 0; j <= i; ++j) gram[i * n_pressure + j] += p.weight * monomials[i] * monomials[j];
    }
    for (int l = 0; l < n_lanes; ++l) invert_cholesky_factor(gram, inverse, l);
    for (int i = 0; i < n_pressure; ++i)
      basis_.insert(basis_.end(), &inverse[i * n_pressure], &inverse[i * n_pressure] + i + 1);
  }

  /// Sets one lane of `inverse` to L⁻¹. Replaces the matrix in this lane of `a` by its Cholesky factor L.
  static void invert_cholesky_factor(std::vector<L>& a, std::vector<L>& inverse, int lane) {
    const auto at = [&](int i, int j) { return a[i * n_pressure + j][lane]; };
    for (int i = 0; i < n_pressure; ++i)
      for (int j = 0; j <= i; ++j) {
        double sum = at(i, j);
        for (int k = 0; k < j; ++k) sum -= at(i, k) * at(j, k);
        a[i * n_pressure + j].set(lane, i == j ? std::sqrt(sum) : sum / at(j, j));
      }
    for (int j = 0; j < n_pressure; ++j)
      for (int i = j; i < n_pressure; ++i) {
        double sum = i == j ? 1 : 0;
        for (int k = j; k < i; ++k) sum -= at(i, k) * inverse[k * n_pressure + j][lane];
        inverse[i * n_pressure + j].set(lane, sum / at(i, i));
      }
  }

  mechanics::HugePageVector<PressurePoint> pressure_points_;
  /// [batch · n_nodes + node][lane]: index of the node's first component in vectors.
  mechanics::HugePageVector<std::array<unsigned int, n_lanes>> offsets_;
  mechanics::HugePageVector<L> basis_;  ///< the lower triangles of L⁻¹ of all batches, row by row
};

}  // namespace pseudorigid::continuum
