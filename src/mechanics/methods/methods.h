#pragma once
/// The table of methods, for code that chooses a method at run time. A new method needs its own header and one line in
/// the table.
///
/// A method is an empty struct with these members:
///
///     name, documentation                  as shown in parameter files
///     order, n_stages, symplectic, symmetric, adaptive
///     chosen_by_auto                       true if the entry Method = auto may choose the method
///     Workspace<S>                         made from a system; with `system`, `counters` and visit_memory (memory.h)
///     fits<S>                              true if the method compiles for a system of type S
///     takes_any_vector                     optional, true if the method needs only the operations of VectorSpace
///     takes_compliance                     optional, true if the method integrates compliant constraints
///                                          (constrained_system.h)
///     accepts(system) → Status             fails with the reason if the method must not integrate this system
///
/// A method with steps of fixed size (adaptive = false) also has
///
///     stability_limit                      largest stable hω of a step h; ω is the largest frequency of small motions
///     resonance_limit                      optional, hω of the first resonance (multistep_coefficients.h)
///     forces_of_step(system)               optional, cost of a step in force evaluations; the default is n_stages
///     for_stages_in_lanes                  optional, declared if Method = auto needs a system with stages in lanes
///     iteration_tolerance(tolerance, end)  needed if the workspace has `most_halvings` (gauss_16.h)
///     advance(system, h, state, workspace) → Status            makes one step; v need not satisfy G v = 0
///     project_velocity(system, state, workspace) → Status      makes v satisfy G v = 0, called at samples
///
/// A method that chooses the sizes of its steps (adaptive = true) has the following functions instead. Its workspace
/// also has the permitted error `tolerance` of a step and the largest size `h_max` of a step.
///
///     step(field, t_limit, state, workspace) → Status          makes one step that ends at t_limit at the latest
///     interpolate(field, t, state, workspace) → Status         sets `state` to the state at a time t in the last step

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>

#include "mechanics/methods/composition.h"
#include "mechanics/methods/dormand_prince_8.h"
#include "mechanics/methods/energy_momentum.h"
#include "mechanics/methods/gauss_16.h"
#include "mechanics/methods/rattle.h"
#include "mechanics/methods/symmetric_multistep.h"

namespace pseudorigid::mechanics {

/// All methods. Within each family the order of accuracy increases.
using MethodTable = std::tuple<Rattle,          //
                               Rattle4,         //
                               Rattle6,         //
                               Rattle8,         //
                               Symmetric4,      //
                               Symmetric8,      //
                               Symmetric12,     //
                               EnergyMomentum,  //
                               Gauss16,         //
                               DormandPrince8>;

/// The traits that every method must declare. The compiler reports an error if a method of the table lacks a trait.
template <class M>
concept DeclaresTraits = requires {
  { M::name } -> std::convertible_to<std::string_view>;
  { M::documentation } -> std::convertible_to<std::string_view>;
  { M::order } -> std::convertible_to<int>;
  { M::symplectic } -> std::convertible_to<bool>;
  { M::symmetric } -> std::convertible_to<bool>;
  { M::adaptive } -> std::convertible_to<bool>;
  { M::chosen_by_auto } -> std::convertible_to<bool>;
};
static_assert([]<class... Methods>(std::tuple<Methods...>*) { return (DeclaresTraits<Methods> && ...); }(
                  static_cast<MethodTable*>(nullptr)),
              "a method of the table leaves out a trait");

/// Largest hω of the steps that a search for the step tries, without a safety factor. The value is the smaller of the
/// stability limit and the resonance limit, if there is one.
template <class Method>
inline constexpr double step_limit = [] {
  if constexpr (requires { Method::resonance_limit; })
    return std::min(Method::stability_limit, Method::resonance_limit);
  else
    return Method::stability_limit;
}();

/// The position of a method in the table, which identifies the method.
enum class MethodId : std::size_t {};

namespace detail {
template <class Method, class... Methods>
consteval MethodId place_of(std::tuple<Methods...>*) {
  std::size_t place = 0;
  (void)((std::is_same_v<Method, Methods> || (++place, false)) || ...);
  return MethodId{place};
}
}  // namespace detail

template <class Method>
inline constexpr MethodId id_of = detail::place_of<Method>(static_cast<MethodTable*>(nullptr));

inline constexpr std::size_t n_methods = std::tuple_size_v<MethodTable>;

/// Calls visitor(Method{}) for every method of the table, in order.
template <class Visitor>
constexpr void for_each_method(Visitor&& visitor) {
  std::apply([&](auto... method) { (visitor(method), ...); }, MethodTable{});
}

/// Calls visitor(Method{}) for the method `id`, and returns the result of this call.
template <class Visitor, std::size_t place = 0>
constexpr decltype(auto) with_method(MethodId id, Visitor&& visitor) {
  using Method = std::tuple_element_t<place, MethodTable>;
  if constexpr (place + 1 < n_methods)
    if (id != MethodId{place}) return with_method<Visitor, place + 1>(id, std::forward<Visitor>(visitor));
  return std::forward<Visitor>(visitor)(Method{});
}

/// Returns the name of the method in parameter files.
constexpr std::string_view method_name(MethodId id) {
  return with_method(id, []<class Method>(Method) { return std::string_view(Method::name); });
}

/// Returns the method with this name, or an empty optional if there is none.
constexpr std::optional<MethodId> find_method(std::string_view name) {
  std::optional<MethodId> found;
  for_each_method([&]<class Method>(Method) {
    if (name == Method::name) found = id_of<Method>;
  });
  return found;
}

}  // namespace pseudorigid::mechanics
