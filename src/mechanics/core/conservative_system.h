#pragma once
/// Functions of a conservative system in addition to its law of motion (constrained_system.h). They are the energies,
/// the mass operator, the rate of the reaction, and the symmetries (Noether). The search for critical points and the
/// method energy-momentum use these functions. K is the kinetic energy, V the potential energy, M the mass operator and
/// f the force. Symmetry i changes q along the vector field ξ_i and q̇ along its rate ξ̇_i. With a small number ε,
///
///   K = ½ ⟨q̇, M q̇⟩,   V(q),   f = −dV,
///   symmetry i:  (q, q̇) ↦ (q, q̇) + ε (ξ_i(q), ξ̇_i(q̇)),   momentum ⟨M q̇, ξ_i(q)⟩.

#include <concepts>

#include "mechanics/core/constrained_system.h"

namespace pseudorigid::mechanics {

template <class S>
concept ConservativeSystem = ConstrainedSystem<S> &&
    requires(const S s, const typename S::Vector q, const typename S::Vector v, const typename S::Multiplier lambda,
             typename S::Vector f) {
  { s.potential_energy(q) } -> std::convertible_to<double>;  // V(q); not finite if q is not admissible
  { s.kinetic_energy(v) } -> std::convertible_to<double>;    // K at the velocity v
  s.apply_mass(v, f);                                        // f = M v
  s.add_reaction_rate(q, v, lambda, f);                      // f += Σ_k λ_k D²g_k(q)(v, ·), the rate of G(q)ᵀλ
  { s.n_symmetries() } -> std::convertible_to<int>;
  s.symmetry(0, q, v, f, f);  // (i, q, v, dq, dv): sets dq = ξ_i(q) and dv = ξ̇_i(v); dq and dv must be different
};

}  // namespace pseudorigid::mechanics
