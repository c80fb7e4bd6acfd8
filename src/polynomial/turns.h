#pragma once
/// Turns of a polynomial ball, on coefficients of the whole body: those of space, x ↦ ê×x, and those of the reference
/// ball, x ↦ ∂x/∂X (ê×X). Both map P_N to itself; the second takes R_nl Y_lm to functions of the same n and l.
///
/// A field that is turned as a whole, J_e u = ê×u − ∂u/∂X (ê×X), tells the degree of a motion: −Σ_e J_e² u = n(n + 1) u
/// for a motion of degree n, toroidal or spheroidal.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "polynomial/polynomial_space.h"

namespace pseudorigid::polynomial {

class Turns {
 public:
  /// For a ball without symmetry planes. The space must outlive this object.
  explicit Turns(const PolynomialSpace& space);

  Eigen::Index n_unknowns() const { return space_.n_unknowns(); }
  /// ê×x
  Eigen::VectorXd of_space(int axis, const Eigen::VectorXd& x) const;
  /// ∂x/∂X (ê×X)
  Eigen::VectorXd of_ball(int axis, const Eigen::VectorXd& x) const;
  /// −Σ_e J_e² u
  Eigen::VectorXd square(const Eigen::VectorXd& u) const;

 private:
  const PolynomialSpace& space_;
  std::vector<BallPolynomial> functions_;
  std::array<std::vector<Eigen::MatrixXd>, 3> of_harmonics_;  ///< [axis][l](m', m): ∫Y_lm' (ê×ω)·∇Y_lm dω
};

}  // namespace pseudorigid::polynomial
