#pragma once
/// The cells of the ball in batches of as many as a SIMD vector has lanes, with all that the kernels read: node
/// numbers, geometry at the Gauss points and the L²-orthonormal basis ψ = L⁻¹(monomials) of P_{k−1}, LLᵀ = ∫monomials ⊗
/// monomials. The lanes of the last batch that have no cell of their own repeat its first one and are left out of
/// results.

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "continuum/ball_space.h"
#include "continuum/pressure_basis.h"
#include "continuum/quadrature_point.h"
#include "continuum/sum_factorization.h"
#include "materials/tensor.h"

namespace pseudorigid::continuum {

template <int degree>
class CellBatches {
 public:
  static constexpr int n_lanes = native_lanes, n = degree + 1, n_nodes = n * n * n, n_points = n_nodes;
  using L = Lanes<n_lanes>;
  using Point = QuadraturePoint;
  using Monomials = PressureMonomials<degree - 1>;
  static constexpr int n_pressure = Monomials::size;
  static constexpr int n_packed = n_pressure * (n_pressure + 1) / 2;

  struct Batch {
    unsigned int first_cell;
    int n_active;
    L center[3], scale;  ///< X = center + scale · position
    L cell_volume;
  };

  explicit CellBatches(const BallSpace& space) : factorization(space.reference_cell()) {
    for (unsigned int cell = 0; cell < space.n_cells(); cell += n_lanes) add_batch(space, cell);
  }

  const Point* points(std::size_t batch) const { return &points_[batch * n_points]; }
  const L* basis(std::size_t batch) const { return &basis_[batch * n_packed]; }

  /// u[c][node] of the batch from a vector.
  void gather(const Vector& x, std::size_t batch, L (*u)[n_nodes]) const {
    const double* values = x.begin();
    const auto* offsets = &offsets_[batch * n_nodes];
    for (int i = 0; i < n_nodes; ++i)
      for (int l = 0; l < n_lanes; ++l) {
        const double* node = values + offsets[i][l];
        for (int c = 0; c < 3; ++c) u[c][i].set(l, node[c]);
      }
  }

  void scatter_add(const L (*u)[n_nodes], std::size_t batch, Vector& f) const {
    double* values = f.begin();
    const auto* offsets = &offsets_[batch * n_nodes];
    const int n_active = batches[batch].n_active;
    for (int i = 0; i < n_nodes; ++i)
      for (int l = 0; l < n_active; ++l) {
        double* node = values + offsets[i][l];
        for (int c = 0; c < 3; ++c) node[c] += u[c][i][l];
      }
  }

  /// Coefficients of the monomials for λ_h = Σ λ_j ψ_j.
  void monomial_coefficients(const L* lambda, std::size_t batch, L* coefficients) const {
    const L* entry = basis(batch);
    for (int j = 0; j < n_pressure; ++j) coefficients[j] = L(0.0);
    for (int i = 0; i < n_pressure; ++i)
      for (int j = 0; j <= i; ++j) coefficients[j] += *entry++ * lambda[i];
  }

  /// ∫ψ_j s from the moments ∫(monomial) s.
  void from_moments(const L* moments, std::size_t batch, L* result) const {
    const L* entry = basis(batch);
    for (int i = 0; i < n_pressure; ++i) {
      L sum(0.0);
      for (int j = 0; j <= i; ++j) sum += *entry++ * moments[j];
      result[i] = sum;
    }
  }

  void load_multiplier(const Vector& lambda, std::size_t batch, L* values) const {
    const Batch& b = batches[batch];
    for (int l = 0; l < n_lanes; ++l) {
      const unsigned int cell = b.first_cell + (l < b.n_active ? l : 0);
      for (int j = 0; j < n_pressure; ++j) values[j].set(l, lambda.local_element(cell * n_pressure + j));
    }
  }

  void store_multiplier(const L* values, std::size_t batch, Vector& lambda) const {
    const Batch& b = batches[batch];
    for (int l = 0; l < b.n_active; ++l)
      for (int j = 0; j < n_pressure; ++j) lambda.local_element((b.first_cell + l) * n_pressure + j) = values[j][l];
  }

  std::size_t memory() const {
    return points_.size() * sizeof(Point) + offsets_.size() * sizeof(offsets_[0]) + basis_.size() * sizeof(L);
  }

