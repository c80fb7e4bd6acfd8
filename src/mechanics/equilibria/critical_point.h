#pragma once
/// A critical point of the potential energy V on N = {g = 0}, and the small motions near it (Oliva, Geometric
/// Mechanics, 5.8). The point satisfies ∇V = Gᵀλ with G = Dg and the multiplier λ. M is the mass, which is the metric,
/// and C the damping. With a basis T of the tangent space ker G that is orthonormal in the metric, TᵀMT = Id,
///
///   H = Tᵀ(∇²V − Σ λ_k D²g_k)T,   D = TᵀCT,
///   small motions T y:   ÿ + Dẏ + Hy = 0,   and for y ~ e^{zt}:   z²y + zDy + Hy = 0.
///
/// The Morse index and the nullity of the point are the numbers of negative and of zero eigenvalues of H. The point is
/// hyperbolic if no z has the real part 0. If D is positive definite and H is regular, the point is hyperbolic, and the
/// dimension of its unstable manifold is the Morse index (5.8.3).

#include <Eigen/Core>

#include "mechanics/equilibria/any_landscape.h"

namespace pseudorigid::mechanics {

struct CriticalPoint {
  Eigen::VectorXd q, lambda;
  double V = 0;
  int morse_index = 0, nullity = 0;
  Eigen::VectorXd hessian_eigenvalues;  // eigenvalues of H, increasing; without damping the squared frequencies
  Eigen::VectorXcd rates;               // rates z of the small motions
  Eigen::MatrixXcd directions;          // column k: δq = T y for the rate k, of length 1 in the metric
  /// Numbers of rates with positive and with negative real part. For a system without dissipation, find_equilibria
  /// counts them with an added damping, which `rates` does not include.
  int n_unstable = 0, n_stable = 0;

  /// Returns true if no rate has a real part that is zero up to round-off.
  bool hyperbolic() const { return n_unstable + n_stable == rates.size(); }
  /// Returns true if the point satisfies Oliva's theorem 5.8.3: it is hyperbolic, and the number of unstable directions
  /// is the Morse index.
  bool obeys_5_8_3() const { return hyperbolic() && n_unstable == morse_index; }
};

/// Sets p to the critical point (q, λ), with the motions near it. The caller must ensure that (q, λ) is a critical
/// point. `added_damping` is the matrix of a linear damping that is added to the system's own damping C. Fails if the
/// Hessian or the damping cannot be computed, if H or D is not finite, or if the iteration for the rates does not
/// converge. H and D are not finite if M is singular, for example.
Status describe_critical_point(const AnyLandscape& landscape, const Eigen::VectorXd& q, const Eigen::VectorXd& lambda,
                               const Eigen::MatrixXd& added_damping, CriticalPoint& p);

}  // namespace pseudorigid::mechanics
