#pragma once
/// Observables that both models of the ball have in common (whole ball, sectors reflected).
///
///   K = ½ ∫ρ|ẋ|² dV,   J = ∫ρ (x−x_c)×(ẋ−ẋ_c) dV,   Z = ∫ρ X×(Fᵀẋ) dV
///
/// Reduced body: J_i = m̄ ε_ijk Q_jA Q̇_kA,  Z_A = m̄ ε_ABC (QᵀQ̇)_CB; a rigid spin ω at Q = Id gives J = Z = 2m̄ω.
/// All in the program's internal units (length r, mass ρr³, time r/c).

#include <Eigen/Core>

namespace pseudorigid::mechanics {

/// What somebody will look at; the rest is not evaluated.
struct ObservableRequest {
  bool energies = true, momenta = true, multiplier = true, axes = true, nonaffine = true;
  bool pressure = false, bipolar = false, stretches = false;
};

/// The axial vector ε_ijk A_jk.
inline Eigen::Vector3d axial_vector(const Eigen::Matrix3d& A) {
  return {A(1, 2) - A(2, 1), A(2, 0) - A(0, 2), A(0, 1) - A(1, 0)};
}

/// The matrix of a ↦ w × a.
inline Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& w) {
  return (Eigen::Matrix3d() << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0).finished();
}

struct BodyObservables {
  Eigen::Matrix3d Q = Eigen::Matrix3d::Identity();     ///< Q (reduced) or the mass moment Q_M (continuum)
  Eigen::Matrix3d Qdot = Eigen::Matrix3d::Zero();      ///< its rate
  Eigen::Vector3d center = Eigen::Vector3d::Zero();    ///< centre of mass x
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< its velocity v
  double kinetic = 0, elastic = 0, gravitational = 0, external = 0, dissipated = 0;
  Eigen::Vector3d angular_momentum = Eigen::Vector3d::Zero();  ///< J, about the centre of mass
  Eigen::Vector3d circulation = Eigen::Vector3d::Zero();       ///< Z
  double volume_ratio = 1;                                     ///< current volume / reference volume
  double multiplier = 0;                                       ///< λ of (5.120) per m̄; continuum: (1/m̄)∫λ_h dV
  Eigen::Vector3d semi_axes = Eigen::Vector3d::Ones();         ///< a₁ ≥ a₂ ≥ a₃, singular values of Q times r

  double energy() const { return kinetic + elastic + gravitational + external + dissipated; }
};

/// What only the reduced body has.
struct ReducedObservables : BodyObservables {
  double central_pressure = 0;                     ///< p_c of p = p_c(1 − |X|²/r²), the reaction to det Q = 1
  Eigen::Vector3d axes = Eigen::Vector3d::Ones();  ///< a_i of Q = TᵀAS, followed along the path, times r
  Eigen::Matrix3d T = Eigen::Matrix3d::Identity(), S = T;
  Eigen::Vector3d Omega_star = Eigen::Vector3d::Zero();   ///< entries 12, 13, 23 of Ω* = ṪTᵀ
  Eigen::Vector3d Lambda_star = Eigen::Vector3d::Zero();  ///< likewise of Λ* = ṠSᵀ
  double bipolar_residual = 0;                            ///< largest entry of the residual of (5.121), per m̄
};

/// What only the continuum has.
struct ContinuumObservables : BodyObservables {
  Eigen::Matrix3d F = Eigen::Matrix3d::Identity();  ///< mean deformation gradient F̄ = ∫F dV / Vol
  double nonaffine_kinetic_fraction = 0;            ///< η_K = K_nonaffine / K  (0/0 = 0)
  double nonaffine_displacement = 0;                ///< e_x = |x − Q_M X| / |x|, ρ-weighted L²
  double volumetric = 0;                            ///< part of `elastic` that the volumetric stabilisation stores
  double min_jacobian = 1;                          ///< least det F over the quadrature points
  double min_stretch = 1, max_stretch = 1;          ///< least and largest principal stretch there
};

}  // namespace pseudorigid::mechanics