  SumFactorization<n> factorization;
  std::vector<Batch> batches;

 private:
  void add_batch(const BallSpace& space, unsigned int first_cell) {
    Batch batch{};
    batch.first_cell = first_cell;
    batch.n_active = static_cast<int>(std::min<unsigned int>(n_lanes, space.n_cells() - first_cell));
    for (int i = 0; i < n_nodes; ++i) {
      auto& offsets = offsets_.emplace_back();
      for (int l = 0; l < n_lanes; ++l) offsets[l] = 3 * space.cell_nodes(first_cell + (l < batch.n_active ? l : 0))[i];
    }
    const std::size_t index = batches.size();
    batches.push_back(batch);
    compute_geometry(space, index);
    orthonormalize(index);
  }

  void compute_geometry(const BallSpace& space, std::size_t index) {
    std::vector<L> buffer(3 * n_nodes + 5 * n_points);
    auto* X = reinterpret_cast<L(*)[n_nodes]>(buffer.data());
    L *scratch = &buffer[3 * n_nodes], *values = scratch + n_points, *g = values + n_points;
    std::vector<Point> points(n_points);
    std::vector<std::array<L, 9>> jacobian(n_points);
    gather(space.reference_positions(), index, X);
    for (int c = 0; c < 3; ++c) {
      factorization.gradients(X[c], scratch, values, g, g + n_points, g + 2 * n_points);
      for (int q = 0; q < n_points; ++q) {
        points[q].position[c] = values[q];
        for (int d = 0; d < 3; ++d) jacobian[q][3 * c + d] = g[d * n_points + q];
      }
    }
    const ReferenceCell& ref = space.reference_cell();
    Batch& batch = batches[index];
    for (int q = 0; q < n_points; ++q) {
      materials::Tensor<L> T;
      for (int k = 0; k < 9; ++k) T(k / 3, k % 3) = jacobian[q][k];
      const auto cof = materials::cofactor(T);
      const L det = materials::determinant(T, cof);
      points[q].inverse_determinant = 1.0 / det;
      for (int k = 0; k < 9; ++k) points[q].inverse_jacobian[k] = cof(k % 3, k / 3) / det;
      points[q].weight = det * (ref.point_weights[q % n] * ref.point_weights[q / n % n] * ref.point_weights[q / n / n]);
      batch.cell_volume += points[q].weight;
      for (int c = 0; c < 3; ++c) batch.center[c] += points[q].weight * points[q].position[c];
    }
    for (int c = 0; c < 3; ++c) batch.center[c] = batch.center[c] / batch.cell_volume;
    for (int l = 0; l < n_lanes; ++l) batch.scale.set(l, 0.5 * std::cbrt(batch.cell_volume[l]));
    for (Point& point : points)
      for (int c = 0; c < 3; ++c) point.position[c] = (point.position[c] - batch.center[c]) / batch.scale;
    points_.insert(points_.end(), points.begin(), points.end());
  }

  /// basis = L⁻¹ of the Cholesky factor of the monomials' Gram matrix, packed by rows.
  void orthonormalize(std::size_t index) {
    std::vector<L> gram(n_pressure * n_pressure, L(0.0)), monomials(n_pressure),
        inverse(n_pressure * n_pressure, L(0.0));
    for (int q = 0; q < n_points; ++q) {
      const Point& p = points(index)[q];
      std::fill(monomials.begin(), monomials.end(), L(0.0));
      Monomials::add_moments(L(1.0), p.position[0], p.position[1], p.position[2], monomials.data());
      for (int i = 0; i < n_pressure; ++i)
        for (int j = 0; j <= i; ++j) gram[i * n_pressure + j] += p.weight * monomials[i] * monomials[j];
    }
    for (int l = 0; l < n_lanes; ++l) invert_cholesky_factor(gram, inverse, l);
    for (int i = 0; i < n_pressure; ++i)
      basis_.insert(basis_.end(), &inverse[i * n_pressure], &inverse[i * n_pressure] + i + 1);
  }

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

  std::vector<Point> points_;
  std::vector<std::array<unsigned int, n_lanes>> offsets_;
  std::vector<L> basis_;
};

}  // namespace pseudorigid::continuum
