#pragma once
/// The list of loads, and functions that combine them. To add a load, write a header and add one line to the list.

#include <functional>
#include <tuple>
#include <type_traits>
#include <vector>

#include "loads/acceleration.h"
#include "loads/companions.h"
#include "loads/drag.h"
#include "loads/load.h"
#include "loads/periodic_tide.h"
#include "loads/pressure.h"
#include "loads/rigid_planes.h"
#include "loads/rise.h"
#include "loads/self_gravity.h"
#include "loads/tide.h"
#include "loads/traction.h"
#include "loads/viscoelasticity.h"
#include "loads/viscosity.h"

namespace pseudorigid::loads {

/// The loads in the order of a parameter file.
using LoadList = std::tuple<Viscosity,        //
                            Drag,             //
                            Viscoelasticity,  //
                            SelfGravity,      //
                            Tide,             //
                            PeriodicTide,     //
                            Acceleration,     //
                            Traction,         //
                            Pressure,         //
                            Rise,             //
                            RigidPlanes,      //
                            CompanionMasses>;

namespace detail {
template <class L, class... Known>
consteval bool is_one_of(std::tuple<Known...>*) {
  return (std::is_same_v<L, Known> || ...);
}
template <class... Known>
consteval bool are_loads(std::tuple<Known...>*) {
  return (Load<Known> && ...);
}
}  // namespace detail
static_assert(detail::are_loads(static_cast<LoadList*>(nullptr)), "a load of the list leaves out what load.h asks for");

template <class L>
concept KnownLoad = detail::is_one_of<L>(static_cast<LoadList*>(nullptr));

/// One object of each load. Loads{Tide{T}, Drag{0.1}} sets the given loads; all other loads are absent.
class Loads {
 public:
  template <KnownLoad... Named>
  Loads(const Named&... named) {
    ((get<Named>() = named), ...);
  }

  template <KnownLoad L>
  L& get() {
    return std::get<L>(list_);
  }
  template <KnownLoad L>
  const L& get() const {
    return std::get<L>(list_);
  }

  /// Calls visitor(load) for every load, in the order of the list.
  template <class Visitor>
  void for_each(Visitor&& visitor) {
    std::apply([&](auto&... load) { (visitor(load), ...); }, list_);
  }
  template <class Visitor>
  void for_each(Visitor&& visitor) const {
    std::apply([&](const auto&... load) { (visitor(load), ...); }, list_);
  }

 private:
  LoadList list_;
};

/// Calls visit(member, kind, About) for every entry of every load.
template <class L, class Visit>
void visit_entries(L& loads, Visit&& visit) {
  loads.for_each([&]<class One>(One& load) { std::remove_const_t<One>::visit_entries(load, visit); });
}

/// Returns true if at least one load of the list is present. Rise is a load of the list.
bool any_present(const Loads& loads);

/// Returns the sum of the forcings of all loads that have no time dependence of their own (DependsOnTime). Loads that
/// rise (rise.h) have their full strength in this sum.
Forcing full_forcing(const Loads& loads);
/// Returns the full forcing without the loads that rise. Planes are a part of the result, even if they move.
Forcing constant_forcing(const Loads& loads);

/// Returns the sum of the forcings that depend on time, at the time t. If the loads rise, the sum includes the rising
/// loads, and the factor of rise.h multiplies the sum.
Forcing driving(const Loads& loads, double t);
/// Returns the derivative of `driving` with respect to time.
Forcing driving_rate(const Loads& loads, double t);
/// Returns true if the condition `has` is true for a forcing that depends on time. The tested forcings are the sum of
/// the loads that rise, at full strength, and the largest forcing of each load that depends on time.
bool depend_on_time(const Loads& loads, const std::function<bool(const Forcing&)>& has);
/// Returns true if a forcing depends on time or a plane moves. Planes are not a part of `driving`, because the bodies
/// compute the positions of planes at the time t.
bool depend_on_time(const Loads& loads);

/// Returns the angular frequencies of the periodic loads that are present, without zeros.
std::vector<double> angular_frequencies(const Loads& loads);

/// Returns the loads without those that do not move a body of constant volume, such as a pressure. The constraint
/// balances the omitted loads. The rise of the loads does not change.
Loads at_constant_volume(Loads loads);

}  // namespace pseudorigid::loads
