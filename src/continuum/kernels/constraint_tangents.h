#pragma once
/// The derivative G of the constraint at fixed positions x, for many products. A tangent stores T_q = w H⁻ᵀ at every
/// Gauss point q, with H = ∂x/∂ξ. The number w is the quadrature weight times det ∂X/∂ξ. The numbers have double or
/// single precision. In single precision, a tangent needs half the memory. The ψ_j are the basis of the multipliers,
/// the φ_n are the basis of the displacements, and λ_h = Σ λ_j ψ_j. The products with a velocity v and a multiplier λ
/// are
///
///   (G v)_j = Σ_q ψ_j T_q : ∂v/∂ξ,   (Gᵀλ)_n = Σ_q λ_h T_q : ∂φ_n/∂ξ

#include <type_traits>
#include <vector>

#include "continuum/kernels/cell_planes.h"
#include "continuum/kernels/local_kernels.h"
#include "continuum/kernels/single_lanes.h"
#include "mechanics/core/huge_pages.h"

namespace pseudorigid::continuum {

template <int degree, int n_lanes>
class ConstraintTangents {
  using Planes = CellPlanes<degree, n_lanes>;
  using Batches = typename Planes::Batches;
  using L = typename Planes::L;
  using Single = SingleLanes<n_lanes>;
  using Tensor = typename Planes::Tensor;
  using Field = typename Planes::Field;
  static constexpr int n = Planes::n, plane = Planes::plane, n_pressure = Planes::n_pressure;

 public:
  explicit ConstraintTangents(const Planes& planes) : planes_(planes) {}

  std::unique_ptr<ConstraintTangent> make(Precision precision) const {
    const std::size_t n_planes = planes_.n_batches() * n;
    if (precision == Precision::single_precision) return std::make_unique<Tangent<Single>>(precision, n_planes);
    return std::make_unique<Tangent<L>>(precision, n_planes);
  }
  void set(const double* x, ConstraintTangent& tangent) const {
    of_its_precision(tangent, [&](auto& stored) { set_planes(x, stored); });
  }
  void rate(const ConstraintTangent& at_x, const double* v, double* r) const {
    of_its_precision(at_x, [&](const auto& stored) { rate_by_planes(stored, v, r); });
  }
  void add_reaction(const ConstraintTangent& at_x, const double* lambda, double* f) const {
    of_its_precision(at_x, [&](const auto& stored) { add_reaction_by_planes(stored, lambda, f); });
  }

  /// Calls use(cell, rows) with the entries of G at x for the multipliers of each cell. For n nodes in a cell,
  /// rows[j·3n + 3i + c] belongs to ψ_j, node i and component c.
  void rows(const double* x, const UseRows& use) const {
    constexpr std::size_t n_nodes = Planes::n_nodes, size = n_pressure * 3 * n_nodes;
    std::vector<double> values(n_lanes * size);
    Stored<L> planes(n);
    auto& buffers = planes_.buffers();
    for (std::size_t b = 0; b < planes_.n_batches(); ++b) {
      set_batch(x, b, planes.data());
      const auto& batch = planes_.batches.batches[b];
      for (int j = 0; j < n_pressure; ++j) {
        for (int i = 0; i < n_pressure; ++i) buffers.multiplier[i] = L(i == j ? 1.0 : 0.0);
        react(b, planes.data());
        for (int l = 0; l < batch.n_active; ++l)
          for (std::size_t i = 0; i < n_nodes; ++i)
            for (int c = 0; c < 3; ++c) values[l * size + (j * n_nodes + i) * 3 + c] = buffers.result[c][i][l];
      }
      for (int l = 0; l < batch.n_active; ++l) use(batch.first_cell + l, {values.data() + l * size, size});
    }
  }

  /// Returns the stored tensors w H⁻ᵀ at the points of the plane q3 of batch b, which the caller can set. The tangent
  /// must have double precision.
  Field& plane_of(ConstraintTangent& tangent, std::size_t b, int q3) const {
    return static_cast<Tangent<L>&>(tangent).planes[b * n + static_cast<std::size_t>(q3)].T;
  }
  /// T ← w H⁻ᵀ at the points of the plane q3 of batch b, from H at these points.
  template <class Number>
  void set_plane(std::size_t b, int q3, const Field& H_of_plane, Number (&T)[9][plane]) const {
    const auto* points = planes_.batches.pressure_points(b) + q3 * plane;
    for (int q = 0; q < plane; ++q) {
      const Tensor H = Planes::load(H_of_plane, q), cof = materials::cofactor(H);
      const L factor = points[q].weight / materials::determinant(H, cof);
#pragma GCC unroll 9
      for (int k = 0; k < 9; ++k) T[k][q] = factor * cof.a[k / 3][k % 3];
    }
  }
  /// sum ← sum + λ_h T at the points of the plane q3 of batch b. `coefficients` are those of λ_h with respect to the
  /// monomials.
  void add_pressure(std::size_t b, int q3, const L (&coefficients)[n_pressure], const Field& T, Field& sum) const {
    const auto* points = planes_.batches.pressure_points(b) + q3 * plane;
    for (int q = 0; q < plane; ++q) {
      const L* X = points[q].position;
      const L pressure = Batches::Monomials::evaluate(coefficients, X[0], X[1], X[2]);
#pragma GCC unroll 9
      for (int k = 0; k < 9; ++k) sum[k][q] += pressure * T[k][q];
    }
  }

