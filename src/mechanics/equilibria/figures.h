#pragma once
/// Figures of equilibrium of a deformable body, and the continuation along a family of figures. The positions x, the
/// multipliers λ and the drive ν of a figure satisfy
///
///   r = f(x) + ν h(x) + Gᵀλ = 0,   g(x) = 0,   G = Dg,
///
/// with the forces f without reactions and the constraint g. A body without constraint has no λ. The drive ν is Ω² for
/// a steady rotation with the spin Ω, and h is then the centrifugal force at Ω = 1. For a body at rest, ν is the factor
/// of the loads h. A further condition determines the figure in its family: the drive, or the ratio of two axes. In the
/// second case ν is an unknown. The continuation from a known figure to another figure uses the tangent of the family
/// as the prediction and Newton's iteration as the correction.

#include <Eigen/Core>

#include "mechanics/core/status.h"

namespace pseudorigid::mechanics {

enum class Figure { spheroid, ellipsoid };

/// The parameter of a figure in its family: ν, ln(a₂/a₁) or ln(a₃/a₁), with the affine part A = diag(a) of x.
enum class FigureParameter { drive, log_ratio_21, log_ratio_31 };
/// The condition that `parameter` has the value `value` in the figure.
struct FigureCondition {
  FigureParameter parameter;
  double value;
};

/// A figure in internal units. x and λ are the coefficients of the body.
struct EquilibriumFigure {
  Eigen::VectorXd x, lambda;
  double drive = 0;     ///< the drive ν
  double residual = 0;  ///< |r|_∞ divided by the largest entry of a term of r; 0 if all terms are round-off
};

/// Adds factor · change to x, λ and ν of `figure`.
void add(double factor, const EquilibriumFigure& change, EquilibriumFigure& figure);

/// Returns the index, 1 or 2, of the axis whose ratio to the axis of index 0 is the parameter. The parameter must be a
/// ratio of axes.
inline int other_axis(FigureParameter parameter) { return parameter == FigureParameter::log_ratio_21 ? 1 : 2; }

/// The equations of the figures of one body.
class FigureEquations {
 public:
  virtual ~FigureEquations() = default;

  /// Returns the affine figure x = A X with A = diag(a), λ = 0 and this drive. X is the reference position. The figure
  /// need not satisfy the equations.
  virtual EquilibriumFigure affine(const Eigen::Vector3d& a, double drive) const = 0;
  /// Moves `figure` to the figure near it that satisfies the condition. Fails if Newton's iteration does not converge,
  /// or if a force cannot be computed; `figure` is then not a figure of equilibrium.
  Status solve(const FigureCondition& condition, EquilibriumFigure& figure) const;
  /// Moves `figure`, a known figure with the parameter `from`, along the family to the figure with `condition`. A step
  /// is halved if Newton's iteration fails or does not stay close to the prediction. After a step that succeeds, the
  /// next step is doubled up to a bound. Fails if a step becomes shorter than 1/512 of the distance between the two
  /// parameters, for example because the family ends or turns back before `condition`. `figure` is then the last figure
  /// found. Also fails if a force cannot be computed at the end.
  Status follow(double from, const FigureCondition& condition, EquilibriumFigure& figure) const;
  /// Returns the derivative of ν with respect to the parameter along the family, or NaN if it cannot be computed.
  double slope(const FigureCondition& condition, const EquilibriumFigure& figure) const {
    return tangent(condition, figure).drive;
  }

 private:
  /// Makes Newton's iteration from `figure`. Fails if the residual does not reach round-off, or if a force cannot be
  /// computed. `figure` becomes the iterate with the least residual, unless a force fails.
  virtual Status newton(const FigureCondition& condition, EquilibriumFigure& figure) const = 0;
  /// Returns the derivatives of x, λ and ν with respect to the parameter. They are NaN if they cannot be computed.
  virtual EquilibriumFigure tangent(const FigureCondition& condition, const EquilibriumFigure& figure) const = 0;
  /// Completes a figure: computes the residual, and multipliers that Newton's iteration leaves out. Fails if a force
  /// cannot be computed.
  virtual Status complete(EquilibriumFigure& figure) const = 0;
  /// Returns true if x is an admissible deformation of the body.
  virtual bool is_admissible(const Eigen::VectorXd& x) const = 0;
  /// Returns a bound of the error in |x| that the linear solver of `tangent` causes in a prediction.
  virtual double error_of_solver() const { return 1e-10; }
};

}  // namespace pseudorigid::mechanics
