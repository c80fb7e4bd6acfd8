#pragma once
/// Chandrasekhar's index symbols (Ellipsoidal Figures of Equilibrium, §21) of the semi-axes a_i, with
/// Δ² = Π(a_k² + u):
///
///   A_i = a₁a₂a₃ ∫₀^∞ du/((a_i² + u)Δ),   A_ij = a₁a₂a₃ ∫₀^∞ du/((a_i² + u)(a_j² + u)Δ),
///   B_ij = a₁a₂a₃ ∫₀^∞ u du/((a_i² + u)(a_j² + u)Δ) = A_j − a_i² A_ij,
///
/// from the integrals of self-gravity, which are not divided by differences of axes, and
///
///   a_i² A_ii = A_i − ⅓ Σ_{j≠i} a_j² A_ij,   B_ii = ⅓ Σ_{j≠i} a_j² A_ij     (A_i is homogeneous).
///
/// A₁ + A₂ + A₃ = 2.

#include "gravity/ellipsoid_integrals.h"

namespace pseudorigid::reduced {

struct IndexSymbols {
  Eigen::Vector3d A;
  Eigen::Matrix3d A2, B;  ///< A_ij and B_ij
};

inline IndexSymbols index_symbols(const Eigen::Vector3d& axes) {
  const double unit = axes.maxCoeff();
  const Eigen::Vector3d a = axes / unit, x = a.cwiseAbs2();
  const auto [d, t] = gravity::ellipsoid_integrals(a);
  const double factor = 2.0 / 3 * a.prod();
  IndexSymbols s;
  s.A = factor * d;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    s.A2(j, k) = s.A2(k, j) = factor * t[i];
    s.B(i, i) = factor * (x[j] * t[k] + x[k] * t[j]) / 3;
    s.A2(i, i) = (s.A[i] - s.B(i, i)) / x[i];
    const auto [small, large] = x[j] < x[k] ? std::pair{j, k} : std::pair{k, j};
    s.B(j, k) = s.B(k, j) = s.A[large] - x[small] * s.A2(j, k);
  }
  s.A2 /= unit * unit;
  return s;
}

}  // namespace pseudorigid::reduced
