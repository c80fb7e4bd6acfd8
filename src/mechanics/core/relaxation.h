#pragma once
/// Systems with internal variables z, such as the internal strains of viscoelastic branches. With the mass M, the force
/// f, the constraint g, G = Dg and the multiplier λ, the equations of motion are
///
///   M q̈ = f(t, q, q̇, z) + G(q)ᵀλ,   g(q) = 0,   ż = R(q, z).
///
/// The variables z are additional entries of the position vector q, without mass and velocity. The system computes the
/// exact flow of z for a constant strain. RATTLE composes this flow with the step for constant z (Strang's splitting;
/// rattle.h). The flow dissipates energy.

#include <concepts>

#include "mechanics/core/constrained_system.h"

namespace pseudorigid::mechanics {

template <class S>
concept Relaxing = ConstrainedSystem<S> &&
    requires(const S s, double h, const typename S::Vector before, typename S::Vector q, typename S::Vector v) {
  { s.relaxes() } -> std::same_as<bool>;  // false if this system has no variables z
  /// Replaces z in q by its value after the time h. The strain is constant, the mean of the strains at `before` and q.
  /// The function adds the energy that the flow dissipates to the entries of v that contain dissipated energies.
  s.relax(h, before, q, v);
};

/// Returns true if the system has internal variables z.
template <class S>
bool relaxes(const S& system) {
  if constexpr (requires { system.relaxes(); }) return system.relaxes();
  return false;
}

/// Returns the failure with which a method refuses a system with internal variables z. Only RATTLE includes the flow of
/// z in its steps. Only methods that accept dissipative systems need this function. All other methods refuse every
/// dissipative system.
inline Status refuses_relaxation() {
  return Status::failure("the internal strains of viscoelastic branches are integrated by rattle; use rattle");
}

}  // namespace pseudorigid::mechanics
