#pragma once
/// The pseudo-rigid body at rest: critical points of its potential energy on SL(3) or GL⁺(3) (Oliva 5.8 applied
/// to 5.7),
///
///   ∂V/∂Q = Λ Q⁻ᵀ,   ln det Q = 0     (on GL⁺(3): Λ = 0 in place of the second)
///
/// with the second derivative of V − Λ ln det along H, the metric and the damping at rest,
///
///   D(∂V)(Q)[H] + Λ Q⁻ᵀHᵀQ⁻ᵀ,   ⟨H, H⟩ = tr(H E₀ Hᵀ),   −C H = −∂R/∂Q̇ at Q̇ = H.
///
/// All are exact. Morse index, nullity and rates are those of mechanics/equilibria/critical_point.h: a body that may be
/// turned, in space or within, without a change of V has a nullity for that.

#include <Eigen/Dense>

#include <vector>

#include "mechanics/core/status.h"
#include "mechanics/equilibria/critical_points.h"
#include "reduced/dissipation.h"
#include "reduced/potential.h"

namespace pseudorigid::reduced {

/// V on the matrices Q, whose columns stand one below the other in vectors of 9 entries.
class StaticLandscape {
 public:
  using Vector = Eigen::VectorXd;
  using Matrix = Eigen::MatrixXd;

  StaticLandscape(Potential potential, const ReferenceBody& body, const Dissipation& dissipation, bool incompressible)
      : potential_(std::move(potential)), body_(body), dissipation_(dissipation), incompressible_(incompressible) {}

  int n_coordinates() const { return 9; }
  int n_constraints() const { return incompressible_ ? 1 : 0; }
  Vector periods() const { return Vector::Zero(9); }
  double potential(const Vector& q) const { return potential_.energy(matrix(q)); }
  mechanics::Status gradient(const Vector& q, Vector& dV) const;
  mechanics::Status constraint(const Vector& q, Vector& g) const;
  void constraint_gradient(const Vector& q, Matrix& G) const;
  mechanics::Status hessian(const Vector& q, const Vector& lambda, Matrix& H) const;
  void mass(const Vector& q, Matrix& M) const;
  mechanics::Status damping(const Vector& q, Matrix& C) const;

  static Eigen::Matrix3d matrix(const Vector& q) { return q.reshaped(3, 3); }

  /// Whether V rises outwards where |ln S| = s > 0, Q = R₁ S R₂ with S diagonal: looked for by 64 descents to the least
  /// slope over the directions of S and both rotations.
  bool rises_at(double s) const;

 private:
  mechanics::Status admissible(const Eigen::Matrix3d& Q) const;
  double outward_slope(double s, const Eigen::VectorXd& direction) const;

  Potential potential_;
  ReferenceBody body_;
  Dissipation dissipation_;
  bool incompressible_;
};

/// Whether Morse's count (mechanics/equilibria/morse_count.h) says that equilibria are missing among these. SL(3) and
/// GL⁺(3) retract along the stretches to SO(3), and so does each of their parts |ln S| ≤ s, whose Betti numbers over
/// Z/2 are 1, 1, 1, 1: if V rises at such a boundary around the points, there is at least one each of index 0 to 3,
/// and the numbers of even and odd index are equal. That holds for every law and load. It cannot judge degenerate
/// points, as those of a body that may be turned without a change of V, nor if V falls outwards.
bool misses_equilibria(const StaticLandscape& landscape, const std::vector<mechanics::CriticalPoint>& points);

/// A search that starts from Q = Id, from the four rotations that a dead traction leaves at rest in a body that is
/// almost rigid, and then from Q = R₁ diag(exp s) R₂ with rotations and |s_i| < 1.5 by chance.
mechanics::CriticalPointSearch static_search(bool incompressible, const Eigen::Matrix3d& nominal_traction,
                                             int n_starts);

}  // namespace pseudorigid::reduced
