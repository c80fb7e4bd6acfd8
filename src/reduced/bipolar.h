#pragma once
/// The bipolar decomposition along a motion Q(t) (Oliva 5.7.1, 5.7.8): Q = TᵀAS with T, S ∈ SO(3), A = diag(a), and
///
///   Ω* = ṪTᵀ,  Λ* = ṠSᵀ,   u = T Q̇ Sᵀ = Ȧ − Ω*A + AΛ*
///
/// The entries of u = Ȧ − Ω*A + AΛ* give the diagonal of Ȧ and, for i ≠ j,
///
///   Ω*_ij = −(a_j u_ij + a_i u_ji)/(a_j² − a_i²),   Λ*_ij = −(a_i u_ij + a_j u_ji)/(a_j² − a_i²).
///
/// The equation of motion in these frames is (5.120) of pseudo_rigid_body.h, multiplied by T from the left and by Sᵀ
/// from the right. The result is equation (5.121) of Oliva, corrected (docs/oliva.md). Let V be the potential energy,
/// E₀ the inertia of the reference body, m̄ = ⅓ tr E₀, λ the multiplier per m̄, and N = SE₀Sᵀ/m̄. For the ball, N = Id.
/// Divided by m̄, the equation is
///
///   (u̇ − Ω*u + uΛ*) N + T ∂V/∂Q Sᵀ/m̄ − λA⁻¹ = 0.
///
/// The program integrates (5.120) and evaluates (5.121) as an observable, because Ω* and Λ* are not defined if two axes
/// coincide. The axes are continued along the path and not sorted, because sorted axes have corners at crossings. After
/// a crossing, the decomposition continues with the frames nearest to the previous frames. If the path has a smooth
/// continuation of the frames, these frames belong to it. Analytic paths always have a smooth continuation (Kato,
/// Perturbation Theory for Linear Operators, II.6.1). Other smooth paths may have none (Montaldi). If consecutive
/// states are far apart, the decomposition may assign the axes wrongly.

#include <Eigen/Core>
#include <array>

#include "mechanics/core/principal_axes.h"

namespace pseudorigid::reduced {

/// The decomposition Q = TᵀAS. Row i of T and row i of S belong to axis i.
struct Bipolar {
  Eigen::Matrix3d T, S;
  Eigen::Vector3d a;
};

struct BipolarRates {
  Eigen::Matrix3d Omega, Lambda;  ///< the rates Ω* and Λ* of the frames
  Eigen::Vector3d a_rate;         ///< the diagonal of Ȧ
  Eigen::Matrix3d u;              ///< velocity Q̇ in the frames, T Q̇ Sᵀ
};

namespace detail {
/// Exchanges axes i and j of b. TᵀAS does not change.
void exchange_axes(Bipolar& b, int i, int j);
/// Reverses axis i: the rows i of T and S change their signs, and TᵀAS does not change.
void reverse_axis(Bipolar& b, int i);
}  // namespace detail

/// The decomposition with det T = det S = 1 and axes in descending order. Requires det Q > 0.
Bipolar decompose(const Eigen::Matrix3d& Q);

/// Returns the decomposition of Q that is nearest to `before`, the decomposition at a slightly earlier time. The
/// candidates have det T = det S = 1 and differ in the order and the signs of the axes. If two semi-axes are equal to
/// round-off, their rows of T and S are then rotated to the position nearest to `before`. Requires det Q > 0.
Bipolar decompose(const Eigen::Matrix3d& Q, const Bipolar& before);

/// The rates Ω*, Λ* and Ȧ, and u, for the velocity Q̇ = `Qdot`. If axes i and j coincide to round-off, the entries ij
/// of Ω* and Λ* are set to 0.
BipolarRates rates(const Bipolar& b, const Eigen::Matrix3d& Qdot);

/// The residual of Oliva (5.121) per m̄ at the middle of nine states of one motion. The times of the states have equal
/// distances h, and u̇ is a central difference of order 8. `gradient` replaces ∂V/∂Q: it is the negative sum of all
/// forces on Q other than the reaction. `lambda` is the multiplier per m̄. The gradient and the multiplier are those of
/// the state in the middle.
template <class States>
Eigen::Matrix3d residual_of_5_121(const States& states, double h, const Eigen::Matrix3d& gradient, double lambda,
                                  const Eigen::Matrix3d& E0) {
  constexpr std::array<double, 4> weights{4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
  constexpr int middle = 4;
  const Bipolar b = decompose(states[middle].q);
  const BipolarRates r = rates(b, states[middle].v);
  Eigen::Matrix3d u_rate = Eigen::Matrix3d::Zero();
  for (const int side : {1, -1}) {
    Bipolar along = b;
    for (int k = 1; k <= middle; ++k) {
      const auto& state = states[middle + side * k];
      along = decompose(state.q, along);
      u_rate += side * weights[k - 1] / h * along.T * state.v * along.S.transpose();
    }
  }
  const double m_bar = E0.trace() / 3;
  const Eigen::Matrix3d A_inverse = b.a.cwiseInverse().asDiagonal();
  return (u_rate - r.Omega * r.u + r.u * r.Lambda) * (b.S * E0 * b.S.transpose() / m_bar) +
         b.T * gradient * b.S.transpose() / m_bar - lambda * A_inverse;
}

}  // namespace pseudorigid::reduced
