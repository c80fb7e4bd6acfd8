#pragma once
/// Polynomials of total degree ≤ m in one cell, as functions of the local coordinates (x, y, z) = (X − X_c)/h_c. X is
/// the reference position, and X_c is the centre of mass of the cell. h_c is half the edge of a cube with the volume of
/// the cell. The coordinates are therefore of order 1. The monomials x^a y^b z^c with a + b + c ≤ m are ordered by a,
/// then by b, then by c.

namespace pseudorigid::continuum {

template <int m>
struct PressureMonomials {
  static constexpr int size = (m + 1) * (m + 2) * (m + 3) / 6;

  /// Returns Σ coefficient · monomial at (x, y, z), by nested Horner schemes.
  template <class L>
  static L evaluate(const L* coefficients, L x, L y, L z) {
    int index = size;
    L in_x(0.0);
#pragma GCC unroll 9
    for (int a = m; a >= 0; --a) {
      L in_y(0.0);
#pragma GCC unroll 9
      for (int b = m - a; b >= 0; --b) {
        L in_z(0.0);
#pragma GCC unroll 9
        for (int c = m - a - b; c >= 0; --c) in_z = in_z * z + coefficients[--index];
        in_y = in_y * y + in_z;
      }
      in_x = in_x * x + in_y;
    }
    return in_x;
  }

  /// Adds weight · monomial at (x, y, z) to the entry of `moments` for each monomial.
  template <class L>
  static void add_moments(L weight, L x, L y, L z, L* moments) {
    int index = 0;
    L in_x = weight;
#pragma GCC unroll 9
    for (int a = 0; a <= m; ++a) {
      L in_y = in_x;
#pragma GCC unroll 9
      for (int b = 0; b <= m - a; ++b) {
        L in_z = in_y;
#pragma GCC unroll 9
        for (int c = 0; c <= m - a - b; ++c) {
          moments[index++] += in_z;
          in_z = in_z * z;
        }
        in_y = in_y * y;
      }
      in_x = in_x * x;
    }
  }
};

}  // namespace pseudorigid::continuum
