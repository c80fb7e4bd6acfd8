#include "mechanics/equilibria/critical_point.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <complex>

#include "mechanics/core/dense_algebra.h"

namespace pseudorigid::mechanics {
namespace {

/// An eigenvalue of the Hessian H on the tangent space (critical_point.h) counts as zero if its absolute value is at
/// most this fraction of the largest absolute value. The bound is well above the errors of Hessians by differences,
/// which are about 1e-12.
constexpr double zero_curvature = 1e-8;
/// An eigenvalue of H also counts as zero if its absolute value is at most this bound. Such a number can be the
/// round-off of terms of order 1 that cancel. The relative bound alone is not enough. Without any force, all
/// eigenvalues are round-off, and the largest can be 1e-170.
constexpr double round_off_curvature = 1e-14;
/// The real part of a rate counts as zero if its absolute value is at most this fraction of the largest |rate|. With
/// little damping, an error of a zero eigenvalue of H causes rates whose size is the square root of this error.
constexpr double zero_rate = 1e-6;
/// A singular value of the constraints counts as zero if it is at most this fraction of the largest.
constexpr double dependent_constraint = 1e-14;

/// Returns a matrix T whose columns are a basis of ker G with TᵀMT = Id, for the mass M and the derivative G of the
/// constraints. M must be positive definite.
Eigen::MatrixXd tangent_basis(const Eigen::MatrixXd& M, const Eigen::MatrixXd& G) {
  const Eigen::LLT<Eigen::MatrixXd> factor(M);  // M = LLᵀ, T = L⁻ᵀZ with Z ⟂ L⁻¹Gᵀ
  const Eigen::MatrixXd normals = factor.matrixL().solve(G.transpose());
  return factor.matrixU().solve(null_space(normals.transpose(), dependent_constraint));
}

/// Sets the rates z and the directions of p for a system without damping. Each eigenvalue κ of H gives the two rates z
/// with z² = −κ. If |κ| ≤ `zero`, both are 0. Sets n_unstable and n_stable to p.morse_index, which the caller must have
/// set.
void linearise_undamped(const SymmetricSpectrum& H, double zero, const Eigen::MatrixXd& T, CriticalPoint& p) {
  const Eigen::Index n = H.values.size();
  p.rates.resize(2 * n);
  p.directions.resize(T.rows(), 2 * n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double kappa = H.values[k], size = std::abs(kappa) <= zero ? 0 : std::sqrt(std::abs(kappa));
    const std::complex<double> z = kappa < 0 ? std::complex(size, 0.0) : std::complex(0.0, size);
    p.rates.segment<2>(2 * k) << z, -z;
    p.directions.middleCols<2>(2 * k) = (T * H.vectors.col(k)).replicate<1, 2>();
  }
  p.n_unstable = p.n_stable = p.morse_index;
}

/// Sets the rates z and the directions δq = T y of p, for the solutions y ~ e^{zt} of ÿ + Dẏ + Hy = 0. Also sets the
/// numbers of stable and unstable rates. Fails if the iteration for the rates does not converge.
Status linearise(const Eigen::MatrixXd& H, const Eigen::MatrixXd& D, const Eigen::MatrixXd& T, CriticalPoint& p) {
  const Eigen::Index n = H.rows();
  Eigen::MatrixXd A(2 * n, 2 * n);  // the matrix of the first-order system for (y, ẏ)
  A << Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Identity(n, n), -H, -D;
  const Spectrum solution = spectrum(A);
  if (!solution.converged) return Status::failure("the rates of small motions at a critical point do not converge");
  p.rates = solution.values;
  p.directions = T * solution.vectors.topRows(n).colwise().normalized();
  const double zero = zero_rate * (n > 0 ? p.rates.cwiseAbs().maxCoeff() : 0);
  p.n_unstable = static_cast<int>((p.rates.real().array() > zero).count());
  p.n_stable = static_cast<int>((p.rates.real().array() < -zero).count());
  return {};
}

}  // namespace

Status describe_critical_point(const AnyLandscape& landscape, const Eigen::VectorXd& q, const Eigen::VectorXd& lambda,
                               const Eigen::MatrixXd& added_damping, CriticalPoint& p) {
  Eigen::MatrixXd M, G, hessian, C;
  landscape.mass(q, M);
  landscape.constraint_gradient(q, G);
  if (Status status = landscape.hessian(q, lambda, hessian); !status) return status;
  if (Status status = landscape.damping(q, C); !status) return status;
  const Eigen::MatrixXd T = tangent_basis(M, G);
  const Eigen::MatrixXd H = T.transpose() * hessian * T, D = T.transpose() * (C + added_damping) * T;
  if (!H.allFinite() || !D.allFinite())
    return Status::failure("the mass or the second derivative of the potential is singular at a critical point");

  p.q = q;
  p.lambda = lambda;
  p.V = landscape.potential(q);
  const SymmetricSpectrum curvature = symmetric_spectrum(H);
  p.hessian_eigenvalues = curvature.values;
  const double largest = p.hessian_eigenvalues.size() > 0 ? p.hessian_eigenvalues.cwiseAbs().maxCoeff() : 0;
  const double zero = std::max(zero_curvature * largest, round_off_curvature);
  p.morse_index = static_cast<int>((p.hessian_eigenvalues.array() < -zero).count());
  p.nullity = static_cast<int>((p.hessian_eigenvalues.array().abs() <= zero).count());
  if (!D.isZero(0)) return linearise(H, D, T, p);
  linearise_undamped(curvature, zero, T, p);
  return {};
}

}  // namespace pseudorigid::mechanics
