#pragma once
/// Checks of the sizes of numbers in a scene. The permitted range is 10⁻⁷⁰ to 10⁷⁰, because products of four such
/// numbers do not overflow or underflow. In a valid scene, the scales are in this range, and the units of the columns
/// are finite and not zero. In these scales, the entries are in this range or zero, and the initial state is finite.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "systems/system_scene.h"

namespace pseudorigid::systems {

namespace detail {

inline constexpr double largest_size = 1e70;

/// Returns true if x = 0 or if |x| is in the range from 1/largest_size to largest_size.
inline bool sound(double x) { return x == 0 || (std::abs(x) >= 1 / largest_size && std::abs(x) <= largest_size); }

/// Calls visitor(path, x) for each number x in the entries.
template <class SystemScene, class Visitor>
void visit_numbers(SystemScene& system, Visitor&& visitor) {
  SystemScene::visit(system, [&]<class Value>(Value& member, const auto&, const About& about) {
    if constexpr (std::is_same_v<Value, double>) visitor(about.path, member);
    if constexpr (std::is_same_v<Value, std::vector<double>>)
      for (const double x : member) visitor(about.path, x);
    if constexpr (std::is_same_v<Value, scene::Matrix3>)
      for (const auto& row : member)
        for (const double x : row) visitor(about.path, x);
  });
}

/// Returns true if the scales are in the range, and the units of the columns are finite and not zero or subnormal.
template <class SystemScene>
bool has_sound_units(const SystemScene& system, const Scales& scales) {
  for (const double unit : {scales.length, scales.mass, scales.time})
    if (unit == 0 || !sound(unit)) return false;
  return std::ranges::all_of(system.columns(),
                             [&](const Column& column) { return std::isnormal(scales(column.unit)); });
}

/// The entry with the number x whose |log₁₀ |x|| is largest. Zeros do not count. If there are numbers outside the
/// range, only these count, and `sound` is false. The path is empty if all numbers are zero.
struct Farthest {
  std::string path;
  double number = 1;
  bool sound = true;
};

template <class SystemScene>
Farthest farthest_number(SystemScene system) {
  Farthest farthest;
  const auto distance = [](double x) { return std::abs(std::log10(std::abs(x))); };
  visit_numbers(system, [&](std::string_view path, double x) {
    if (x == 0 || (!farthest.sound && sound(x))) return;
    if (farthest.path.empty() || farthest.sound != sound(x) || distance(x) > distance(farthest.number))
      farthest = {std::string(path), x, sound(x)};
  });
  return farthest;
}

}  // namespace detail

/// Refuses a scene with numbers outside the range, with scales or units outside their bounds, or with an initial state
/// that is not finite. Returns an empty result for a valid scene. The refusal names the entry with the number farthest
/// from 1. If a number in the scales of the scene is outside the range, the refusal shows the number in these scales.
/// Otherwise it shows the number in the units of the user. The function `starts_finite` receives the system in the
/// scales of the scene, and returns true if its initial state is finite.
template <class SystemScene, class StartsFinite>
std::optional<Refusal> refuses_sizes(SystemScene system, const StartsFinite& starts_finite) {
  const Scales scales = system.scales();
  detail::Farthest farthest = detail::farthest_number(system);
  if (detail::has_sound_units(system, scales)) {
    const auto in_own_scales = in_scales(system, scales);
    const detail::Farthest own = detail::farthest_number(in_own_scales);
    if (own.sound && starts_finite(in_own_scales)) return {};
    if (!own.sound) farthest = own;
  }
  return Refusal{farthest.path,
                 fmt::format("expected numbers whose sizes, in units of the scene itself, are between {:g} and "
                             "{:g}, got {}",
                             1 / detail::largest_size, detail::largest_size, scene::print_number(farthest.number))};
}

}  // namespace pseudorigid::systems
