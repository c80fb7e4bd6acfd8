#pragma once
/// The generalized Newton law in intrinsic form (Oliva, Geometric Mechanics, 5.1–5.4): a second-order field
///
///   q̈ = a(t, q, q̇)
///
/// on the vector space of the configuration. The field of a chart with the metric g, the Christoffel symbols Γ and the
/// force F is a = −Γ(q̇, q̇) + g⁻¹F (5.19, 5.22; chart.h). In a moving frame, the field also contains the inertial
/// accelerations. A system in constrained form has the mass M, the force f, the multiplier λ and a constraint
/// (constrained_system.h). The constraint is written g = 0, with G = Dg; this g is not the metric. By the explicit
/// multiplier (5.29), the field of the system is
///
///   q̈ = M⁻¹[f + Gᵀλ],   G M⁻¹Gᵀ λ = −D²g(q̇, q̇) − G M⁻¹ f,
///
/// with the invariants g = 0 and G q̇ = 0.

#include <concepts>
#include <utility>

#include "mechanics/core/constrained_system.h"

namespace pseudorigid::mechanics {

/// A second-order field. `acceleration` sets a to the acceleration at the time t, the position q and the velocity v, or
/// returns a failure as a Status. The workspace w contains temporaries of the field.
template <class F>
concept SecondOrderField = requires(const F field, double t, const typename F::Vector q, const typename F::Vector v,
                                    typename F::Workspace w, typename F::Vector a) {
  { field.acceleration(t, q, v, w, a) } -> std::same_as<Status>;
  { field.make_vector() } -> std::same_as<typename F::Vector>;  // zero vector of the right size
  { field.make_workspace() } -> std::same_as<typename F::Workspace>;
};

/// A field with an invariant manifold of states (q, v). `project` moves a nearby state to the manifold. It fails if it
/// does not find a state on the manifold.
template <class F>
concept ProjectedField = SecondOrderField<F> &&
    requires(const F field, typename F::Vector q, typename F::Vector v, typename F::Workspace w) {
  { field.project(q, v, w) } -> std::same_as<Status>;
};

/// Properties of a system or field on which a method may rely. A system declares a property by a member function of the
/// same name. Without this member, the property is false.
template <class S>
bool velocity_dependent(const S& system) {  // true if the force depends on v
  if constexpr (requires { system.velocity_dependent(); }) return system.velocity_dependent();
  return false;
}
template <class S>
bool dissipative(const S& system) {  // true if a force dissipates energy, so that no substep may go backwards in time
  if constexpr (requires { system.dissipative(); }) return system.dissipative();
  return false;
}
template <class S>
bool time_dependent(const S& system) {  // true if the force depends on t
  if constexpr (requires { system.time_dependent(); }) return system.time_dependent();
  return false;
}

}  // namespace pseudorigid::mechanics
