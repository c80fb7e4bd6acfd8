#pragma once
/// Figures of equilibrium of a deformable body, and the continuation along a family of figures. The positions x, the
/// multipliers λ and the drive ν of a figure satisfy
///
///   r = f(x) + ν h(x) + Gᵀλ = 0,   g(x) = 0,   G = Dg,
///
/// with the forces f except reactions, and the constraint g. A body without constraint has no λ. For a steady rotation
/// with the angular velocity Ω, the drive ν is Ω², and h is the centrifugal force at Ω = 1. For a body at rest, ν is a
/// factor of the loads h. A further condition selects a figure in its family. It prescribes ν or the ratio of two
/// axes. If it prescribes a ratio, ν is an unknown. The continuation from a known figure to another figure uses the
/// tangent of the family as the prediction and Newton's iteration as the correction.

#include <Eigen/Core>

#include "mechanics/core/status.h"

namespace pseudorigid::mechanics {

enum class Figure { spheroid, ellipsoid };

/// The force h that the drive multiplies: the centrifugal force of a rotation about axis 3, or all loads.
enum class Drive { rotation, loads };

/// The parameter of the figures in a family: ν, ln(a₂/a₁) or ln(a₃/a₁). The a_i are the entries of A = diag(a), the
/// affine part of x.
enum class FigureParameter { drive, log_ratio_21, log_ratio_31 };
/// The condition that `parameter` has the value `value` in the figure.
struct FigureCondition {
  FigureParameter parameter;
  double value;
};

/// A figure in internal units. `x` and `lambda` contain the coefficients of the positions and of the multipliers.
struct EquilibriumFigure {
  Eigen::VectorXd x, lambda;
  double drive = 0;  ///< the drive ν
  /// |r|_∞ divided by the largest entry of a term of r. For polynomial bodies, `residual` is 0 if all terms are
  /// round-off. For finite elements, the divisor is at least a typical elastic force on a node.
  double residual = 0;
};

/// Adds factor · change to x, λ and ν of `figure`.
void add(double factor, const EquilibriumFigure& change, EquilibriumFigure& figure);

/// Returns the index of the axis in the numerator of the ratio: 1 for log_ratio_21, 2 for log_ratio_31. The parameter
/// must not be `drive`.
inline int other_axis(FigureParameter parameter) { return parameter == FigureParameter::log_ratio_21 ? 1 : 2; }

/// The equations of the figures of one body.
class FigureEquations {
 public:
  virtual ~FigureEquations() = default;

  /// Returns the affine figure x = A X with A = diag(a), λ = 0 and this drive. X is the reference position. The figure
  /// need not satisfy the equations.
  virtual EquilibriumFigure affine(const Eigen::Vector3d& a, double drive) const = 0;
  /// Replaces `figure` by the figure of equilibrium near it that satisfies the condition. Fails if Newton's iteration
  /// does not converge, or if a force cannot be computed. `figure` is then not a figure of equilibrium.
  Status solve(const FigureCondition& condition, EquilibriumFigure& figure) const;
  /// Replaces `figure`, a known figure with the parameter `from`, by the figure with `condition` in the same family. A
  /// step is halved if Newton's iteration fails or does not stay close to the prediction. After a step that succeeds,
  /// the next step is doubled. A step changes the logarithm of a ratio of axes by at most 0.25. It is also shortened
  /// until no entry of x changes by more than 0.25 in the prediction, but not below 1/512 of the distance between the
  /// two parameters. Fails if a step would have to be shorter, for example because the family ends or turns back before
  /// `condition`. `figure` is then the last figure that was found. Also fails if a force of the last figure cannot be
  /// computed.
  Status follow(double from, const FigureCondition& condition, EquilibriumFigure& figure) const;
  /// Returns the derivative of ν along the family with respect to condition.parameter, or NaN if it cannot be computed.
  /// `figure` must satisfy the condition.
  double slope(const FigureCondition& condition, const EquilibriumFigure& figure) const {
    constexpr double tolerance = 1e-8;
    return tangent(condition, figure, tolerance).drive;
  }

  /// Returns a bound of the error of the drive of a figure, for example due to a quadrature.
  virtual double error_of_drive() const { return 1e-12; }

 private:
  /// Makes Newton's iteration from `figure`. Fails if the residual does not reach round-off, or if a force cannot be
  /// computed. `figure` becomes the iterate with the least residual, unless a force fails.
  virtual Status newton(const FigureCondition& condition, EquilibriumFigure& figure) const = 0;
  /// Returns the derivatives of x, λ and ν along the family with respect to condition.parameter. An iterative solver
  /// has the relative `tolerance`. The derivatives are NaN if they cannot be computed.
  virtual EquilibriumFigure tangent(const FigureCondition& condition, const EquilibriumFigure& figure,
                                    double tolerance) const = 0;
  /// Sets the residual of the figure, and the multipliers that Newton's iteration does not compute. Fails if a force
  /// cannot be computed.
  virtual Status complete(EquilibriumFigure& figure) const = 0;
  /// Returns true if x is an admissible deformation of the body.
  virtual bool is_admissible(const Eigen::VectorXd& x) const = 0;
  /// Returns a bound of the error that the linear solver of `tangent` causes in a prediction, relative to |x|.
  virtual double error_of_solver() const { return 1e-10; }
};

}  // namespace pseudorigid::mechanics
