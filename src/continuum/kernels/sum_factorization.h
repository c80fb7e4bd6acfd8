#pragma once
/// Sum factorisation on one batch of cells. The class maps values u at the n³ nodes to gradients with respect to ξ at
/// the n³ Gauss points. It also has the transposed map. The first direction is the fastest index, and factor d of a
/// product ⊗ acts on direction d. With the one-dimensional interpolation I to the points and differentiation D at the
/// points,
///
///   u ← (I⊗I⊗1) u   layer by layer,   then for each plane ξ₃ = const of n² points
///   v = (1⊗1⊗I) u,   ∂₁v = (D⊗1) v,   ∂₂v = (1⊗D) v,   ∂₃v = (1⊗1⊗DI) u
///
/// The operations at the points of a plane follow at once, while the plane is in the first-level cache. Nodes and
/// points are symmetric about ½. I and D therefore act separately on the even and the odd part of values, which halves
/// the number of multiplications.

#include <array>

#include "continuum/mesh/reference_cell.h"

namespace pseudorigid::continuum {

/// An n×n matrix with M[n−1−q][n−1−i] = ±M[q][i]. The matrix is stored as its action on the sums x_i + x_{n−1−i} and
/// the differences x_i − x_{n−1−i} of a vector x.
template <int n>
struct EvenOddMatrix {
  static constexpr int half = n / 2, upper = (n + 1) / 2;
  double even[upper][upper], odd[upper][upper];

  /// m(q, i) is the entry M[q][i].
  template <class Entry>
  explicit EvenOddMatrix(const Entry& m) {
    for (int q = 0; q < upper; ++q)
      for (int i = 0; i < upper; ++i) {
        even[q][i] = i < half ? 0.5 * (m(q, i) + m(q, n - 1 - i)) : m(q, i);
        odd[q][i] = 0.5 * (m(q, i) - m(q, n - 1 - i));
      }
  }

  /// out_q ← Σ_i M_qi in_i; if `add` is true, out_q ← out_q + Σ_i M_qi in_i. Entries are `stride` apart. `in` and `out`
  /// may be the same. `symmetric` is true if the sign in the symmetry of M is +.
  template <bool symmetric, bool add, int stride, class L>
  [[gnu::always_inline]] void apply(const L* in, L* out) const {
    L sum[upper], difference[upper];
#pragma GCC unroll 5
    for (int i = 0; i < half; ++i) {
      sum[i] = in[i * stride] + in[(n - 1 - i) * stride];
      difference[i] = in[i * stride] - in[(n - 1 - i) * stride];
    }
    if constexpr (n % 2 == 1) sum[half] = in[half * stride];
#pragma GCC unroll 5
    for (int q = 0; q < half; ++q) {
      L e = even[q][0] * sum[0], o = odd[q][0] * difference[0];
#pragma GCC unroll 5
      for (int i = 1; i < upper; ++i) e = e + even[q][i] * sum[i];
#pragma GCC unroll 5
      for (int i = 1; i < half; ++i) o = o + odd[q][i] * difference[i];
      put<add>(o + e, out[q * stride]);
      put<add>(symmetric ? e - o : o - e, out[(n - 1 - q) * stride]);
    }
    if constexpr (n % 2 == 1) {
      const auto& row = symmetric ? even[half] : odd[half];
      const auto& x = symmetric ? sum : difference;
      L middle = row[0] * x[0];
#pragma GCC unroll 5
      for (int i = 1; i < (symmetric ? upper : half); ++i) middle = middle + row[i] * x[i];
      put<add>(middle, out[half * stride]);
    }
  }

 private:
  template <bool add, class L>
  [[gnu::always_inline]] static void put(L value, L& place) {
    place = add ? place + value : value;
  }
};

template <int n>
class SumFactorization {
 public:
  static constexpr int plane = n * n, size = n * n * n;

  explicit SumFactorization(const ReferenceCell& ref)
      : interpolate_([&](int q, int i) { return ref.interpolate[q * n + i]; }),
        distribute_([&](int i, int q) { return ref.interpolate[q * n + i]; }),
        differentiate_([&](int q, int p) { return ref.differentiate[q * n + p]; }),
        differentiate_transposed_([&](int p, int q) { return ref.differentiate[q * n + p]; }) {
    for (int q = 0; q < n; ++q)
      for (int i = 0; i < n; ++i) {
        value_[q][i] = ref.interpolate[q * n + i];
        slope_[q][i] = 0;
        for (int p = 0; p < n; ++p) slope_[q][i] += ref.differentiate[q * n + p] * ref.interpolate[p * n + i];
      }
  }

