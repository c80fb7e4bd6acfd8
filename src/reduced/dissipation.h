#pragma once
/// Dissipative forces on the pseudo-rigid body x = QX, from Rayleigh's function R(Q, Q̇) (docs/physics.md, section 0;
/// Oliva 5.8). E₀ and Vol are the inertia and the volume of the reference body, and ρ is its density. The forces are
///
///   objective viscosity (Kelvin–Voigt, σ = 2ηd):  R = η Vol det Q tr d²,   d = sym(Q̇Q⁻¹)
///       −∂R/∂Q̇ = −2η Vol det Q d Q⁻ᵀ;  it vanishes on rigid motions and does not change the angular momentum J
///   linear drag (force density −cρẋ):             R = ½ c tr(Q̇ E₀ Q̇ᵀ)
///       −∂R/∂Q̇ = −c Q̇ E₀;  it damps every motion, also a rigid rotation
///
/// Each force dissipates the power 2R.

#include <Eigen/Dense>

#include "loads/forcing.h"
#include "mechanics/core/by_name.h"
#include "reduced/reference_body.h"

namespace pseudorigid::reduced {

struct Dissipation {
  ByName by_name{};
  double viscosity = 0;  ///< viscosity η
  double drag = 0;       ///< drag coefficient c

  /// The viscosity and the drag of a forcing.
  static Dissipation of(const loads::Forcing& forcing) {
    return {.viscosity = forcing.viscosity, .drag = forcing.drag};
  }

  bool present() const { return viscosity != 0 || drag != 0; }

  /// Adds the dissipative force −∂R/∂Q̇ to f. Returns the power 2R that the force dissipates.
  double add_force(const ReferenceBody& body, const Eigen::Matrix3d& Q, const Eigen::Matrix3d& Qdot,
                   Eigen::Matrix3d& f) const {
    double power = 0;
    if (viscosity != 0) {
      const Eigen::Matrix3d inverse = Q.inverse(), L = Qdot * inverse, d = 0.5 * (L + L.transpose());
      const double strength = 2 * viscosity * body.volume * Q.determinant();
      f -= strength * d * inverse.transpose();
      power += strength * d.squaredNorm();
    }
    if (drag != 0) {
      const Eigen::Matrix3d momentum = Qdot * body.E0;
      f -= drag * momentum;
      power += drag * momentum.cwiseProduct(Qdot).sum();
    }
    return power;
  }
};

}  // namespace pseudorigid::reduced
