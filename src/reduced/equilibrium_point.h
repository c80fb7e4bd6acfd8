#pragma once
/// Quantities of one steady motion Q(t) (steady_motion.h) that the program reports. The body has the inertia m̄ Id. The
/// kinetic energy K, the angular momentum J and the circulation Z are in internal units and are not divided by m̄,
///
///   K = (m̄/2)|Q̇|²,   J_i = m̄ ε_ijk Q_jA Q̇_kA,   Z_A = m̄ ε_ABC (QᵀQ̇)_CB,   at t = 0.
///
/// The internal motion of matter has the vorticity ζ_k = −Λ_k (a_i² + a_j²)/(a_i a_j) relative to the rotating axes.
/// Here Λ is the internal rotation, the a_i are the semi-axes, and the indices i, j, k are different.

#include "reduced/linear_stability.h"

namespace pseudorigid::reduced {

struct EquilibriumPoint {
  double parameter = 0;       ///< parameter of the family
  SteadyMotion motion;        ///< the motion, with A = diag(a₁, a₂, a₃)
  Eigen::Vector3d semi_axes;  ///< semi-axes a₁, a₂, a₃ of A, in this order and not sorted by size
  double kinetic = 0, potential = 0;
  Eigen::Vector3d angular_momentum, circulation;  ///< angular momentum J and circulation Z
  Eigen::Vector3d vorticity;                      ///< vorticity ζ of the internal motion
  double residual = 0;  ///< |R| of steady_motion.h, divided by the largest norm of a term of R; 0 if all terms are 0
  LinearStability stability;

  double energy() const { return kinetic + potential; }
  /// Riemann's f = ζ₃/ω₃. The ratio is 0 without vorticity, and infinite if ζ₃ is not 0 but ω₃ is 0.
  double vorticity_ratio() const { return vorticity[2] == 0 ? 0 : vorticity[2] / motion.omega[2]; }
};

/// Sets `point` to the quantities of the steady motion m, with the parameter of the family. A must be diagonal. Fails
/// if the linear stability cannot be computed (analyse_stability).
template <SmoothPotential V>
mechanics::Status describe_equilibrium(const IsotropicBody<V>& body, const SteadyMotion& m, double parameter,
                                       EquilibriumPoint& point) {
  const Eigen::Matrix3d &A = m.A, v = m.co_moving_velocity();
  const Eigen::Vector3d a = A.diagonal();
  point.parameter = parameter;
  point.motion = m;
  point.semi_axes = a;
  point.kinetic = body.m_bar / 2 * v.squaredNorm();
  point.potential = body.potential.energy(A);
  point.angular_momentum = body.m_bar * mechanics::axial_vector(A * v.transpose());
  point.circulation = body.m_bar * mechanics::axial_vector(v.transpose() * A);
  for (int k = 0; k < 3; ++k) {
    const double x = a[(k + 1) % 3], y = a[(k + 2) % 3];
    point.vorticity[k] = 0 - m.Lambda[k] * (x / y + y / x);
  }
  const double scale = steady_residual_scale(body, m);
  point.residual = scale > 0 ? steady_residual(body, m).norm() / scale : 0;
  return analyse_stability(body, m, point.stability);
}

}  // namespace pseudorigid::reduced
