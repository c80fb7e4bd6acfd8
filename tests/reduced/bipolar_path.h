#pragma once
/// The program's bipolar decompositions Q = TᵀAS (reduced/bipolar.h; Oliva 5.7) along a sampled path, and by
/// differences of order 8 of them what the program finds from Q̇ alone,
///
///   Ω* = ṪTᵀ,  Λ* = ṠSᵀ,  Ȧ, Ä, d/dt(AΛ* − Ω*A).
///
/// Axes that cross keep the decomposition smooth only if each is followed through the crossing; in falling order it is
/// smooth where they stay apart.

#include <algorithm>
#include <vector>

#include "reduced/bipolar.h"
#include "reduced/bodies.h"
#include "support/differences.h"

namespace pseudorigid::testing {

struct BipolarPath {
  double h;                         // between samples
  std::vector<Matrix3d> T, A, S{};  // at the samples

  enum class Order { falling, continued };

  BipolarPath(const std::vector<Matrix3d>& Q, double spacing, Order order = Order::falling) : h(spacing) {
    for (const Matrix3d& q : Q) {
      reduced::Bipolar b =
          T.empty() || order == Order::falling ? reduced::decompose(q) : reduced::decompose(q, at(n_samples() - 1));
      // In falling order only the signs are those of the sample before.
      for (int i = 0; i < 3 && !T.empty() && order == Order::falling; ++i)
        if (b.T.row(i).dot(T.back().row(i)) < 0) {
          b.T.row(i) *= -1;
          b.S.row(i) *= -1;
        }
      T.push_back(b.T);
      A.push_back(b.a.asDiagonal());
      S.push_back(b.S);
    }
  }

  int n_samples() const { return static_cast<int>(T.size()); }
  reduced::Bipolar at(int k) const { return {T[k], S[k], A[k].diagonal()}; }
  /// Least difference of two semi-axes at sample k.
  double least_gap(int k) const {
    const auto a = A[k].diagonal();
    return std::min({std::abs(a[1] - a[0]), std::abs(a[2] - a[1]), std::abs(a[0] - a[2])});
  }

  Matrix3d rate(const std::vector<Matrix3d>& X, int k) const {
    return first_difference([&](int j) { return X[k + j]; }, h);
  }
  Matrix3d Omega(int k) const { return rate(T, k) * T[k].transpose(); }
  Matrix3d Lambda(int k) const { return rate(S, k) * S[k].transpose(); }
  Matrix3d A_rate(int k) const { return rate(A, k); }
  Matrix3d A_second_rate(int k) const {
    return second_difference([&](int j) { return A[k + j]; }, h);
  }

  /// AΛ* (or what the book prints in its place: ΛΛ*, read as Λ*Λ*).
  enum class Term { corrected, as_printed };
  Matrix3d A_Lambda(int k, Term term) const { return (term == Term::corrected ? A[k] : Lambda(k)) * Lambda(k); }

  /// T Q̇ Sᵀ = Ȧ − Ω*A + AΛ*
  Matrix3d velocity(int k, Term term = Term::corrected) const {
    return A_rate(k) - Omega(k) * A[k] + A_Lambda(k, term);
  }
  /// The left side of (5.121): Ω*(Ω*A − Ȧ − AΛ*) + (−Ω*A + Ȧ + AΛ*)Λ* + d/dt(AΛ* − Ω*A) + Ä; needs the samples k ± 8.
  Matrix3d acceleration(int k, Term term = Term::corrected) const {
    const Matrix3d u = velocity(k, term);
    return A_second_rate(k) - Omega(k) * u + u * Lambda(k) +
           first_difference([&](int j) -> Matrix3d { return A_Lambda(k + j, term) - Omega(k + j) * A[k + j]; }, h);
  }
};

}  // namespace pseudorigid::testing
