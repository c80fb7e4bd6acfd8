#pragma once
/// What acts on the finite-element ball besides its elasticity, node by node with the lumped mass, so that the motions
/// x = QX feel exactly what the pseudo-rigid body feels (reduced/potential.h, reduced/dissipation.h):
///
///   quadratic potential ½ xᵀTx per mass     f_n = −m_n T x_n               V = ½ Σ m_n x_nᵀTx_n
///   uniform acceleration b                  f_n = m_n b                    V = −Σ m_n b·x_n
///   dead traction t = P̄N per reference area f_n = ∮P̄N φ_n dA = P̄ ∫∇φ_n dX  V = −P̄ : ∫F dX
///   objective viscosity σ = 2ηd             f_n = −∫2ηJ d F⁻ᵀ∇φ_n dX,   d = sym(∇ẋ F⁻¹)
///   drag, force density −cρẋ                f_n = −c m_n ẋ_n
///
/// The last two take the power ∫2ηJ d:d dX + c Σ m_n |ẋ_n|². All in internal units.

#include <Eigen/Core>
#include <optional>

#include "continuum/cell_kernels.h"
#include "mechanics/by_name.h"

namespace pseudorigid::continuum {

struct BallLoads {
  ByName by_name{};
  Eigen::Matrix3d quadratic = Eigen::Matrix3d::Zero();         ///< T, symmetric
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();      ///< b
  Eigen::Matrix3d nominal_traction = Eigen::Matrix3d::Zero();  ///< P̄, a first Piola–Kirchhoff stress
  double viscosity = 0, drag = 0;                              ///< η, c

  bool dissipative() const { return viscosity != 0 || drag != 0; }
};

/// The forces of the loads on the nodes of a space. Loads that are zero cost nothing but a branch.
class LoadForces {
 public:
  LoadForces(const BallLoads& loads, const BallSpace& space, const CellKernels& kernels);

  /// f ← f + loads, with the power that dissipation takes from the whole ball at BallSpace::account.
  void add(const Vector& x, const Vector& v, Vector& f) const;
  /// V of the whole ball, from Σ m xxᵀ, Σ m x and ∫F dX over it.
  double potential(const Eigen::Matrix3d& second_moment, const Eigen::Vector3d& first_moment,
                   const Eigen::Matrix3d& F_integral) const;

 private:
  void add_body_forces(const Vector& x, Vector& f) const;
  double add_dissipation(const Vector& x, const Vector& v, Vector& f) const;

  BallLoads loads_;
  const BallSpace& space_;
  const CellKernels& kernels_;
  std::optional<Vector> traction_;  ///< P̄ ∫∇φ_n dX
};

}  // namespace pseudorigid::continuum
