#pragma once
/// The form in which a method receives a system. A method with steps of fixed size receives the system itself. An
/// adaptive method receives a second-order field, which is ExplicitMultiplier for a constrained system
/// (explicit_multiplier.h).

#include <type_traits>

#include "mechanics/core/explicit_multiplier.h"

namespace pseudorigid::mechanics {

/// Returns the second-order field of a system. If the system has the constrained form, the field refers to the system.
/// Otherwise the system itself is the field, and the function returns a reference to it.
template <class S>
decltype(auto) field_of(const S& system) {
  if constexpr (ConstrainedSystem<S>)
    return ExplicitMultiplier<S>(system);
  else
    return (system);
}
template <class S>
using FieldOf = std::remove_cvref_t<decltype(field_of(std::declval<const S&>()))>;

/// Returns the form of the system that Method receives: the field if the method is adaptive, otherwise the system.
template <class Method, class S>
decltype(auto) form_for(const S& system) {
  if constexpr (Method::adaptive)
    return field_of(system);
  else
    return (system);
}
template <class Method, class S>
using FormFor = std::remove_cvref_t<decltype(form_for<Method>(std::declval<const S&>()))>;

/// True if the method needs only the operations of VectorSpace (vector_space.h), and declares this by the member
/// `takes_any_vector`. Other methods need dense Eigen vectors.
template <class Method>
inline constexpr bool takes_any_vector = [] {
  if constexpr (requires { Method::takes_any_vector; }) return Method::takes_any_vector;
  return false;
}();

/// True if the method integrates compliant constraints (constrained_system.h), and declares this by the member
/// `takes_compliance`.
template <class Method>
inline constexpr bool takes_compliance = [] {
  if constexpr (requires { Method::takes_compliance; }) return Method::takes_compliance;
  return false;
}();

/// Returns true if the method compiles for the type of the system.
template <class Method, class S>
consteval bool method_fits() {
  if constexpr (!VectorSpace<typename S::Vector>::dense && !takes_any_vector<Method>)
    return false;
  else
    return Method::template fits<FormFor<Method, S>>;
}

/// Returns true if the method compiles for this system, and integrates its constraint if that is compliant. For an
/// AnySystem the result depends on `is_conservative()`, which is known only at run time (any_system.h).
template <class Method, class S>
constexpr bool fits(const S& system) {
  if constexpr (requires { typename S::WithoutEnergies; }) {
    if (!system.is_conservative()) return method_fits<Method, typename S::WithoutEnergies>();
  }
  if constexpr (!takes_compliance<Method>)
    if (is_compliant(system)) return false;
  return method_fits<Method, S>();
}

}  // namespace pseudorigid::mechanics
