#pragma once
/// Sum factorisation on one batch of cells: values u_i at the n³ nodes ↔ reference gradients at the n³ Gauss points,
///
///   ∂u/∂ξ_d (ξ_q) = D_d (I⊗I⊗I) u
///
/// by n-point sweeps: interpolation to the points (3 sweeps), then differentiation there (3 sweeps).

#include "continuum/reference_cell.h"

namespace pseudorigid::continuum {

template <int n>
struct SumFactorization {
  static constexpr int size = n * n * n;

  explicit SumFactorization(const ReferenceCell& ref) {
    for (int q = 0; q < n; ++q)
      for (int i = 0; i < n; ++i) {
        interpolate[q * n + i] = interpolate_transposed[i * n + q] = ref.interpolate[q * n + i];
        differentiate[q * n + i] = differentiate_transposed[i * n + q] = ref.differentiate[q * n + i];
      }
  }

  /// Values at the points; `scratch` holds `size` entries, `values` may be `u`.
  template <class L>
  void values(const L* u, L* scratch, L* values) const {
    sweep<1, false>(interpolate, u, values);
    sweep<n, false>(interpolate, values, scratch);
    sweep<n * n, false>(interpolate, scratch, values);
  }

  /// Gradients at the points: g[d] from u.
  template <class L>
  void gradients(const L* u, L* scratch, L* point_values, L* g0, L* g1, L* g2) const {
    values(u, scratch, point_values);
    sweep<1, false>(differentiate, point_values, g0);
    sweep<n, false>(differentiate, point_values, g1);
    sweep<n * n, false>(differentiate, point_values, g2);
  }

  /// The transpose of `gradients`: u = Σ_d (D_d I)ᵀ g[d].
  template <class L>
  void integrate(const L* g0, const L* g1, const L* g2, L* scratch, L* point_values, L* u) const {
    sweep<1, false>(differentiate_transposed, g0, point_values);
    sweep<n, true>(differentiate_transposed, g1, point_values);
    sweep<n * n, true>(differentiate_transposed, g2, point_values);
    sweep<n * n, false>(interpolate_transposed, point_values, scratch);
    sweep<n, false>(interpolate_transposed, scratch, point_values);
    sweep<1, false>(interpolate_transposed, point_values, u);
  }

 private:
  /// out (+)= M applied along the direction of that stride.
  template <int stride, bool add, class L>
  static void sweep(const double* M, const L* in, L* out) {
    for (int outer = 0; outer < size; outer += stride * n)
      for (int inner = 0; inner < stride; ++inner) {
        const L* line = in + outer + inner;
        L* result = out + outer + inner;
        L x[n];
#pragma GCC unroll 9
        for (int i = 0; i < n; ++i) x[i] = line[i * stride];
#pragma GCC unroll 9
        for (int q = 0; q < n; ++q) {
          L sum = M[q * n] * x[0];
#pragma GCC unroll 9
          for (int i = 1; i < n; ++i) sum = sum + M[q * n + i] * x[i];
          result[q * stride] = add ? result[q * stride] + sum : sum;
        }
      }
  }

  double interpolate[n * n], interpolate_transposed[n * n], differentiate[n * n], differentiate_transposed[n * n];
};

}  // namespace pseudorigid::continuum
