#pragma once
/// A critical point of the potential energy V on N = {g = 0}, with ∇V = Gᵀλ, G = Dg, and the motions near it (Oliva,
/// Geometric Mechanics, 5.8). With the mass M, the damping C, and a basis T of the tangent space ker G that is
/// orthonormal in the metric, TᵀMT = Id,
///
///   H = Tᵀ(∇²V − Σ λ_k D²g_k)T,   D = TᵀCT,
///   small motions T y:   ÿ + Dẏ + Hy = 0,   and for y ~ e^{zt}:   z²y + zDy + Hy = 0.
///
/// The Morse index and the nullity of the point are the numbers of negative and of zero eigenvalues of H. If the system
/// is strongly dissipative and H is regular, the point is hyperbolic. The dimension of its unstable manifold is then
/// the Morse index (5.8.3).

#include <Eigen/Core>

#include "mechanics/equilibria/any_landscape.h"

namespace pseudorigid::mechanics {

struct CriticalPoint {
  Eigen::VectorXd q, lambda;
  double V = 0;
  int morse_index = 0, nullity = 0;
  Eigen::VectorXd hessian_eigenvalues;  // eigenvalues of H, increasing: squares of the frequencies without damping
  Eigen::VectorXcd rates;               // rates z of the small motions
  Eigen::MatrixXcd directions;          // δq = T y for each rate, of length 1 in the metric
  int n_unstable = 0, n_stable = 0;     // numbers of rates with positive and with negative real part

  /// Returns true if every rate has a real part other than zero, up to round-off.
  bool hyperbolic() const { return n_unstable + n_stable == rates.size(); }
  /// Returns true if the point satisfies Oliva's theorem 5.8.3: it is hyperbolic, and the number of unstable directions
  /// is the Morse index.
  bool obeys_5_8_3() const { return hyperbolic() && n_unstable == morse_index; }
};

/// Sets p to the description of the critical point (q, λ). `added_damping` is the matrix C of a force −C v in addition
/// to the system's own damping. Fails if the Hessian or the damping cannot be computed, if H or D is not finite, or if
/// the iteration for the rates does not converge. H or D can be infinite if M is singular.
Status describe_critical_point(const AnyLandscape& landscape, const Eigen::VectorXd& q, const Eigen::VectorXd& lambda,
                               const Eigen::MatrixXd& added_damping, CriticalPoint& p);

}  // namespace pseudorigid::mechanics
