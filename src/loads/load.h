#pragma once
/// Interface of a load. To add a load to the whole program, write a header and add one line to list.h.
///
/// A load is a struct of parameters, in the user's units or in internal units. A load with the default parameters is
/// absent. The members of a load are
///
///   visit_entries(self, visit)    calls visit(member, kind, About) for each entry, as in scene/entries.h. The unit in
///                                 About converts the value to internal units. The load admits the reflection of axis i
///                                 if the entries of its matrices off the diagonal in row i and column i are 0, and if
///                                 component i of its vectors is 0.
///   forcing()                     the load as a Forcing (forcing.h); zero if the load is absent
///   no_equilibria                 empty if the families of equilibria include this load; otherwise a sentence with the
///                                 reason why no relative equilibrium is known
///   needed(body), skipped         lines of `pseudorigid check` if the load is present and if it is absent; empty: none
///   breaks_plane(i)               optional, replaces the rules for entries: empty if the load admits the reflection of
///                                 axis i, otherwise the reason (scene/sector.cpp)
///   has_static_equilibria         optional, false if no equilibrium at rest is sought under the load
///
/// By default, a load is present if its largest forcing is not zero. An optional function is_present() replaces this
/// condition. A load that only changes other loads, such as Rise, has a forcing() of zero and needs is_present().
///
/// A load with a forcing that depends on time has forcing(t) and its derivative forcing_rate(t) instead of forcing().
/// It also has largest_forcing(), the forcing of largest size over all times. A periodic load also has
/// angular_frequency(), so that the program does not mistake the forced motion for a pulsation of the body. The
/// frequency 0 means no oscillation. Moving planes have a constant forcing(), which contains their speeds. The program
/// computes everything else from the forcing, for example the energy and its rate, the dissipation and the scale of
/// time.

#include <concepts>
#include <string>
#include <string_view>

#include "entries/about.h"
#include "entries/entry_kinds.h"
#include "loads/forcing.h"

namespace pseudorigid::loads {

/// Properties of the body that a load needs for its line in the output of `pseudorigid check`.
struct BodyFacts {
  bool incompressible;
  double volume_by_inertia;  ///< volume/m̄, with m̄ = ⅓ ∫ρ|X|² dX; converts a pressure to a multiplier per m̄
};

/// A visitor that ignores the entries, used to check the interface.
struct IgnoresEntries {
  void operator()(auto&, const auto&, const scene::About&) const {}
};

/// True for loads whose forcing depends on time.
template <class L>
concept DependsOnTime = requires(const L load, double t) {
  { load.forcing(t) } -> std::same_as<Forcing>;
};

template <class L>
concept Load = std::default_initializable<L> &&
    requires(L self, const L load, const BodyFacts& body, const IgnoresEntries& visit) {
  L::visit_entries(self, visit);
  L::visit_entries(load, visit);
  { L::no_equilibria } -> std::convertible_to<std::string_view>;
  { L::skipped } -> std::convertible_to<std::string_view>;
  { load.needed(body) } -> std::convertible_to<std::string>;
} && (DependsOnTime<L> ? requires(const L load, double t) {
  { load.forcing_rate(t) } -> std::same_as<Forcing>;
  { load.largest_forcing() } -> std::same_as<Forcing>;
} : requires(const L load) {
  { load.forcing() } -> std::same_as<Forcing>;
});

/// Returns the forcing of a load. If the load depends on time, the result is the forcing of largest size over all
/// times.
template <Load L>
Forcing largest_forcing(const L& load) {
  if constexpr (DependsOnTime<L>)
    return load.largest_forcing();
  else
    return load.forcing();
}

/// Returns true if the load is present. By default, this is the case if its largest forcing is not zero.
template <Load L>
bool present(const L& load) {
  if constexpr (requires { load.is_present(); })
    return load.is_present();
  else
    return largest_forcing(load).present();
}

}  // namespace pseudorigid::loads
