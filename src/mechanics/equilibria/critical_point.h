#pragma once
/// A critical point of V on N = {g = 0}, ∇V = Gᵀλ, and the motions near it (Oliva, Geometric Mechanics, 5.8). With a
/// basis T of the tangent space ker G that is orthonormal in the metric, TᵀMT = Id,
///
///   H = Tᵀ(∇²V − Σ λ_k D²g_k)T,   D = TᵀCT,
///   ÿ + Dẏ + Hy = 0:   z²y + zDy + Hy = 0.
///
/// Morse index and nullity are those of H. If the damping is strongly dissipative and H regular, the point is
/// hyperbolic, and its unstable manifold has the dimension of the Morse index (5.8.3).

#include <Eigen/Core>

#include "mechanics/equilibria/any_landscape.h"

namespace pseudorigid::mechanics {

struct CriticalPoint {
  Eigen::VectorXd q, lambda;
  double V = 0;
  int morse_index = 0, nullity = 0;
  Eigen::VectorXd hessian_eigenvalues;  // eigenvalues of H, rising: squares of frequencies without damping
  Eigen::VectorXcd rates;               // z
  Eigen::MatrixXcd directions;          // δq = T y of each rate, of length 1 in the metric
  int n_unstable = 0, n_stable = 0;     // rates with positive and with negative real part

  bool hyperbolic() const { return n_unstable + n_stable == rates.size(); }
  /// 5.8.3: hyperbolic, with as many unstable directions as the Morse index says.
  bool obeys_5_8_3() const { return hyperbolic() && n_unstable == morse_index; }
};

/// Describes the critical point (q, λ). `added_damping` is a covector force −C v in addition to the system's own.
Status describe_critical_point(const AnyLandscape& landscape, const Eigen::VectorXd& q, const Eigen::VectorXd& lambda,
                               const Eigen::MatrixXd& added_damping, CriticalPoint& p);

}  // namespace pseudorigid::mechanics
