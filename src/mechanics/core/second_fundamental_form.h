#pragma once
/// Reactions without a multiplier, by the second fundamental form B (Oliva, Geometric Mechanics, 5.4). The
/// configurations are the manifold N, the image of an embedding φ into ℝⁿ with the metric M. Then
///
///   B(v, v) = (D²φ(q̇, q̇))^⊥,   v = Dφ q̇                                                            (5.28)
///   R = μ[B(v, v) − (μ⁻¹F)^⊥]                                                                       (5.29)
///
/// with the mass operator μ, the force F and the reaction R. The component w^⊥ = w − Dφ (DφᵀM Dφ)⁻¹ DφᵀM w of a vector
/// w is orthogonal to TN. R equals the reaction Gᵀλ of the same motion in the constrained form (constrained_system.h).

#include <Eigen/Core>

#include "mechanics/core/small_cholesky.h"

namespace pseudorigid::mechanics {

/// Returns the reaction R as a covector in ℝⁿ. `tangents` is Dφ. `second` is D²φ(q̇, q̇), `mass` is the diagonal of M,
/// and `force` is F. The columns of Dφ must be linearly independent.
template <int n, int d>
Eigen::Matrix<double, n, 1> reaction_by_second_fundamental_form(const Eigen::Matrix<double, n, d>& tangents,
                                                                const Eigen::Matrix<double, n, 1>& second,
                                                                const Eigen::Matrix<double, n, 1>& mass,
                                                                const Eigen::Matrix<double, n, 1>& force) {
  const Eigen::Matrix<double, n, d> covectors = mass.asDiagonal() * tangents;
  const SmallCholesky<d> metric(covectors.transpose() * tangents);
  const Eigen::Matrix<double, n, 1> w = second - force.cwiseQuotient(mass);
  return mass.cwiseProduct(w - tangents * metric.solve(covectors.transpose() * w));
}

}  // namespace pseudorigid::mechanics
