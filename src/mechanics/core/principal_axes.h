#pragma once
/// Principal axes of the ellipsoid to which a 3×3 matrix F maps the unit ball. By the singular value decomposition F =
/// U diag(a) Vᵀ, the columns of U are the directions and the a_i the lengths of the semi-axes. C = FFᵀ is U diag(a²)
/// Uᵀ.
///
/// The method consists of one-sided Jacobi rotations (Hestenes 1958; Demmel, Veselić 1992). The rotations change U
/// until the rows A_i of A = UᵀF are orthogonal. Then A = diag(a)Vᵀ and a_i = |A_i|. All lengths have a relative error
/// of cond(F)·ε, with the round-off ε. From the eigenvalues of C, small lengths would have the error cond(F)²·ε. If the
/// rows of F are already orthogonal, U = Id. Three devices make the method fast.
///
/// First, the iteration starts from the eigenvectors of C in closed form. With B = C − m Id, m = ⅓ tr C, |B|² = 6p² and
///
///   q = |det B|/(2p³),   λ = ±2p cos(⅓ arccos q),
///
/// λ has the sign of det B and is the eigenvalue of B farthest from the other two. Its eigenvector is a column of the
/// matrix adj(B − λ Id). B is then diagonalized on the orthogonal complement of this vector by a plane rotation.
/// Second, one Cayley rotation removes all remaining small angles
///
///   θ_ij = A_i·A_j/(|A_j|² − |A_i|²),
///
/// and leaves angles of order θ². Usually one such rotation is enough. Third, single plane rotations are made only if
/// an angle θ_ij is 0.1 or more. Such angles occur if two axes have nearly the same length.

#include <Eigen/Core>

namespace pseudorigid::mechanics {

struct PrincipalAxes {
  Eigen::Matrix3d U;  ///< columns: directions of the axes, unsorted
  Eigen::Matrix3d A;  ///< UᵀF, with orthogonal rows
  Eigen::Vector3d a;  ///< lengths of the semi-axes
};

namespace detail::axes {

/// Returns the product MN, computed entry by entry. Eigen would load pairs of doubles immediately after each double was
/// stored, and the processor waits for such loads. In a measurement this waiting took a quarter of the time of
/// principal_axes.
Eigen::Matrix3d product(const Eigen::Matrix3d& M, const Eigen::Matrix3d& N);

/// A symmetric matrix S: its diagonal, and opposite[i] = S_jk with (i, j, k) a permutation of (0, 1, 2).
struct Symmetric {
  Eigen::Vector3d diagonal, opposite;
  Eigen::Vector3d operator*(const Eigen::Vector3d& u) const {
    return {diagonal[0] * u[0] + opposite[2] * u[1] + opposite[1] * u[2],
            opposite[2] * u[0] + diagonal[1] * u[1] + opposite[0] * u[2],
            opposite[1] * u[0] + opposite[0] * u[1] + diagonal[2] * u[2]};
  }
};

/// The rotation (u, v) ← (cosine · u − sine · v, sine · u + cosine · v) of two columns.
struct PlaneRotation {
  double cosine, sine;
  void apply(Eigen::Vector3d& u, Eigen::Vector3d& v) const {
    for (int i = 0; i < 3; ++i) {
      const double old = u[i];
      u[i] = cosine * old - sine * v[i];
      v[i] = sine * old + cosine * v[i];
    }
  }
};

/// Returns the rotation by the smaller angle that diagonalizes the matrix (α γ; γ β). With δ = β − α and h = √(δ² +
/// 4γ²), the angle has the tangent ±2γ/(h + |δ|) with the sign of δ. The square of its cosine is (h + |δ|)/(2h).
PlaneRotation diagonalizing(double alpha, double beta, double gamma);

/// Returns cos(⅓ arccos q) for 0 ≤ q ≤ 1 with an error of 1e-8. Halley's step for 4c³ − 3c = q starts from a parabola
/// that is exact at q = 0 and at q = 1.
double cosine_of_third(double q);

/// Returns the matrix whose columns are the eigenvectors of C, in closed form. The columns are orthonormal to
/// round-off, and their directions have errors of about 1e-8. C must not be a multiple of Id.
Eigen::Matrix3d eigenvectors(const Symmetric& C);

}  // namespace detail::axes

/// Returns the principal axes of F. The nonzero entries of F must be between 10⁻²⁰ and 10²⁰ in size, because the method
/// uses their eighth powers. If F is not finite, at least one length in `a` is not finite. The method makes at most 20
/// iterations, and returns the result of the last one.
PrincipalAxes principal_axes(const Eigen::Matrix3d& F);

/// Returns the singular values σ₁ ≥ σ₂ ≥ σ₃ of F, which are the sorted lengths of the semi-axes.
Eigen::Vector3d singular_values(const Eigen::Matrix3d& F);

/// Returns a number that is at least σ₁(F), without iterations. It is larger by at most 1e-3 (σ₁ − σ₃) if σ₃ is at
/// least half of σ₁ and differs from σ₁ by more than 1e-5 σ₁. Returns NaN if F is not finite.
double largest_singular_value_bound(const Eigen::Matrix3d& F);
/// Returns a number that is at most σ₃(F), and smaller by as much as largest_singular_value_bound is larger. Returns 0
/// if F is not finite.
double least_singular_value_bound(const Eigen::Matrix3d& F);

}  // namespace pseudorigid::mechanics
