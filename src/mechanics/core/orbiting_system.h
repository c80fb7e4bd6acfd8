#pragma once
/// Systems with companions in orbit (orbit.h). Some coordinates in the position q are the coordinates s_k of the
/// companions, and the same entries of the velocity v are their rates ṡ_k. RATTLE moves these coordinates along Kepler
/// orbits in place of straight lines.

#include <concepts>

#include "mechanics/core/orbit.h"

namespace pseudorigid::mechanics {

template <class S>
concept Orbiting = requires(const S system, const typename S::Vector q, typename S::Vector changed,
                            const Orbit::Columns s) {
  { system.orbit() } -> std::same_as<const Orbit&>;
  /// The coordinates s_k in a position, or the rates ṡ_k in a velocity.
  { system.companions(q) } -> std::same_as<Orbit::Columns>;
  system.set_companions(s, changed);  // sets the companions' entries of `changed` to s
};

/// True if there is a companion.
template <class S>
bool has_companions(const S& system) {
  if constexpr (Orbiting<S>) return system.orbit().n() > 0;
  return false;
}

/// Replaces the straight motion of the companions in q during the time h by the motion along Kepler orbits, and changes
/// their velocities in v accordingly (Orbit::drift). The vector `before` contains the position before the motion. On
/// entry v is the velocity after the first half step.
template <Orbiting S>
void drift_companions(const S& system, double h, const typename S::Vector& before, typename S::Vector& q,
                      typename S::Vector& v) {
  Orbit::Columns s = system.companions(before), sdot = system.companions(v);
  system.orbit().drift(h, s, sdot);
  system.set_companions(s, q);
  system.set_companions(sdot, v);
}

}  // namespace pseudorigid::mechanics
