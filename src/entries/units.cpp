#include "entries/units.h"

#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <unordered_map>
#include <utility>

namespace pseudorigid::io {

Units ball_units(double radius, double density, double time) {
  return {.length = radius, .mass = density * radius * radius * radius, .time = time};
}

namespace {

/// The powers of length, mass, time and stress (the word `pressure`) in a unit.
struct Powers {
  int length = 0, mass = 0, time = 0, stress = 0;
};

Powers read_powers(scene::Unit unit) {
  Powers powers;
  unit.visit([&](std::string_view word, int power) {
    if (word == "length") powers.length += power;
    if (word == "mass") powers.mass += power;
    if (word == "time") powers.time += power;
    if (word == "pressure") powers.stress += power;
  });
  return powers;
}

/// Returns the powers in a unit. A cache of each thread identifies the unit by the address of its words, which are a
/// string literal. Without the cache, reading the words would take longer than all other work on a row of the output.
const Powers& powers_of(scene::Unit unit) {
  thread_local std::unordered_map<const char*, Powers> known;
  const auto [found, is_new] = known.try_emplace(std::string_view(unit).data());
  if (is_new) found->second = read_powers(unit);
  return found->second;
}

}  // namespace

double Units::to_physical(double internal, scene::Unit unit) const {
  const auto [of_length, of_mass, time_power, of_stress] = powers_of(unit);
  int of_time = time_power;
  // Length per time is converted by velocity(), and 1/time² by multiplier(). The result then equals, bit for bit, a
  // conversion by the caller with these functions.
  const int of_velocity = std::clamp(-of_time, 0, std::max(of_length, 0));
  double factor = 1;
  const auto multiply = [&](double size, int power) {
    for (int i = 0; i < std::abs(power); ++i) factor = power > 0 ? factor * size : factor / size;
  };
  multiply(mass, of_mass);
  multiply(length, of_length - of_velocity);
  multiply(velocity(), of_velocity);
  multiply(stress(), of_stress);
  of_time += of_velocity;
  for (; of_time <= -2; of_time += 2) factor *= multiplier();
  return of_time < 0 ? internal * factor / time : internal * factor * (of_time > 0 ? time : 1);
}

double Units::to_internal(double physical, scene::Unit unit) const {
  const Powers powers = powers_of(unit);
  double above = 1, below = 1;  // numerator and denominator of the factor
  for (const auto& [size, power] : {std::pair{length, powers.length}, std::pair{mass, powers.mass},
                                    std::pair{stress(), powers.stress}, std::pair{time, powers.time}})
    for (int i = 0; i < std::abs(power); ++i) (power < 0 ? above : below) *= size;
  return physical * above / below;
}

}  // namespace pseudorigid::io
