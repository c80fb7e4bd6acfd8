#pragma once
/// The loads on the finite-element ball (loads/forcing.h). Forces per mass use the lumped mass of the nodes. For
/// motions x = QX, the forces on Q are therefore exactly those of the pseudo-rigid body (reduced/external_potential.h,
/// reduced/dissipation.h):
///
///   quadratic potential ½ xᵀTx per mass     f_n = −m_n T x_n               V = ½ Σ m_n x_nᵀTx_n
///   uniform acceleration b                  f_n = m_n b                    V = −Σ m_n b·x_n
///   dead traction t = P̄N per reference area f_n = ∮P̄N φ_n dA = P̄ ∫∇φ_n dX  V = −P̄ : ∫F dX
///   pressure −p n per current area          f_n = −p ∫cof F ∇φ_n dX        V = p ∫J dX
///   objective viscosity σ = 2ηd             f_n = −∫2ηJ d F⁻ᵀ∇φ_n dX,   d = sym(∇ẋ F⁻¹)
///   drag, force density −cρẋ                f_n = −c m_n ẋ_n
///
/// Node n has the mass m_n, the position x_n and the basis function φ_n. The other symbols are those of
/// loads/forcing.h. Viscosity and drag dissipate the power ∫2ηJ d:d dX + c Σ m_n |ẋ_n|². A load that depends on time
/// gives the power ∂V/∂t. Both powers act as forces on the first two coordinates of BallSpace::account, which have the
/// mass 1. The velocities of these coordinates are therefore the dissipated energy and the given energy (ball_body.h).
/// All quantities are in internal units.

#include <Eigen/Core>
#include <optional>

#include "continuum/kernels/cell_kernels.h"
#include "loads/list.h"

namespace pseudorigid::continuum {

/// The forces of the loads on the nodes of a space. The space and the kernels must outlive this object.
class LoadForces {
 public:
  LoadForces(const loads::Loads& loads, const BallSpace& space, const CellKernels& kernels);

  bool dissipative() const { return constant_.dissipative(); }
  bool damped() const { return constant_.damped(); }
  bool viscous() const { return constant_.viscosity > 0; }
  /// True if planes have friction. The damping force is then not linear in the velocity.
  bool rough() const { return constant_.planes.rough(); }
  bool time_dependent() const { return driven_; }

  /// f ← f + the forces of the loads at the time t. If BallSpace::account is not empty, sets the forces on its first
  /// two coordinates to powers of the whole ball. The first is the power that viscosity and drag dissipate. The second
  /// is the power that loads give by their change in time. Collective.
  void add(double t, const Vector& x, const Vector& v, Vector& f) const;
  /// f ← f + viscous force and drag. Returns the power that these forces dissipate in the cells and at the own nodes of
  /// this rank. Collective.
  double add_dissipation(const Vector& x, const Vector& v, Vector& f) const;
  /// The potential V of the loads on the whole ball at the time t. The arguments are Σ m_n x_n x_nᵀ and Σ m_n x_n over
  /// the nodes, ∫F dX, and the volume of the whole ball.
  double potential(double t, const Eigen::Matrix3d& second_moment, const Eigen::Vector3d& first_moment,
                   const Eigen::Matrix3d& F_integral, double volume) const;

  /// `add_driving` computes f ← f − ∂V/∂x for the potential V of `forcing`. `driving_power` returns the contribution of
  /// the nodes of this rank to ∂V/∂t. Its argument `rate` contains the time derivatives of the loads. Both functions
  /// need the member gradients_, so a load must depend on time or a plane must move. Collective.
  void add_driving(const loads::Forcing& forcing, const Vector& x, Vector& f) const;
  double driving_power(const loads::Forcing& rate, const Vector& x) const;

 private:
  void add_body_forces(const loads::Forcing& forcing, const Vector& x, Vector& f) const;
  void add_pressure(double pressure, const Vector& x, Vector& f) const;

  loads::Loads loads_;
  loads::Forcing constant_;  ///< sum of the loads that do not depend on time, with all planes
  bool driven_;              ///< true if a load depends on time or a plane moves
  const BallSpace& space_;
  const CellKernels& kernels_;
  std::optional<Vector> gradients_;  ///< ∫∇φ_n dX; empty if no load depends on time and no plane moves
  std::optional<Vector> traction_;   ///< P̄ ∫∇φ_n dX; empty without a constant traction
};

}  // namespace pseudorigid::continuum
