#pragma once
/// Small displacements u about a symmetric figure of equilibrium (mechanics/equilibria/figures.h) of the finite-element
/// ball, for the solver of parity_sector.h. With the positions x, the multiplier λ and the drive ν of the figure, the
/// stiffness is
///
///   K = −D(f + ν h + Gᵀλ)(x).
///
/// The cells have the tangent of the stored energy, of the pressure and of the constraint (modes/cell_stiffness.h). The
/// operator E has the other terms. They are the second variation of self-gravity (body/surface_gravity_forces.h) and
/// the rates of the centrifugal force and of a quadratic potential. Per mass, these rates are Ω²P u and −T u. P is the
/// projection onto the plane normal to axis 3. With self-gravity, the multiplier also balances the gravity at the
/// surface. The preconditioner then has the mean stress of the law instead of the multiplier, and springs along the
/// normals of the surface instead of gravity. E has the differences. Otherwise the preconditioner would not be positive
/// definite under strong gravity.

#include <Eigen/Core>
#include <vector>

#include "continuum/body/ball_body.h"
#include "continuum/modes/parity_sector.h"

namespace pseudorigid::continuum {

/// The force h that the drive multiplies: the centrifugal force of a rotation about axis 3, or all loads.
enum class Drive { rotation, loads };

/// The forces and the state about which displacements are small.
struct FigureState {
  const BallBody& body;
  const StoredEnergy& stored;
  const loads::Forcing& forcing;  ///< sum of the loads of the body
  bool incompressible;
  Drive kind;
  const Vector& x;
  const Vector& lambda;  ///< not used for a compressible body
  double drive;
};

/// The larger of the shear modulus at rest and ρgr, with the gravity g at the surface of the sphere. In internal units,
/// ρ = r = 1.
double typical_stiffness(const StoredEnergy& stored, bool incompressible, const loads::Forcing& forcing);

/// A term σ(w·u)²/2 in the energy of displacements u, for a vector w.
struct HeldDirection {
  Vector w;
  double stiffness;  ///< factor σ
};

class TangentProblem final : public LinearProblem {
 public:
  /// The objects to which `state` refers must outlive this object. `shift` is s of parity_sector.h. If it is positive,
  /// K + s M must be positive definite. The rate of the drive is then a part of the preconditioner, and not of E. If
  /// `held` is not null, K contains its term.
  TangentProblem(const FigureState& state, double shift, const HeldDirection* held = nullptr);
  SectorOperator beyond_cells(const ParitySector& sector) const override;

 private:
  /// The products of u with two parts of E. `rate_at_surface` has gravity and the springs, which couple the unknowns of
  /// the surface. `rate_within` has the other terms.
  Vector rate_at_surface(const Vector& u, const Parity& parity) const;
  Vector rate_within(const Vector& u) const;
  std::vector<Eigen::Index> unknowns_at_surface(const ParitySector& sector) const;
  /// `of_cell` returns the entries of a nodal vector at the nodes of a cell. `add_of_cell` adds such entries to f.
  Eigen::VectorXd of_cell(unsigned int cell, const Vector& u) const;
  void add_of_cell(unsigned int cell, const Eigen::VectorXd& local, Vector& f) const;

  /// The rates of the centrifugal force or of the quadratic potential per mass and displacement, with the sign of K.
  /// The planes of the octant are planes of symmetry, so the matrix of the potential is diagonal.
  Eigen::Vector3d rate_of_drive() const;

  FigureState state_;
  bool definite_;
  const HeldDirection* held_;
  std::vector<Spring> springs_;
  std::vector<Eigen::MatrixXd> of_gravity_;  ///< terms of K of each cell that E has; empty without self-gravity
};

}  // namespace pseudorigid::continuum
