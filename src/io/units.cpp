#include "io/units.h"

#include <algorithm>
#include <cstdlib>

namespace pseudorigid::io {

Units ball_units(double radius, double density, double time) {
  return {.length = radius, .mass = density * radius * radius * radius, .time = time};
}

double Units::to_physical(double internal, scene::Unit unit) const {
  int of_length = 0, of_mass = 0, of_time = 0, of_stress = 0;
  unit.visit([&](std::string_view word, int power) {
    if (word == "length") of_length += power;
    if (word == "mass") of_mass += power;
    if (word == "time") of_time += power;
    if (word == "pressure") of_stress += power;
  });
  // Lengths per time are velocities, and 1/t² is the unit of the multiplier, as in the functions above: equal
  // quantities have equal last digits.
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

}  // namespace pseudorigid::io
