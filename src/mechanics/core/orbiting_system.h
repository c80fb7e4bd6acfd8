#pragma once
/// Systems with companions in orbit (orbit.h). Some entries of the position q are the coordinates s_k of the
/// companions. The same entries of the velocity v are the rates ṡ_k. RATTLE moves the s_k along Kepler orbits instead
/// of straight lines.

#include <concepts>

#include "mechanics/core/orbit.h"

namespace pseudorigid::mechanics {

template <class S>
concept Orbiting = requires(const S system, const typename S::Vector q, typename S::Vector changed,
                            const Orbit::Columns s) {
  { system.orbit() } -> std::same_as<const Orbit&>;
  /// companions(q) returns the coordinates s_k in a position q. For a velocity v, companions(v) returns the rates ṡ_k.
  { system.companions(q) } -> std::same_as<Orbit::Columns>;
  system.set_companions(s, changed);  // sets the companions' entries of `changed` to s
};

/// Returns true if the system has at least one companion.
template <class S>
bool has_companions(const S& system) {
  if constexpr (Orbiting<S>) return system.orbit().n() > 0;
  return false;
}

/// Corrects the companions in q and v after the drift q = before + h v of a step of size h. Their coordinates in q
/// become those at the end of Kepler orbits from `before`, and their velocities in v change accordingly (Orbit::drift).
/// On entry v is the velocity after the first half step.
template <Orbiting S>
void drift_companions(const S& system, double h, const typename S::Vector& before, typename S::Vector& q,
                      typename S::Vector& v) {
  Orbit::Columns s = system.companions(before), sdot = system.companions(v);
  system.orbit().drift(h, s, sdot);
  system.set_companions(s, q);
  system.set_companions(sdot, v);
}

}  // namespace pseudorigid::mechanics
