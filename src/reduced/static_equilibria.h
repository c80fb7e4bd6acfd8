#pragma once
/// The pseudo-rigid body at rest: critical points of its potential energy V on SL(3) or GL⁺(3) (Oliva 5.7 and 5.8).
/// With the multiplier Λ they satisfy
///
///   ∂V/∂Q = Λ Q⁻ᵀ,   ln det Q = 0     (on GL⁺(3), Λ = 0 replaces the second equation)
///
/// The second derivative of V − Λ ln det Q along H, the metric and the damping at rest are
///
///   D(∂V)(Q)[H] + Λ Q⁻ᵀHᵀQ⁻ᵀ,   ⟨H, H⟩ = tr(H E₀ Hᵀ),   −C H = −∂R/∂Q̇ at Q̇ = H
///
/// with the inertia E₀ of the reference body and Rayleigh's function R (dissipation.h). The derivatives are exact.
/// mechanics/equilibria/critical_point.h defines the Morse index, the nullity and the rates. If rotations of space or
/// of the reference body do not change V, the nullity includes the directions of these rotations.

#include <Eigen/Dense>

#include <vector>

#include "mechanics/core/status.h"
#include "mechanics/equilibria/critical_points.h"
#include "reduced/dissipation.h"
#include "reduced/potential.h"

namespace pseudorigid::reduced {

/// The potential V on the matrices Q, for the search for critical points (mechanics/equilibria/critical_points.h). A
/// vector has 9 entries, the columns of Q one after the other.
class StaticLandscape {
 public:
  using Vector = Eigen::VectorXd;
  using Matrix = Eigen::MatrixXd;

  StaticLandscape(Potential potential, const ReferenceBody& body, const Dissipation& dissipation, bool incompressible)
      : potential_(std::move(potential)), body_(body), dissipation_(dissipation), incompressible_(incompressible) {}

  int n_coordinates() const { return 9; }
  int n_constraints() const { return incompressible_ ? 1 : 0; }
  /// The periods of the coordinates: 0, because no coordinate is periodic.
  Vector periods() const { return Vector::Zero(9); }
  double potential(const Vector& q) const { return potential_.energy(matrix(q)); }
  /// Sets dV to ∂V/∂Q. Fails if det Q is not positive and finite, or if the law does not admit Q. Also fails if det Q ≤
  /// 1e-8 for a compressible body, or if ∂V/∂Q is not finite.
  mechanics::Status gradient(const Vector& q, Vector& dV) const;
  /// Sets g to ln det Q, or to a vector without entries on GL⁺(3). Fails if det Q is not positive and finite.
  mechanics::Status constraint(const Vector& q, Vector& g) const;
  /// Sets G to the row Q⁻ᵀ, the derivative of ln det Q, or to a matrix without rows on GL⁺(3).
  void constraint_gradient(const Vector& q, Matrix& G) const;
  /// Sets H to the second derivative of V − Λ ln det Q, with Λ = 0 on GL⁺(3). Fails if H is not finite, and in the
  /// cases in which `gradient` fails because of Q.
  mechanics::Status hessian(const Vector& q, const Vector& lambda, Matrix& H) const;
  /// Sets M to the matrix of the metric ⟨H, H⟩, which does not depend on q.
  void mass(const Vector& q, Matrix& M) const;
  /// Sets C to the matrix of the damping at rest. Does not fail.
  mechanics::Status damping(const Vector& q, Matrix& C) const;

  static Eigen::Matrix3d matrix(const Vector& q) { return q.reshaped(3, 3); }

  /// Returns true if V increases with s at all tested points of the surface |ln S| = s > 0. Here Q = R₁SR₂ with
  /// rotations R₁, R₂ and a diagonal S. The function searches for a slope dV/ds that is not positive by 64 random
  /// descents, over the directions of ln S and both rotations. The result is false if the search finds such a slope.
  bool rises_at(double s) const;

 private:
  /// Fails if det Q is not positive and finite, if det Q of a compressible body is at most 1e-8, or if the law does not
  /// admit Q.
  mechanics::Status admissible(const Eigen::Matrix3d& Q) const;
  double outward_slope(double s, const Eigen::VectorXd& direction) const;

  Potential potential_;
  ReferenceBody body_;
  Dissipation dissipation_;
  bool incompressible_;
};

/// Returns true if the list `points` lacks equilibria according to Morse's count (mechanics/equilibria/morse_count.h).
/// The count needs a bounded part of SL(3) or GL⁺(3) that contains all points, and at whose boundary V increases
/// outwards. The part is |ln S| ≤ s, with the singular values S of Q; `rises_at` tests two values of s. Such a part
/// contracts to SO(3), whose Betti numbers over Z/2 are 1, 1, 1, 1. The part therefore contains at least one
/// equilibrium of each Morse index 0 to 3, and as many of even index as of odd index. This condition does not depend on
/// law or loads.
///
/// Returns false if the points satisfy the condition, or if a point is degenerate. For example, points are degenerate
/// if rotations do not change V. Also returns false if `rises_at` finds a slope that is not positive for both values of
/// s.
bool misses_equilibria(const StaticLandscape& landscape, const std::vector<mechanics::CriticalPoint>& points);

/// Returns a search with n_starts starting points. The first point is Q = Id. If there is a dead traction, the next
/// points are the four rotations at which an almost rigid body is in equilibrium. All other points are random: Q = R₁
/// diag(exp s) R₂ with rotations R₁, R₂ and |s_i| < 1.5. On SL(3) the mean of s is subtracted from its entries.
mechanics::CriticalPointSearch static_search(bool incompressible, const Eigen::Matrix3d& nominal_traction,
                                             int n_starts);

}  // namespace pseudorigid::reduced
