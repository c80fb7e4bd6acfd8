#pragma once
/// Smooth bipolar decompositions Q = TᵀAS along a sampled path (Oliva 5.7), with
///
///   Ω* = ṪTᵀ,  Λ* = ṠSᵀ,  Ȧ, Ä, d/dt(AΛ* − Ω*A)
///
/// by differences of order 8. Axes that cross keep the decomposition smooth only if each is followed through the
/// crossing; in rising order it is smooth where they stay apart.

#include <algorithm>
#include <vector>

#include "reduced/bodies.h"
#include "support/differences.h"

namespace pseudorigid::testing {

struct BipolarPath {
  double h;                         // between samples
  std::vector<Matrix3d> T, A, S{};  // at the samples

  enum class Order { rising, continued };

  /// The rows of T are eigenvectors of QQᵀ, with the signs that the sample before has; in the order of the axes, or
  /// each the one nearest to that of the sample before.
  BipolarPath(const std::vector<Matrix3d>& Q, double spacing, Order order = Order::rising) : h(spacing) {
    for (const Matrix3d& q : Q) {
      const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(q * q.transpose());
      Matrix3d t = solver.eigenvectors().transpose();
      if (order == Order::continued && !T.empty()) t = nearest_order(t, T.back()) * t;
      for (int i = 0; i < 3; ++i)
        if (T.empty() ? i == 2 && t.determinant() < 0 : t.row(i).dot(T.back().row(i)) < 0) t.row(i) *= -1;
      const Vector3d axes = (t * q).rowwise().norm();
      T.push_back(t);
      A.push_back(axes.asDiagonal());
      S.push_back(axes.cwiseInverse().asDiagonal() * t * q);
    }
  }

  int n_samples() const { return static_cast<int>(T.size()); }
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

 private:
  /// The permutation of rows that brings each where its largest overlap with a row before is.
  static Matrix3d nearest_order(const Matrix3d& rows, const Matrix3d& rows_before) {
    Matrix3d permutation = Matrix3d::Zero();
    for (int i = 0; i < 3; ++i) {
      int nearest = 0;
      (rows * rows_before.row(i).transpose()).cwiseAbs().maxCoeff(&nearest);
      permutation(i, nearest) = 1;
    }
    return permutation;
  }
};

}  // namespace pseudorigid::testing
