#pragma once
/// Small displacements u about a symmetric figure of equilibrium (mechanics/equilibria/figures.h) of the finite-element
/// ball, for the solver of parity_sector.h. With the positions x, the multiplier λ and the drive ν of the figure, the
/// stiffness is
///
///   K = −D(f + ν h + Gᵀλ)(x).
///
/// The matrices of the cells have the tangent of the stored energy, of the pressure and of the constraint
/// (modes/cell_stiffness.h). The operator E has the other terms of K. They are the second variation of self-gravity
/// (body/surface_gravity_forces.h), and the derivatives along u of the centrifugal force and of the force of a
/// quadratic potential. Per mass, these derivatives are Ω²P u and −T u, with the spin Ω, the projection P onto the
/// plane normal to axis 3, and the matrix T of the potential. With a positive shift, E is the matrix of
/// self-gravity for the unknowns of the surface. Without a shift, E is a product, and the cells alone precondition K.
/// The multiplier then also balances the gravity at the surface. The matrices of the cells therefore have the mean
/// stress of the law instead of the multiplier, and springs along the normals of the surface instead of gravity. E has
/// the differences. Without this change, the preconditioner would not be positive definite under strong gravity.

#include <Eigen/Core>
#include <vector>

#include "continuum/body/ball_body.h"
#include "continuum/modes/cell_stiffness.h"
#include "continuum/modes/parity_sector.h"
#include "mechanics/equilibria/figures.h"

namespace pseudorigid::continuum {

using mechanics::Drive;

/// The body, the forces on it, and the figure about which displacements are small.
struct FigureState {
  const BallBody& body;
  const StoredEnergy& stored;
  const loads::Forcing& forcing;  ///< sum of the loads of the body
  bool incompressible;
  Drive kind;
  const Vector& x;       ///< nodal positions of the figure, with up-to-date ghost nodes
  const Vector& lambda;  ///< multiplier of the figure; not used for a compressible body
  double drive;          ///< drive ν
};

/// The larger of the shear modulus at rest and ρgr, with the gravity g at the surface of the sphere. In internal units,
/// ρ = r = 1.
double typical_stiffness(const StoredEnergy& stored, bool incompressible, const loads::Forcing& forcing);

/// A term σ(w·u)²/2 in the energy of displacements u, for a vector w.
struct HeldDirection {
  Vector w;
  double stiffness;  ///< factor σ
};

/// The factor of the constraint in the tangent of the cells: the multiplier, or the mean stress of the law.
enum class Balance { multiplier, mean_stress };
/// The numbers c (modes/cell_stiffness.h) of a cell, for the tangent of the stored energy, of the pressure and of the
/// constraint.
PointCoefficients tangent_coefficients(const CellStiffness& cells, const FigureState& state, unsigned int cell,
                                       Balance balance);
/// The force per displacement and area with which gravity and an attractive quadratic potential hold the surface of an
/// incompressible ball. It is ρg, plus ν times the least eigenvalue of the matrix T of the potential.
double weight_of_surface(const FigureState& state);
/// The springs that take the place of these forces in the preconditioner, for nodal positions x of a space. Collective.
std::vector<FaceSprings> springs_of_weight(const BallSpace& space, const Vector& x, double weight);
/// The derivative of the force of gravity along u, with the opposite sign.
Vector rate_of_gravity(const FigureState& state, const Vector& u, const Parity& parity);
/// Adds the forces of springs that act on u, times −`factor`. Collective.
void add_rate_of_springs(const BallSpace& space, const std::vector<FaceSprings>& springs, double factor,
                         const Vector& u, Vector& force);
/// Adds the product of u with the terms of E that are neither of the cells nor of gravity: those of the drive, and
/// σwwᵀ if `held` is not null.
void add_rate_beyond_cells(const FigureState& state, const HeldDirection* held, const Vector& u, Vector& force);

class TangentProblem final : public LinearProblem {
 public:
  /// The objects to which `state` refers must outlive this object. `shift` is s of parity_sector.h. If the shift is
  /// positive, K + s M must be positive definite. The terms of rate_of_drive are then a part of the preconditioner, and
  /// not of E. If `held` is not null, the shift must be 0, and K and E contain the term σwwᵀ of `held`, which must
  /// outlive this object.
  TangentProblem(const FigureState& state, double shift, const HeldDirection* held = nullptr);
  BeyondCells beyond_cells(const ParitySector& sector) const override;

 private:
  /// The products of u with two parts of E without a shift. `rate_at_surface` computes the terms of gravity and of the
  /// springs, which couple the unknowns of the surface. `rate_within` computes the other terms.
  Vector rate_at_surface(const Vector& u, const Parity& parity) const;
  Vector rate_within(const Vector& u) const;

  FigureState state_;
  bool definite_;  ///< true if the shift is positive
  const HeldDirection* held_;
  std::vector<FaceSprings> springs_;
  std::vector<Eigen::MatrixXd> of_gravity_;  ///< terms of K of each cell that E has; may be empty
};

}  // namespace pseudorigid::continuum
