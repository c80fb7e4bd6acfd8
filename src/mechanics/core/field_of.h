#pragma once
/// Which form of a system a method works on: methods of fixed step on the constrained form, adaptive ones on a
/// second-order field, which a constrained system becomes by its explicit multiplier.

#include <type_traits>

#include "mechanics/core/explicit_multiplier.h"

namespace pseudorigid::mechanics {

/// The field of a system: itself, if it is one without constraints to care for. It refers to the system.
template <class S>
decltype(auto) field_of(const S& system) {
  if constexpr (ConstrainedSystem<S>)
    return ExplicitMultiplier<S>(system);
  else
    return (system);
}
template <class S>
using FieldOf = std::remove_cvref_t<decltype(field_of(std::declval<const S&>()))>;

/// The form that a method works on: `form_for<Method>(system)`.
template <class Method, class S>
decltype(auto) form_for(const S& system) {
  if constexpr (Method::adaptive)
    return field_of(system);
  else
    return (system);
}
template <class Method, class S>
using FormFor = std::remove_cvref_t<decltype(form_for<Method>(std::declval<const S&>()))>;

/// The methods that need only the operations of VectorSpace, and declare it; the others need dense vectors of Eigen.
template <class Method>
inline constexpr bool takes_any_vector = [] {
  if constexpr (requires { Method::takes_any_vector; }) return Method::takes_any_vector;
  return false;
}();

/// Whether a method can be compiled for a system.
template <class Method, class S>
consteval bool method_fits() {
  if constexpr (!VectorSpace<typename S::Vector>::dense && !takes_any_vector<Method>)
    return false;
  else
    return Method::template fits<FormFor<Method, S>>;
}

/// Whether the method fits this system. The abilities of a system behind an interface are known at run time
/// (any_system.h).
template <class Method, class S>
constexpr bool fits(const S& system) {
  if constexpr (requires { typename S::WithoutEnergies; }) {
    if (!system.is_conservative()) return method_fits<Method, typename S::WithoutEnergies>();
  }
  return method_fits<Method, S>();
}

}  // namespace pseudorigid::mechanics
