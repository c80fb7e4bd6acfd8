#pragma once
/// The loads on the finite-element ball (loads/forcing.h), node by node with the lumped mass, so that the motions x =
/// QX have exactly the forces of the pseudo-rigid body (reduced/external_potential.h, reduced/dissipation.h):
///
///   quadratic potential ½ xᵀTx per mass     f_n = −m_n T x_n               V = ½ Σ m_n x_nᵀTx_n
///   uniform acceleration b                  f_n = m_n b                    V = −Σ m_n b·x_n
///   dead traction t = P̄N per reference area f_n = ∮P̄N φ_n dA = P̄ ∫∇φ_n dX  V = −P̄ : ∫F dX
///   pressure −p n per current area          f_n = −p ∫cof F ∇φ_n dX        V = p ∫J dX
///   objective viscosity σ = 2ηd             f_n = −∫2ηJ d F⁻ᵀ∇φ_n dX,   d = sym(∇ẋ F⁻¹)
///   drag, force density −cρẋ                f_n = −c m_n ẋ_n
///
/// The last two take the power ∫2ηJ d:d dX + c Σ m_n |ẋ_n|², and a load that depends on time gives the power ∂V/∂t: the
/// node BallSpace::account has both as its forces, so that its velocity is (D, W, 0), the energy taken and given. All
/// in internal units.

#include <Eigen/Core>
#include <optional>

#include "continuum/kernels/cell_kernels.h"
#include "loads/list.h"

namespace pseudorigid::continuum {

/// The forces of the loads on the nodes of a space. A load that is zero costs one branch.
class LoadForces {
 public:
  LoadForces(const loads::Loads& loads, const BallSpace& space, const CellKernels& kernels);

  bool dissipative() const { return constant_.dissipative(); }
  bool time_dependent() const { return driven_; }

  /// f ← f + loads, with the powers of the whole ball at BallSpace::account.
  void add(double t, const Vector& x, const Vector& v, Vector& f) const;
  /// f ← f + the forces of viscosity and drag; returns the power that they take, over the cells and nodes of this rank.
  double add_dissipation(const Vector& x, const Vector& v, Vector& f) const;
  /// V of the whole ball, from Σ m xxᵀ, Σ m x and ∫F dX over it and its volume.
  double potential(double t, const Eigen::Matrix3d& second_moment, const Eigen::Vector3d& first_moment,
                   const Eigen::Matrix3d& F_integral, double volume) const;

  /// For a space with loads that depend on time: f ← f − ∂V/∂x, and ∂V/∂t from the rate over the nodes of this rank.
  void add_driving(const loads::Forcing& forcing, const Vector& x, Vector& f) const;
  double driving_power(const loads::Forcing& rate, const Vector& x) const;

 private:
  void add_body_forces(const loads::Forcing& forcing, const Vector& x, Vector& f) const;
  void add_pressure(double pressure, const Vector& x, Vector& f) const;

  loads::Loads loads_;
  loads::Forcing constant_;  ///< the loads that do not depend on time
  bool driven_;              ///< there are others
  const BallSpace& space_;
  const CellKernels& kernels_;
  std::optional<Vector> gradients_;  ///< ∫∇φ_n dX, where loads depend on time
  std::optional<Vector> traction_;   ///< P̄ ∫∇φ_n dX
};

}  // namespace pseudorigid::continuum
