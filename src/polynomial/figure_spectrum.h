#pragma once
/// Small motions u about a figure of equilibrium (body_figures.h). In the frame that rotates with the spin Ω ê₃ of the
/// figure, they satisfy
///
///   ü + 2Ω ê₃×u̇ + Ku = 0 on ker G,   K = −D(f + ν h) − Σ_b λ_b D²g_b
///
/// with the forces f, the drive ν and its force h, the constraints g_b, their multipliers λ_b, and G = Dg. For a ball
/// at rest, Ω = 0. The growth rates are computed by mechanics/equilibria/linear_stability.h. The motions are those of
/// the whole body, without symmetry. The motions belong to classes that are not coupled. A class is even or odd under
/// the reflection of axis 3, and even or odd under the half turn about axis 3. On a spheroid, the classes also have an
/// azimuthal number m, with cylindrical components u ~ e^{imφ}. Each class is a dense eigenvalue problem. Together the
/// classes give the growth rates of all motions except the following.
///
/// The analysis removes motions that give no information on the figure, together with their momenta. These are uniform
/// motions, and the rotations of space and of the reference ball that the loads permit. The momenta of the rotations
/// are the angular momentum J and the circulation Z. Rotations of the ball do not change exact integrals, but change
/// quadrature sums by the error of the quadrature. For a fluid, all motions A w(X) that only exchange matter within the
/// figure are also removed. Here A is the affine part of the figure, div w = 0 in the ball, and w·X = 0 on its surface.
/// The momenta of these motions are the circulations (Kelvin), so the remaining motions have fixed circulations.
///
/// K maps motions of each of the eight parities to the same parity. Therefore one call of the force rate gives a column
/// for each parity.

#include <complex>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "mechanics/equilibria/figure_family.h"
#include "mechanics/equilibria/linear_stability.h"
#include "mechanics/equilibria/small_motion.h"
#include "polynomial/body_figures.h"
#include "polynomial/turns.h"

namespace pseudorigid::polynomial {

using mechanics::ClassStability, mechanics::MotionClass;

class FigureSpectrum {
 public:
  explicit FigureSpectrum(const FigureSetup& setup);

  const PolynomialSpace& space() const { return forces_.body().space(); }
  /// The spin Ω of a figure.
  double spin(const EquilibriumFigure& figure) const;
  /// The coefficients of a position for the whole body. x has the coefficients for the octant.
  Eigen::VectorXd whole(const Eigen::VectorXd& x) const;
  /// The multiplier for the whole body. `lambda` has the multiplier for the octant.
  Eigen::VectorXd whole_multiplier(const Eigen::VectorXd& lambda) const;

  /// Sets `classes` to the stability of all classes, in the same order for every figure, or only of the class with the
  /// index `only` (mechanics::StabilityOfFigure). Fails if a matrix of a class is not finite, or if its eigenvalues do
  /// not converge.
  mechanics::Status analyse(const EquilibriumFigure& figure, std::optional<std::size_t> only,
                            std::vector<ClassStability>& classes) const;
  /// Sets `motion` to the small motion whose rate is nearest to `rate`. Its shape has the coefficients of the whole
  /// body. `of_class` is the index of its class in the result of `analyse`. Fails if the iteration for the motion does
  /// not converge.
  mechanics::Status motion(const EquilibriumFigure& figure, std::size_t of_class, std::complex<double> rate,
                           mechanics::SmallMotion& motion) const;

 private:
  /// A class of motions. Each column of `fields` has the coefficients of a motion of the whole body, and the columns
  /// are a basis of the class.
  struct Part {
    MotionClass motions;
    Eigen::MatrixXd fields;
    /// A basis of the motions w in the class (head of this file), one in each column. For a solid, it has no columns.
    Eigen::MatrixXd exchanges;
  };
  /// The linear equation of a class in the coordinates z of a basis T of its motions, u = T z. The columns of T satisfy
  /// the constraint.
  struct ClassEquation {
    Eigen::MatrixXd T;
    Eigen::MatrixXd stiffness;  ///< TᵀKT
    Eigen::MatrixXd coriolis;   ///< matrix of the map u ↦ Ω ê₃×u in the coordinates z
  };
  /// The equation of a class about a figure with the stiffness K and the derivative G of the constraint. G is not used
  /// for a compressible body. T has no columns if no motion of the class satisfies the constraint.
  ClassEquation equation(const Part& part, const EquilibriumFigure& figure, const Eigen::MatrixXd& K,
                         const Eigen::MatrixXd& G) const;
  /// G for the whole body at a figure; empty for a compressible body.
  Eigen::MatrixXd constraint_at(const EquilibriumFigure& figure) const;
  void add_parts(bool odd_in_z, bool odd_under_half_turn, Figure figure);
  Eigen::MatrixXd exchanges(const Eigen::MatrixXd& fields) const;
  Eigen::MatrixXd stiffness(const EquilibriumFigure& figure) const;
  mechanics::SymmetryDirections turns(const Eigen::VectorXd& x, double spin) const;
  mechanics::SymmetryDirections symmetries(const Part& part, const Eigen::MatrixXd& T, const Eigen::Matrix3d& A,
                                           const mechanics::SymmetryDirections& turns) const;

  bool incompressible_, is_fluid_;
  FigureForces forces_;     ///< forces on the whole body
  loads::Forcing forcing_;  ///< sum of the loads of a body at rest; empty for a rotation
  std::shared_ptr<const PolynomialSpace> octant_;
  std::shared_ptr<const Turns> turns_;
  std::vector<Part> parts_;
};

}  // namespace pseudorigid::polynomial
