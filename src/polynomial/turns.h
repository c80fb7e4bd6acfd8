#pragma once
/// Infinitesimal rotations of a polynomial ball of degree N, which act on coefficients of the whole body. Let ê be the
/// unit vector of an axis e. The rotations of space are x ↦ ê×x, and the rotations of the reference ball are x ↦ ∂x/∂X
/// (ê×X). Both rotations map polynomials of degree at most N to polynomials of degree at most N. The rotations of the
/// reference ball map R_nl Y_lm (ball_polynomials.h) to sums of functions with the same n and l.
///
/// The joint rotation of a field u is J_e u = ê×u − ∂u/∂X (ê×X). A toroidal or spheroidal motion u of degree n
/// satisfies −Σ_e J_e² u = n(n + 1) u.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "polynomial/polynomial_space.h"

namespace pseudorigid::polynomial {

class Turns {
 public:
  /// `space` must not have symmetry planes, and must outlive this object.
  explicit Turns(const PolynomialSpace& space);

  Eigen::Index n_unknowns() const { return space_.n_unknowns(); }
  /// Coefficients of ê×x for the unit vector ê of the axis 0, 1 or 2.
  Eigen::VectorXd of_space(int axis, const Eigen::VectorXd& x) const;
  /// Coefficients of ∂x/∂X (ê×X).
  Eigen::VectorXd of_ball(int axis, const Eigen::VectorXd& x) const;
  /// Coefficients of −Σ_e J_e² u, with the joint rotations J_e about the three axes e.
  Eigen::VectorXd square(const Eigen::VectorXd& u) const;

 private:
  const PolynomialSpace& space_;
  std::vector<BallPolynomial> functions_;
  /// [axis][l](m', m): ∫Y_lm' (ê×ω)·∇Y_lm dω over the points ω of the unit sphere.
  std::array<std::vector<Eigen::MatrixXd>, 3> of_harmonics_;
};

}  // namespace pseudorigid::polynomial