  /// u ← (I⊗I⊗1) u: interpolation along the first two directions in each layer of nodes.
  template <class L>
  void interpolate_layers(L* u) const {
    sweep_layers<true>(interpolate_, u);
  }
  /// u ← (Iᵀ⊗Iᵀ⊗1) u, the transposed map of interpolate_layers.
  template <class L>
  void distribute_layers(L* u) const {
    sweep_layers<true>(distribute_, u);
  }

  /// Computes the values and the derivatives g1, g2, g3 in the three directions at the points of a plane, from
  /// interpolated layers.
  template <class L>
  void plane_gradient(const L* layers, int q3, L* values, L* g1, L* g2, L* g3) const {
    evaluate_plane(layers, q3, values, g3);
    sweep_rows<false, false>(differentiate_, values, g1);
    sweep_columns<false, false>(differentiate_, values, g2);
  }

  /// The transposed map of plane_gradient for the derivatives. Adds the contribution of g1, g2, g3 at the points of a
  /// plane to the layers. The first plane overwrites the layers. `values` is a workspace.
  template <class L>
  void integrate_plane(const L* g1, const L* g2, const L* g3, int q3, L* values, L* layers) const {
    sweep_rows<false, false>(differentiate_transposed_, g1, values);
    sweep_columns<false, true>(differentiate_transposed_, g2, values);
    if (q3 == 0)
      add_plane<false>(values, g3, q3, layers);
    else
      add_plane<true>(values, g3, q3, layers);
  }

 private:
  using Matrix = EvenOddMatrix<n>;
  using Row = std::array<double, n>;

  template <bool symmetric, bool add, class L>
  static void sweep_rows(const Matrix& matrix, const L* in, L* out) {
    const Matrix M = matrix;  // a local copy cannot alias the results, so it stays in registers
    for (int line = 0; line < plane; line += n) M.template apply<symmetric, add, 1>(in + line, out + line);
  }
  template <bool symmetric, bool add, class L>
  static void sweep_columns(const Matrix& matrix, const L* in, L* out) {
    const Matrix M = matrix;
    for (int line = 0; line < n; ++line) M.template apply<symmetric, add, n>(in + line, out + line);
  }
  template <bool symmetric, class L>
  static void sweep_layers(const Matrix& M, L* u) {
    for (int layer = 0; layer < size; layer += plane) {
      sweep_rows<symmetric, false>(M, u + layer, u + layer);
      sweep_columns<symmetric, false>(M, u + layer, u + layer);
    }
  }

  /// Sets `values` to the values and `slopes` to the derivatives ∂₃ at the points of the plane q3.
  template <class L>
  void evaluate_plane(const L* layers, int q3, L* values, L* slopes) const {
    const Row value_row = value_[q3], slope_row = slope_[q3];
    for (int j = 0; j < plane; ++j) {
      L value = value_row[0] * layers[j], slope = slope_row[0] * layers[j];
#pragma GCC unroll 9
      for (int i = 1; i < n; ++i) {
        value = value + value_row[i] * layers[i * plane + j];
        slope = slope + slope_row[i] * layers[i * plane + j];
      }
      values[j] = value;
      slopes[j] = slope;
    }
  }

  /// The transpose of evaluate_plane. For the first plane, `add` is false.
  template <bool add, class L>
  void add_plane(const L* values, const L* slopes, int q3, L* layers) const {
    const Row value_row = value_[q3], slope_row = slope_[q3];
    for (int j = 0; j < plane; ++j) {
      const L value = values[j], slope = slopes[j];
#pragma GCC unroll 9
      for (int i = 0; i < n; ++i) {
        const L sum = value_row[i] * value + slope_row[i] * slope;
        layers[i * plane + j] = add ? layers[i * plane + j] + sum : sum;
      }
    }
  }

  Matrix interpolate_, distribute_, differentiate_, differentiate_transposed_;
  std::array<Row, n> value_, slope_;  ///< rows of I and of DI, for the third direction
};

}  // namespace pseudorigid::continuum
