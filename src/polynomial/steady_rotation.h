#pragma once
/// Figures of a polynomial ball that turn uniformly about axis 3. In the frame that turns with them,
///
///   r = f(x) + Ω²Px + Gᵀλ = 0,   g(x) = 0,      P the projection across axis 3                [compressible: no λ, g]
///
/// in the octant, whose planes take the turns of space and of the ball out. A spheroid is sought among motions that
/// have a symmetry of revolution,
///
///   x = Σ u_nl (φ_nl1 e₁ + φ_nl,−1 e₂) + Σ w_nl φ_nl0 e₃,
///
/// where nothing is singular at a bifurcation to other figures. Midpoints in the longitude keep that symmetry: a figure
/// found so solves all of the equations. Of the family of figures one is singled out by its spin, or by the ratio of
/// two axes of its mass moment, with Ω² unknown; Newton's iteration goes on dense matrices with exact derivatives.
///
/// A fluid resists no change that moves no matter through its surface, so its equations do not determine x. But a fluid
/// ellipsoid is an exact figure for every degree (Dirichlet, Riemann), so x is sought among affine motions, with the
/// pressure p_c(1 − |X|²) that belongs to it. The remainder of r is the error of the quadrature of gravity, and of a λ
/// of degree N − 1 < 2.
///
/// The volumetric stabilisation belongs to the body as in its motions. It does nothing to an affine figure or to small
/// motions about one, where div u = 0 at every point, and so nothing to a fluid. A soft elastic body under its own
/// gravity needs it: the pressure of a figure that is not affine has a second variation without sign.

#include <memory>

#include "polynomial/compressible_body.h"

namespace pseudorigid::polynomial {

enum class Figure { spheroid, ellipsoid };

/// The parameter of a figure in its family: Ω², ln(a₂/a₁) or ln(a₃/a₁), of the affine part A = diag(a) of x.
enum class FigureParameter { spin_squared, log_ratio_21, log_ratio_31 };
struct FigureCondition {
  FigureParameter parameter;
  double value;
};

/// Internal units. x and λ are coefficients of the octant.
struct SteadyRotation {
  Eigen::VectorXd x, lambda;
  double spin_squared = 0;
  double residual = 0;  ///< |r|_∞ over the largest of its terms
};

class SteadyRotations {
 public:
  /// `setup.reflect` is not used, nor loads other than gravity and pressure.
  SteadyRotations(const BodySetup& setup, bool incompressible, Figure figure);

  /// The affine figure x = A X, A diagonal.
  SteadyRotation affine(const Eigen::Vector3d& a, double spin_squared) const;

  /// The figure near `rotation` that meets the condition.
  mechanics::Status solve(const FigureCondition& condition, SteadyRotation& rotation) const;
  /// Continuation from a known equilibrium at the parameter `from`, with steps that are as long as Newton's
  /// iteration stays close to its prediction.
  mechanics::Status follow(double from, const FigureCondition& condition, SteadyRotation& rotation) const;
  /// dΩ² by the parameter along the family.
  double slope(const FigureCondition& condition, const SteadyRotation& rotation) const;

 private:
  struct Equations {
    Eigen::VectorXd values;
    Eigen::MatrixXd derivative;
    double scale;  ///< size of the values whose differences are taken
  };
  mechanics::Status terms(const SteadyRotation& rotation, Eigen::VectorXd& f, Eigen::VectorXd& centrifugal,
                          Eigen::VectorXd& reaction) const;
  mechanics::Status equations(const FigureCondition& condition, const SteadyRotation& rotation,
                              Equations& result) const;
  Eigen::MatrixXd tangent_matrix(const SteadyRotation& rotation) const;
  void add_condition(const FigureCondition& condition, const SteadyRotation& rotation, Equations& result) const;
  /// Derivatives of (y, μ, Ω²) by the parameter.
  Eigen::VectorXd tangent(const FigureCondition& condition, const SteadyRotation& rotation) const;
  void add(double factor, const Eigen::VectorXd& step, SteadyRotation& rotation) const;
  mechanics::Status newton(const FigureCondition& condition, SteadyRotation& rotation) const;
  mechanics::Status complete(SteadyRotation& rotation) const;

  bool incompressible_, is_fluid_;
  std::shared_ptr<const CompressibleBody> body_;  ///< all forces but reactions, in the octant
  Eigen::MatrixXd U_, V_;                         ///< x = U y, λ = V μ
};

/// `setup` with the loads that have a part in a steady rotation: gravity, and the pressure on a compressible body.
BodySetup conservative_setup(BodySetup setup, bool incompressible);

/// Px of the coefficients of any sector: the third component is left out.
Eigen::VectorXd across_axis_3(const PolynomialSpace& space, Eigen::VectorXd x);

}  // namespace pseudorigid::polynomial
