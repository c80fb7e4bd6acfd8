#pragma once
/// Steady motions (relative equilibria) of the pseudo-rigid body with the inertia E₀ = m̄ Id. The potential is
/// isotropic, V(UQW) = V(Q) for rotations U, W. A steady motion (Riemann 1861; Chandrasekhar, Ellipsoidal Figures of
/// Equilibrium, ch. 7, and Oliva 5.7.8) is
///
///   Q(t) = exp(tω̂) A exp(−tΛ̂),   A, ω, Λ constant.
///
/// Here ω̂ is the matrix of the cross product, ω̂x = ω×x. The ellipsoid AB is the image of the reference ball B. The
/// ellipsoid rotates with the angular velocity ω in space, and matter circulates in the ellipsoid with the angular
/// velocity −Λ. The multiplier per m̄ is λ. The equation of motion (5.120) of pseudo_rigid_body.h requires that the
/// residual R is zero:
///
///   R = ω̂²A − 2ω̂AΛ̂ + AΛ̂² + ∂V(A)/m̄ − λA⁻ᵀ = 0,   ln det A = 0     (on GL⁺(3), λ = 0 replaces the second equation)
///
/// Rotations U of space and W of the reference ball, A ↦ UᵀAW, ω ↦ Uᵀω, Λ ↦ WᵀΛ, make A = diag(a₁, a₂, a₃). The
/// transposed motion Q(t)ᵀ, (A, ω, Λ) ↦ (Aᵀ, Λ, ω), is also steady (Dedekind's duality). If Q(t) has the angular
/// momentum J and the circulation Z, the transposed motion has the angular momentum −Z and the circulation −J.

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <concepts>

#include "materials/eigen_tensor.h"
#include "materials/law_limits.h"
#include "mechanics/core/axial_vectors.h"
#include "mechanics/core/status.h"

namespace pseudorigid::reduced {

/// A potential V(Q) with exact first and second derivatives, not divided by m̄.
template <class V>
concept SmoothPotential = requires(const V potential, const Eigen::Matrix3d Q, const Eigen::Matrix3d H) {
  { potential.energy(Q) } -> std::convertible_to<double>;
  { potential.gradient(Q) } -> std::convertible_to<Eigen::Matrix3d>;
  { potential.second_derivative(Q, H) } -> std::convertible_to<Eigen::Matrix3d>;  // D(∂V)(Q)[H]
};

/// A body with E₀ = m̄ Id and an isotropic potential. The potential must outlive the body, which has a reference to it.
template <SmoothPotential V>
struct IsotropicBody {
  const V& potential;
  double m_bar;
  bool incompressible = true;

  /// The gradient ∂V(A) of the potential, and its derivative D(∂V)(A)[H] along H, both divided by m̄.
  Eigen::Matrix3d gradient(const Eigen::Matrix3d& A) const { return potential.gradient(A) / m_bar; }
  Eigen::Matrix3d second_derivative(const Eigen::Matrix3d& A, const Eigen::Matrix3d& H) const {
    return potential.second_derivative(A, H) / m_bar;
  }
  /// Fails if the material law does not admit A. The caller has to check det A > 0.
  mechanics::Status admissible(const Eigen::Matrix3d& A) const {
    if (materials::admits(potential, materials::to_tensor(A))) return {};
    return mechanics::Status::failure(materials::beyond_limit(materials::limit_of(potential)));
  }
};
template <class V>
IsotropicBody(const V&, double, bool) -> IsotropicBody<V>;
template <class V>
IsotropicBody(const V&, double) -> IsotropicBody<V>;

struct SteadyMotion {
  Eigen::Matrix3d A = Eigen::Matrix3d::Identity();
  Eigen::Vector3d omega = Eigen::Vector3d::Zero(), Lambda = Eigen::Vector3d::Zero();
  double lambda = 0;  ///< multiplier λ per m̄

  /// The deformation Q(t) and its rate Q̇(t).
  Eigen::Matrix3d position(double t) const { return turned(A, t); }
  Eigen::Matrix3d velocity(double t) const { return turned(co_moving_velocity(), t); }
  /// The rate Q̇(0) = ω̂A − AΛ̂.
  Eigen::Matrix3d co_moving_velocity() const {
    return mechanics::cross_matrix(omega) * A - A * mechanics::cross_matrix(Lambda);
  }
  /// Dedekind's dual motion, whose deformation is Q(t)ᵀ.
  SteadyMotion dual() const { return {A.transpose(), Lambda, omega, lambda}; }

 private:
  static Eigen::Matrix3d rotation(const Eigen::Vector3d& w, double t) {
    const double rate = w.norm();
    if (rate == 0) return Eigen::Matrix3d::Identity();
    return Eigen::AngleAxisd(rate * t, w / rate).toRotationMatrix();
  }
  Eigen::Matrix3d turned(const Eigen::Matrix3d& X, double t) const {
    return rotation(omega, t) * X * rotation(Lambda, -t);
  }
};

namespace detail {

/// Returns ω̂²X − 2ω̂XΛ̂ + XΛ̂². For a constant X, this is the acceleration of exp(tω̂) X exp(−tΛ̂) at t = 0.
inline Eigen::Matrix3d steady_acceleration(const Eigen::Vector3d& omega, const Eigen::Vector3d& Lambda,
                                           const Eigen::Matrix3d& X) {
  const Eigen::Matrix3d w = mechanics::cross_matrix(omega), l = mechanics::cross_matrix(Lambda);
  return w * w * X - 2 * w * X * l + X * l * l;
}

}  // namespace detail

/// The residual R in the head of this file, for the body and the motion m.
template <SmoothPotential V>
Eigen::Matrix3d steady_residual(const IsotropicBody<V>& body, const SteadyMotion& m) {
  return detail::steady_acceleration(m.omega, m.Lambda, m.A) + body.gradient(m.A) -
         m.lambda * m.A.inverse().transpose();
}

/// Returns the norm of the largest term of R, for comparison with |R|.
template <SmoothPotential V>
double steady_residual_scale(const IsotropicBody<V>& body, const SteadyMotion& m) {
  return std::max({(m.omega.squaredNorm() + m.Lambda.squaredNorm()) * m.A.norm(), body.gradient(m.A).norm(),
                   std::abs(m.lambda) * m.A.inverse().norm()});
}

}  // namespace pseudorigid::reduced