 private:
  /// w H⁻ᵀ at the points of one plane: [3·row + column][point]. Number is L or Single.
  template <class Number>
  struct PlaneOfPoints {
    Number T[9][plane];
  };
  template <class Number>
  using Stored = mechanics::HugePageVector<PlaneOfPoints<Number>>;
  template <class Number>
  struct Tangent final : ConstraintTangent {
    Tangent(Precision precision, std::size_t n_planes) : ConstraintTangent(precision), planes(n_planes) {}
    Stored<Number> planes;
  };

  /// Calls use(planes) with the planes of the tangent in the precision in which they are stored.
  template <class AnyTangent, class Use>
  static void of_its_precision(AnyTangent& tangent, const Use& use) {
    const auto use_as = [&]<class Number>(Number) {
      using Own = std::conditional_t<std::is_const_v<AnyTangent>, const Tangent<Number>, Tangent<Number>>;
      use(static_cast<Own&>(tangent).planes);
    };
    tangent.precision() == Precision::single_precision ? use_as(Single()) : use_as(L());
  }

  template <class Number>
  void set_planes(const double* x, Stored<Number>& stored) const {
    for (std::size_t b = 0; b < planes_.n_batches(); ++b) set_batch(x, b, &stored[b * n]);
  }

  /// Computes w H⁻ᵀ at the points of all planes of one batch.
  template <class Number>
  void set_batch(const double* x, std::size_t b, PlaneOfPoints<Number>* planes) const {
    auto& buffers = planes_.buffers();
    planes_.load_layers(x, b, buffers.x);
    for (int q3 = 0; q3 < n; ++q3) {
      planes_.plane_gradient(buffers.x, q3, buffers.H);
      set_plane(b, q3, buffers.H, planes[q3].T);
    }
  }

  template <class Number>
  void rate_by_planes(const Stored<Number>& stored, const double* v, double* r) const {
    auto& buffers = planes_.buffers();
    for (std::size_t b = 0; b < planes_.n_batches(); ++b) {
      const PlaneOfPoints<Number>* planes = &stored[b * n];
      planes_.load_layers(v, b, buffers.v);
      L moments[n_pressure];
      for (L& m : moments) m = L(0.0);
      for (int q3 = 0; q3 < n; ++q3) {
        planes_.plane_gradient(buffers.v, q3, buffers.dv);
        planes_.batches.prefetch_layer(v, b, q3);
        const auto* points = planes_.batches.pressure_points(b) + q3 * plane;
        for (int q = 0; q < plane; ++q) {
          prefetch(points + plane + q);
          prefetch_part<9 * sizeof(Number)>(planes + q3 + 1, q);
          const L* X = points[q].position;
          Batches::Monomials::add_moments(dot(Planes::load(planes[q3].T, q), Planes::load(buffers.dv, q)), X[0], X[1],
                                          X[2], moments);
        }
      }
      planes_.store_moments(moments, b, r);
    }
  }

  template <class Number>
  void add_reaction_by_planes(const Stored<Number>& stored, const double* lambda, double* f) const {
    auto& buffers = planes_.buffers();
    for (std::size_t b = 0; b < planes_.n_batches(); ++b) {
      planes_.batches.load_multiplier(lambda, b, buffers.multiplier);
      react(b, &stored[b * n]);
      planes_.batches.scatter_add(buffers.result, b, f);
    }
  }

  /// Sets buffers.result to the contribution of batch b to Gᵀλ, with λ in buffers.multiplier.
  template <class Number>
  void react(std::size_t b, const PlaneOfPoints<Number>* planes) const {
    auto& buffers = planes_.buffers();
    L coefficients[n_pressure];
    planes_.batches.monomial_coefficients(buffers.multiplier, b, coefficients);
    auto& T = buffers.H;
    for (int q3 = 0; q3 < n; ++q3) {
      const auto* points = planes_.batches.pressure_points(b) + q3 * plane;
      for (int q = 0; q < plane; ++q) {
        prefetch(points + plane + q);
        prefetch_part<9 * sizeof(Number)>(planes + q3 + 1, q);
        const L* X = points[q].position;
        const L pressure = Batches::Monomials::evaluate(coefficients, X[0], X[1], X[2]);
#pragma GCC unroll 9
        for (int k = 0; k < 9; ++k) T[k][q] = pressure * L(planes[q3].T[k][q]);
      }
      planes_.integrate_plane(T, q3);
    }
    planes_.distribute_layers();
  }

  const Planes& planes_;
};

}  // namespace pseudorigid::continuum
