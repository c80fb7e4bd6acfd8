#pragma once
/// Systems with internal variables z, such as the internal strains of viscoelastic branches. With the mass M, the force
/// f, the constraint g, G = Dg and the multiplier λ, the equations of motion are
///
///   M q̈ = f(t, q, q̇, z) + G(q)ᵀλ,   g(q) = 0,   ż = R(q, z).
///
/// The vector of the position contains z as further entries, which have no mass and no velocity. The system computes
/// the exact flow of z for a constant strain. A method composes this flow with steps for constant z (Strang's
/// splitting; rattle.h). The flow dissipates energy.

#include <concepts>

#include "mechanics/core/constrained_system.h"

namespace pseudorigid::mechanics {

template <class S>
concept Relaxing = ConstrainedSystem<S> &&
    requires(const S s, double h, const typename S::Vector before, typename S::Vector q, typename S::Vector v) {
  { s.relaxes() } -> std::same_as<bool>;  // false if this system has no variables z
  /// Replaces z in q by its value after the time h, for the mean strain of the positions `before` and q. Adds the
  /// energy that the flow dissipates to the entries of v that contain dissipated energies.
  s.relax(h, before, q, v);
};

template <class S>
bool relaxes(const S& system) {
  if constexpr (requires { system.relaxes(); }) return system.relaxes();
  return false;
}

/// Returns the failure with which a method refuses a system with internal variables. Only RATTLE includes the flow of z
/// in its steps. The function is for methods that accept dissipative systems. All other methods refuse such a system
/// anyway, because the flow dissipates energy.
inline Status refuses_relaxation() {
  return Status::failure("the internal strains of viscoelastic branches are integrated by rattle; use rattle");
}

}  // namespace pseudorigid::mechanics
