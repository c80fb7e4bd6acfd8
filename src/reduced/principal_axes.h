#pragma once
/// Principal axes of the ellipsoid F B, B the unit ball: F = U diag(a) Vᵀ, so C = FFᵀ = U diag(a²) Uᵀ.
///
/// One-sided Jacobi rotations (Hestenes 1958; Demmel, Veselić 1992): rows of F are rotated in pairs, A ← RᵀA, U ← UR,
/// until they are orthogonal; then A = UᵀF = diag(a)Vᵀ and a_i = |A_i|. Small axes keep their accuracy cond(F)·ε, which
/// the eigenvalues of C would lose, and rows that are orthogonal already are left as they are, bit for bit.

#include <Eigen/Core>
#include <cmath>

namespace pseudorigid::reduced {

struct PrincipalAxes {
  Eigen::Matrix3d U;  ///< columns: directions of the axes, in no order
  Eigen::Matrix3d A;  ///< UᵀF, rows orthogonal
  Eigen::Vector3d a;  ///< lengths of the semi-axes
};

namespace detail {

/// Makes rows i and j of A orthogonal; false if they were, to round-off. With δ = |A_j|² − |A_i|², γ = A_i·A_j and
/// h = √(δ² + 4γ²) the smaller angle is that of tan = ±2|γ|/(h + |δ|), cos² = (h + |δ|)/(2h).
inline bool orthogonalize_rows(PrincipalAxes& axes, int i, int j) {
  constexpr double round_off = 1e-16;
  auto& [U, A, a] = axes;
  const double alpha = A.row(i).squaredNorm(), beta = A.row(j).squaredNorm(), gamma = A.row(i).dot(A.row(j));
  if (!(gamma * gamma > round_off * round_off * (alpha * beta))) return false;
  const double delta = beta - alpha, h = std::sqrt(delta * delta + 4 * gamma * gamma), sum = h + std::abs(delta);
  const double cosine = std::sqrt(sum / (2 * h)), sine = cosine * (std::copysign(2.0, delta) * gamma / sum);
  const Eigen::RowVector3d row = A.row(i);
  A.row(i) = cosine * row - sine * A.row(j);
  A.row(j) = sine * row + cosine * A.row(j);
  const Eigen::Vector3d direction = U.col(i);
  U.col(i) = cosine * direction - sine * U.col(j);
  U.col(j) = sine * direction + cosine * U.col(j);
  return true;
}

}  // namespace detail

/// Entries of F are to be of order 1 at most (they are squared). A matrix that is not finite gives axes that are not.
inline PrincipalAxes principal_axes(const Eigen::Matrix3d& F) {
  constexpr int max_sweeps = 12;  // convergence is quadratic; four are the rule
  PrincipalAxes axes{Eigen::Matrix3d::Identity(), F, {}};
  for (int sweep = 0; sweep < max_sweeps; ++sweep) {
    bool rotated = detail::orthogonalize_rows(axes, 0, 1);
    rotated |= detail::orthogonalize_rows(axes, 0, 2);
    rotated |= detail::orthogonalize_rows(axes, 1, 2);
    if (!rotated) break;
  }
  axes.a = axes.A.rowwise().norm();
  return axes;
}

}  // namespace pseudorigid::reduced
