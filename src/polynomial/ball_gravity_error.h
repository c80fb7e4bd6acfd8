#pragma once
/// The error of the quadrature of self-gravity in the force on the ball. By symmetry the energy Ê of gravity, which
/// does not change under dilations, is stationary at the ball: ∂Ê/∂q = 0. The position is x = Σ_a q_a φ_a(X) with
/// coefficients q_a. The quadrature gives a derivative of 1e-6 to 1e-5 of the forces. Let ε_a be this derivative with
/// respect to q_a for a function φ_a that is not affine. The energy
///
///   E_ε(q) = Σ_a ε_a · B⁻¹ q_a = tr(B⁻¹ M),   B = A S,   M = Σ_a q_a ε_aᵀ,
///
/// has the same derivative at the ball, B = 1. A is the affine part of x, and S is the diagonal matrix of the semi-axes
/// of the reference body. E_ε does not change under rotations and dilations of x. With the rates Ḃ and Ṁ along a field
/// u and K = B⁻ᵀ, the derivatives are
///
///   ∂E_ε/∂q_a = K ε_a,           D(∂E_ε/∂q_a)[u] = −K Ḃᵀ K ε_a,
///   ∂E_ε/∂B   = −K Mᵀ K,         D(∂E_ε/∂B)[u]   = K Ḃᵀ K Mᵀ K − K Ṁᵀ K + K Mᵀ K Ḃᵀ K.

#include <Eigen/Core>
#include <memory>

#include "polynomial/polynomial_space.h"

namespace pseudorigid::polynomial {

class BallGravityError {
 public:
  /// `derivative` has the derivative of the energy of the quadrature at the ball, x = S⁻¹X. Its affine part is omitted.
  BallGravityError(std::shared_ptr<const PolynomialSpace> space, const Eigen::VectorXd& derivative);

  /// The largest entry of ε, a measure of the error of the quadrature.
  double size() const { return epsilon_.lpNorm<Eigen::Infinity>(); }
  /// E_ε at the position q.
  double energy(const Eigen::VectorXd& q) const;
  /// Adds ∂E_ε/∂q_a to `f`, for the functions that are not affine. Returns ∂E_ε/∂A.
  Eigen::Matrix3d add_derivative(const Eigen::VectorXd& q, Eigen::VectorXd& f) const;
  /// Adds the rate of ∂E_ε/∂q_a along u to `f`. Returns the rate of ∂E_ε/∂A.
  Eigen::Matrix3d add_derivative_rate(const Eigen::VectorXd& q, const Eigen::VectorXd& u, Eigen::VectorXd& f) const;

 private:
  Eigen::Matrix3d B(const Eigen::VectorXd& q) const { return space_->affine_part(q) * S_; }
  Eigen::Matrix3d M(const Eigen::VectorXd& q) const;
  /// f_a ← f_a + L ε_a for each function φ_a.
  void add_product(const Eigen::Matrix3d& L, Eigen::VectorXd& f) const;

  std::shared_ptr<const PolynomialSpace> space_;
  Eigen::DiagonalMatrix<double, 3> S_;
  Eigen::Matrix3Xd epsilon_;  ///< ε_a, one column for each function; 0 for affine and omitted functions
};

}  // namespace pseudorigid::polynomial
