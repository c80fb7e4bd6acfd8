#pragma once
/// 3×3 matrices as values of entries of a parameter file, and the linear algebra for checks of these values.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pseudorigid::scene {

/// A matrix, stored row by row. The type makes the entries independent of any linear algebra library.
using Matrix3 = std::array<std::array<double, 3>, 3>;
inline constexpr Matrix3 identity3{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
/// Bound of the round-off error of a sum of a few products, divided by the sum of the absolute values of the products.
inline constexpr double round_off_of_sum = 8 * std::numeric_limits<double>::epsilon();
/// Largest permitted condition number and largest permitted stretch of a matrix. For larger values, round-off exceeds
/// the accuracy of the user's data.
inline constexpr double largest_condition = 1e12, largest_stretch = 1e12;

/// The cofactor matrix cof Q, equal to det(Q) Q^-T if Q is regular. If Q is diagonal or block diagonal, the zeros of
/// the result are exact.
inline Matrix3 cofactor(const Matrix3& q) {
  Matrix3 cof{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      cof[i][j] = q[i1][j1] * q[i2][j2] - q[i1][j2] * q[i2][j1];
    }
  return cof;
}

/// The inner product A : B = tr(AᵀB).
inline double inner(const Matrix3& a, const Matrix3& b) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) sum += a[i][j] * b[i][j];
  return sum;
}

/// The Frobenius norm.
inline double norm(const Matrix3& a) { return std::sqrt(inner(a, a)); }

/// The largest absolute value of the entries.
inline double largest_entry(const Matrix3& a) {
  double largest = 0;
  for (const auto& row : a)
    for (const double entry : row) largest = std::max(largest, std::abs(entry));
  return largest;
}

inline double det(const Matrix3& q) {
  const Matrix3 cof = cofactor(q);
  return q[0][0] * cof[0][0] + q[0][1] * cof[0][1] + q[0][2] * cof[0][2];
}

/// The linear combination a·first + b·second.
inline Matrix3 combine(double a, const Matrix3& first, double b, const Matrix3& second) {
  Matrix3 sum{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) sum[i][j] = a * first[i][j] + b * second[i][j];
  return sum;
}

inline Matrix3 scaled(double factor, Matrix3 a) {
  for (auto& row : a)
    for (double& entry : row) entry *= factor;
  return a;
}

/// The matrix of the absolute values of the entries.
inline Matrix3 absolute(Matrix3 a) {
  for (auto& row : a)
    for (double& entry : row) entry = std::abs(entry);
  return a;
}

}  // namespace pseudorigid::scene
