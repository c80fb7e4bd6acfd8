#pragma once
/// Figures of equilibrium of a polynomial ball: steady rotations about axis 3, and the ball at rest under loads
/// (mechanics/equilibria/figures.h). The position x of a figure satisfies
///
///   r = f(x) + ν h(x) + Gᵀλ = 0,   g(x) = 0,
///
/// without λ and g for a compressible body. g is the constraint with the multiplier λ, and G = Dg. The residual is r.
/// f contains the elastic force, the volumetric stabilisation and self-gravity. For a rotation of a compressible ball,
/// f also contains the pressure on the surface. For a rotation with the spin Ω, ν = Ω² and h = Px, with the projection
/// P onto the plane normal to axis 3. For the ball at rest, ν is the factor of the loads h.
///
/// The equations are solved in the octant, whose symmetry planes exclude rotations of space and of the ball. A spheroid
/// is sought among motions with rotational symmetry about axis 3,
///
///   x = Σ u_nl (φ_nl1 e₁ + φ_nl,−1 e₂) + Σ w_nl φ_nl0 e₃.
///
/// The φ_nlm are the functions of ball_polynomials.h, the e_i are the unit vectors, and u_nl and w_nl are coefficients.
/// Within these motions the equations are not singular at a bifurcation to figures without this symmetry. The
/// quadrature by midpoints in the longitude does not break the symmetry. Therefore a solution within these motions
/// satisfies all equations. A figure of the family is determined by ν, or by the ratio of two axes of its mass moment.
/// In the second case ν is an unknown. The equations are solved by Newton's iteration with dense matrices and exact
/// derivatives. The columns of a matrix U are a basis of the permitted positions, and the columns of V are a basis of
/// the permitted pressures. With the unknowns y, μ and ν, x = U y and λ = V μ.
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

#include <array>
#include <memory>

#include "mechanics/equilibria/figures.h"
#include "polynomial/compressible_body.h"

namespace pseudorigid::polynomial {

using mechanics::Drive, mechanics::EquilibriumFigure, mechanics::Figure, mechanics::FigureCondition,
    mechanics::FigureParameter;

/// The body whose figures are sought.
struct FigureSetup {
  /// `reflect` is not used. A rotation has only self-gravity and, for a compressible body, the pressure as loads.
  /// The ball at rest has self-gravity, and as loads h the quadratic potential, the nominal traction and, for a
  /// compressible body, the pressure.
  BodySetup body;
  bool incompressible;
  Drive drive;
  Figure figure;
};

/// Returns the setup of the body with only those loads of a figure that act at ν = 1. The symmetry planes are those of
/// setup.body.
BodySetup acting_setup(const FigureSetup& setup);

/// The forces of one figure without the reactions, f(x) + ν h(x), for a body in a sector of the ball.
class FigureForces {
 public:
  /// `reflect` has the symmetry planes of the sector.
  FigureForces(const FigureSetup& setup, const std::array<bool, 3>& reflect);

  const CompressibleBody& body() const { return *body_; }
  Drive drive() const { return drive_; }
  /// Sets `force` to f(x) and `load` to h(x). Fails if x is not an admissible deformation.
  mechanics::Status evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& force, Eigen::VectorXd& load) const;
  /// Returns the derivative of f + ν h at x along u.
  Eigen::VectorXd rate(const Eigen::VectorXd& x, double nu, const Eigen::VectorXd& u) const;

 private:
  Drive drive_;
  std::shared_ptr<const CompressibleBody> body_;       ///< the body with the forces f
  std::shared_ptr<const CompressibleBody> load_body_;  ///< a body whose only forces are h; null for a rotation
};

/// The equations of these figures. The members `x` and `lambda` of EquilibriumFigure contain coefficients for the
/// octant, and the member `drive` is ν. For a fluid, the residual of a figure contains the error of the quadrature of
/// gravity.
class BodyFigures final : public mechanics::FigureEquations {
 public:
  explicit BodyFigures(const FigureSetup& setup);

  /// The figure x = A X with A = diag(a), λ = 0 and this drive ν. It need not satisfy the equations.
  EquilibriumFigure affine(const Eigen::Vector3d& a, double drive) const override;
  /// Contains the round-off of gravity, which is proportional to Newton's constant.
  double error_of_drive() const override { return error_of_drive_; }

 private:
  /// The equations Uᵀr = 0, Vᵀg = 0 and the condition, for the unknowns y, μ and ν (head of this file).
  struct Equations {
    Eigen::VectorXd values;
    Eigen::MatrixXd derivative;
    double scale;  ///< 1 plus the largest entry of the terms of r, for comparison with `values`
  };
  /// The terms f, h and Gᵀλ of the residual r.
  struct Terms {
    Eigen::VectorXd force, load, reaction;
    /// The residual r, and the largest entry of its terms f, ν h and Gᵀλ, for the drive ν.
    Eigen::VectorXd residual(double nu) const;
    double scale(double nu) const;
  };
  /// Sets the terms at a figure. Fails if the force cannot be computed.
  mechanics::Status terms(const EquilibriumFigure& figure, Terms& terms) const;
  /// Sets `result` to the equations at a figure, with their derivative. Fails if the force cannot be computed.
  mechanics::Status equations(const FigureCondition& condition, const EquilibriumFigure& figure,
                              Equations& result) const;
  Eigen::MatrixXd tangent_matrix(const EquilibriumFigure& figure) const;
  void add_condition(const FigureCondition& condition, const EquilibriumFigure& figure, Equations& result) const;
  mechanics::Status newton(const FigureCondition& condition, EquilibriumFigure& figure) const override;
  EquilibriumFigure tangent(const FigureCondition& condition, const EquilibriumFigure& figure,
                            double tolerance) const override;
  mechanics::Status complete(EquilibriumFigure& figure) const override;
  bool is_admissible(const Eigen::VectorXd& x) const override { return body().admissible(x).ok(); }
  const CompressibleBody& body() const { return forces_.body(); }
  const PolynomialSpace& space() const { return body().space(); }
  /// The changes of x, λ and ν for a step of the unknowns (y, μ, ν).
  EquilibriumFigure change(const Eigen::VectorXd& step) const;

  bool incompressible_, is_fluid_;
  double error_of_drive_;
  FigureForces forces_;    ///< forces on the octant
  Eigen::MatrixXd U_, V_;  ///< matrices U and V; V has no columns if λ is not an unknown
};

/// The coefficients of Px, which is the position x with the third component set to 0. The space may have any symmetry
/// planes.
Eigen::VectorXd across_axis_3(const PolynomialSpace& space, Eigen::VectorXd x);

}  // namespace pseudorigid::polynomial
