#pragma once
/// Stability of a figure of equilibrium of the finite-element ball, and the rates of small motions about it. In the
/// frame that rotates with the spin Ω ê₃ of the figure, small motions u of the whole ball satisfy
///
///   M ü + 2Ω M ê₃×u̇ + K u − Gᵀμ = 0,   G u = 0
///
/// with the tangent K (tangent_problem.h), the mass M, the derivative G of the constraint and its multiplier μ. For a
/// ball at rest, Ω = 0. The force of Coriolis couples two parities of modes/parity.h, so there are four classes. A
/// class is even or odd under the reflection of axis 3, and even or odd under the half turn about axis 3.
///
/// In each class the equations are projected onto a basis (Galerkin). The basis contains the lowest eigenvectors of K u
/// − Gᵀμ = κ M u of both parities, and the static responses to their forces of Coriolis. It also contains the rotations
/// of space and of the ball. The dense problem is solved by mechanics/equilibria/linear_stability.h, which removes
/// rotations together with their momenta. Without rotation the rates are exact for the mesh. With rotation the
/// projection causes an error that falls as the number of eigenvectors increases. Uniform translations are not
/// included.
///
/// The exchange of the axes 1 and 2 maps a spheroid to itself. It maps displacements that are odd in axis 1 and even in
/// axis 2 to displacements that are even in axis 1 and odd in axis 2. Only the eigenvectors of the first kind are
/// computed. The eigenvectors of the second kind are their images.
///
/// The mesh is not symmetric under rotations of the ball. Their removal therefore has the error of the mesh.

#include <array>
#include <complex>
#include <cstddef>
#include <optional>
#include <vector>

#include "continuum/modes/parity.h"
#include "continuum/statics/ball_figures.h"
#include "mechanics/equilibria/figure_family.h"

namespace pseudorigid::continuum {

/// Sets `classes` to the stability in the four classes, or only in the class with the index `only`
/// (mechanics::StabilityOfFigure). `n_eigenvectors` is the number of eigenvectors of each parity.
/// The smaller basis (mechanics::ClassStability) has three fifths of them. The azimuthal number m of a class is 0 if
/// its motions are even under the half turn, and otherwise 1. Fails if an eigenvalue problem does not converge, or if
/// the figure is unstable with a rate above about 8√k in internal units. For a rotation, k is typical_stiffness() plus
/// Ω². For a ball at rest, k is typical_stiffness(), plus the largest stiffness per mass with which a quadratic
/// potential repels the ball from the centre.
mechanics::Status stability_of(const BallFigures& figures, const mechanics::EquilibriumFigure& figure,
                               int n_eigenvectors, std::optional<std::size_t> only,
                               std::vector<mechanics::ClassStability>& classes);

/// A small motion Re(y exp(st)) of the whole ball in the rotating frame. The shape y is the sum of the displacements of
/// the two parities of a class.
struct SmallMotionOfBall {
  /// A complex displacement with this parity, on the octant.
  struct Part {
    Parity parity;
    Vector real, imaginary;
  };
  std::complex<double> rate;  ///< s
  std::array<Part, 2> parts;
};

/// Sets `motion` to the small motion whose rate is nearest to `rate`, among the motions in the span of the same basis.
/// `of_class` is the index of its class in the result of stability_of. Fails in the same cases as stability_of, or if
/// the iteration for the motion does not converge.
mechanics::Status small_motion_of(const BallFigures& figures, const mechanics::EquilibriumFigure& figure,
                                  int n_eigenvectors, std::size_t of_class, std::complex<double> rate,
                                  SmallMotionOfBall& motion);

}  // namespace pseudorigid::continuum
