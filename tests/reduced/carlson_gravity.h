#pragma once
/// Self-gravity of the ellipsoid QB per m̄, in Carlson's form (PHYSICS section 2, 8): C = QQᵀ = U diag(a_i²)Uᵀ,
///
///   V = −4πGρ R_F(a₁², a₂², a₃²),   ∂V/∂Q = 2πGρ U diag(α_i)Uᵀ Q,   α_i = (2/3) R_D(a_j², a_k², a_i²),
///
/// with ρ the reference density. Nothing is divided by differences of the axes.

#include <Eigen/Dense>
#include <boost/math/special_functions/ellint_rd.hpp>
#include <boost/math/special_functions/ellint_rf.hpp>
#include <numbers>

#include "reduced/bodies.h"
#include "support/dense.h"

namespace pseudorigid::testing {

/// α_i = ∫₀^∞ ds/((a_i² + s)√Π(a_k² + s))
inline Vector3d gravity_coefficients(const Vector3d& a_squared) {
  Vector3d alpha;
  for (int i = 0; i < 3; ++i)
    alpha[i] = 2.0 / 3 * boost::math::ellint_rd(a_squared[(i + 1) % 3], a_squared[(i + 2) % 3], a_squared[i]);
  return alpha;
}
inline double self_gravity(const Matrix3d& Q, double G_rho) {
  const Vector3d a_squared = symmetric_spectrum(Q * Q.transpose()).values;
  return -4 * std::numbers::pi * G_rho * boost::math::ellint_rf(a_squared[0], a_squared[1], a_squared[2]);
}
inline Matrix3d self_gravity_gradient(const Matrix3d& Q, double G_rho) {
  const auto [a_squared, axes] = symmetric_spectrum(Q * Q.transpose());
  const Matrix3d U = axes, alpha = gravity_coefficients(a_squared).asDiagonal();
  return 2 * std::numbers::pi * G_rho * U * alpha * U.transpose() * Q;
}

}  // namespace pseudorigid::testing
