#pragma once
/// Figures of a polynomial ball that rotate uniformly about axis 3 with the spin Ω. In the rotating frame, the position
/// x of a figure satisfies
///
///   r = f(x) + Ω²Px + Gᵀλ = 0,   g(x) = 0,      P the projection onto the plane normal to axis 3
///
/// without λ and g for a compressible body. f contains all forces without the reactions, g is the constraint with the
/// multiplier λ, and G = Dg. The residual is r. The equations are solved in the octant, whose symmetry planes exclude
/// rotations of space and of the ball. A spheroid is sought among motions with rotational symmetry about axis 3,
///
///   x = Σ u_nl (φ_nl1 e₁ + φ_nl,−1 e₂) + Σ w_nl φ_nl0 e₃.
///
/// The φ_nlm are the functions of ball_polynomials.h, the e_i are the unit vectors, and u_nl and w_nl are coefficients.
/// Within these motions the equations are not singular at a bifurcation to figures without this symmetry. The
/// quadrature by midpoints in the longitude does not break the symmetry. Therefore a solution within these motions
/// satisfies all equations. A figure of the family is determined by its spin Ω, or by the ratio of two axes of its mass
/// moment. In the second case Ω² is an unknown. The equations are solved by Newton's iteration with dense matrices and
/// exact derivatives. The columns of a matrix U are a basis of the permitted positions, and the columns of V are a
/// basis of the permitted pressures. With the unknowns y, μ and Ω², x = U y and λ = V μ.
///
/// The equations of a fluid do not determine x, because a fluid does not resist motions that only exchange matter
/// within its surface. However, a fluid ellipsoid is an exact figure for every degree N (Dirichlet, Riemann). Therefore
/// x is sought among affine motions. The pressure is then p_c(1 − |X|²), with the pressure p_c at the centre. The
/// remaining residual r is due to the quadrature of gravity. For N < 3, λ cannot represent this pressure, which also
/// contributes to r.
///
/// The equations include the volumetric stabilisation, like the equations of motion. The stabilisation has no effect on
/// an affine figure, or on small motions u about such a figure, because div u = 0 at every point. Therefore the
/// stabilisation has no effect on a fluid. A soft elastic body under its own gravity needs the stabilisation. If its
/// figure is not affine, the second variation of the pressure term can be positive or negative.

#include <memory>

#include "mechanics/equilibria/figures.h"
#include "polynomial/compressible_body.h"

namespace pseudorigid::polynomial {

using mechanics::EquilibriumFigure, mechanics::Figure, mechanics::FigureCondition, mechanics::FigureParameter;

/// The equations of these figures. The members `x` and `lambda` of EquilibriumFigure contain coefficients for the
/// octant, and the member `drive` is Ω². For a fluid, the residual of a figure contains the error of the quadrature of
/// gravity.
class SteadyRotations final : public mechanics::FigureEquations {
 public:
  /// `setup.reflect` is not used. The only loads that are used are self-gravity and, for a compressible body, the
  /// pressure.
  SteadyRotations(const BodySetup& setup, bool incompressible, Figure figure);

  /// The figure x = A X with A = diag(a), λ = 0 and Ω² = `spin_squared`. It need not satisfy the equations.
  EquilibriumFigure affine(const Eigen::Vector3d& a, double spin_squared) const override;

 private:
  /// The equations Uᵀr = 0, Vᵀg = 0 and the condition, for the unknowns y, μ and Ω² (head of this file).
  struct Equations {
    Eigen::VectorXd values;
    Eigen::MatrixXd derivative;
    double scale;  ///< 1 plus the largest entry of the terms of r, for comparison with `values`
  };
  /// Sets the three terms f, Ω²Px and Gᵀλ of the residual r. Fails if the force cannot be computed.
  mechanics::Status terms(const EquilibriumFigure& rotation, Eigen::VectorXd& f, Eigen::VectorXd& centrifugal,
                          Eigen::VectorXd& reaction) const;
  /// Sets `result` to the equations at `rotation`, with their derivative. Fails if the force cannot be computed.
  mechanics::Status equations(const FigureCondition& condition, const EquilibriumFigure& rotation,
                              Equations& result) const;
  Eigen::MatrixXd tangent_matrix(const EquilibriumFigure& rotation) const;
  void add_condition(const FigureCondition& condition, const EquilibriumFigure& rotation, Equations& result) const;
  mechanics::Status newton(const FigureCondition& condition, EquilibriumFigure& rotation) const override;
  EquilibriumFigure tangent(const FigureCondition& condition, const EquilibriumFigure& rotation) const override;
  mechanics::Status complete(EquilibriumFigure& rotation) const override;
  bool is_admissible(const Eigen::VectorXd& x) const override { return body_->admissible(x).ok(); }
  /// The changes of x, λ and Ω² for a step of the unknowns (y, μ, Ω²).
  EquilibriumFigure change(const Eigen::VectorXd& step) const;

  bool incompressible_, is_fluid_;
  std::shared_ptr<const CompressibleBody> body_;  ///< the body in the octant; its force has no reactions
  Eigen::MatrixXd U_, V_;                         ///< matrices U and V; V has no columns if λ is not an unknown
};

/// Returns `setup` with only the loads that a steady rotation can have: self-gravity, and the pressure on a
/// compressible body.
BodySetup conservative_setup(BodySetup setup, bool incompressible);

/// The coefficients of Px, which is the position x with the third component set to 0. The space may have any symmetry
/// planes.
Eigen::VectorXd across_axis_3(const PolynomialSpace& space, Eigen::VectorXd x);

}  // namespace pseudorigid::polynomial
