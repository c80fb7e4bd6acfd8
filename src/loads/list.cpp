#include "loads/list.h"

#include <type_traits>

namespace pseudorigid::loads {

bool any_present(const Loads& loads) {
  bool any = false;
  loads.for_each([&](const auto& load) { any = any || present(load); });
  return any;
}

Forcing full_forcing(const Loads& loads) {
  Forcing sum;
  loads.for_each([&]<class L>(const L& load) {
    if constexpr (!DependsOnTime<L>) sum += load.forcing();
  });
  return sum;
}

Forcing constant_forcing(const Loads& loads) {
  const Forcing sum = full_forcing(loads);
  return loads.get<Rise>().is_present() ? Rise::constant(sum) : sum;
}

Forcing driving(const Loads& loads, double t) {
  Forcing sum;
  loads.for_each([&]<class L>(const L& load) {
    if constexpr (DependsOnTime<L>) sum += load.forcing(t);
  });
  const Rise& rise = loads.get<Rise>();
  if (!rise.is_present()) return sum;
  sum += Rise::rising(full_forcing(loads));
  return Rise::times(rise.factor(t), sum);
}

Forcing driving_rate(const Loads& loads, double t) {
  Forcing sum, rate;
  loads.for_each([&]<class L>(const L& load) {
    if constexpr (DependsOnTime<L>) sum += load.forcing(t), rate += load.forcing_rate(t);
  });
  const Rise& rise = loads.get<Rise>();
  if (!rise.is_present()) return rate;
  sum += Rise::rising(full_forcing(loads));
  rate = Rise::times(rise.factor(t), rate);
  return rate += Rise::times(rise.factor_rate(t), sum);
}

bool depend_on_time(const Loads& loads, const std::function<bool(const Forcing&)>& has) {
  bool any = loads.get<Rise>().is_present() && has(Rise::rising(full_forcing(loads)));
  loads.for_each([&]<class L>(const L& load) {
    if constexpr (DependsOnTime<L>) any = any || has(load.largest_forcing());
  });
  return any;
}

bool depend_on_time(const Loads& loads) {
  return full_forcing(loads).planes.moving() || depend_on_time(loads, [](const Forcing& f) { return f.present(); });
}

std::vector<double> angular_frequencies(const Loads& loads) {
  std::vector<double> frequencies;
  loads.for_each([&]<class L>(const L& load) {
    if constexpr (requires { load.angular_frequency(); })
      if (present(load) && load.angular_frequency() != 0) frequencies.push_back(load.angular_frequency());
  });
  return frequencies;
}

Loads at_constant_volume(Loads loads) {
  loads.for_each([]<class L>(L& load) {
    if constexpr (!std::is_same_v<L, Rise>)
      if (!largest_forcing(load).acts_at_constant_volume()) load = L{};
  });
  return loads;
}

}  // namespace pseudorigid::loads
