#pragma once
/// Interface of a load; one header and one line in list.h add it to the whole program.
///
/// A load is a struct of parameters, absent by default, in the user's units as in internal ones, with
///
///   visit_entries(self, visit)    its entries: visit(member, kind, About), as in scene/entries.h. The kinds say
///                                 which reflections it admits: a matrix without entries off the diagonal in the rows
///                                 and columns of the normal, a vector without the component along it. The units give
///                                 its values in internal units.
///   forcing()                     what it does (forcing.h); zero if it is absent
///   no_equilibria                 why no relative equilibrium is known under it, a sentence for the first of its
///                                 entries; empty if the families of equilibria know it
///   needed(body), skipped         the lines of `pseudorigid check` if it is present and if not; empty: none
///
/// or, where the force depends on time, in place of forcing() both  forcing(t)  and  forcing_rate(t), its derivative,
/// with  largest_forcing()  of all times, and if it is periodic  angular_frequency(), so that a motion that follows it
/// is not taken for a pulsation of the body. Consequences of the forcing are not declared again: whether it dissipates,
/// its effect on the centre of mass, its energy and that of a change in time, and its scale of time.

#include <concepts>
#include <string>
#include <string_view>

#include "entries/about.h"
#include "entries/entry_kinds.h"
#include "loads/forcing.h"

namespace pseudorigid::loads {

/// Data of the body for a line about a load.
struct BodyFacts {
  bool incompressible;
  double volume_by_inertia;  ///< Vol/m̄, by which a pressure is that of the column `multiplier`
};

/// For the entries of a load that are not used.
struct IgnoresEntries {
  void operator()(auto&, const auto&, const scene::About&) const {}
};

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

/// The largest forcing over all times.
template <Load L>
Forcing largest_forcing(const L& load) {
  if constexpr (DependsOnTime<L>)
    return load.largest_forcing();
  else
    return load.forcing();
}

template <Load L>
bool present(const L& load) {
  return largest_forcing(load).present();
}

}  // namespace pseudorigid::loads
