#include "io/units.h"

#include <cmath>

namespace pseudorigid::io {

Units ball_units(double radius, double density, double shear_modulus) {
  const double wave_speed = std::sqrt(shear_modulus / density);
  return {.length = radius, .mass = density * radius * radius * radius, .time = radius / wave_speed};
}

namespace {

void scale(mechanics::BodyObservables& o, const Units& units) {
  o.Qdot /= units.time;
  o.center *= units.length;
  o.velocity *= units.velocity();
  for (double* energy : {&o.kinetic, &o.elastic, &o.gravitational, &o.external, &o.dissipated})
    *energy *= units.energy();
  o.angular_momentum *= units.momentum();
  o.circulation *= units.momentum();
  o.multiplier *= units.multiplier();
  o.semi_axes *= units.length;
}

}  // namespace

mechanics::BodyObservables to_physical(const mechanics::BodyObservables& internal, const Units& units) {
  auto physical = internal;
  scale(physical, units);
  return physical;
}

mechanics::ContinuumObservables to_physical(const mechanics::ContinuumObservables& internal, const Units& units) {
  auto physical = internal;
  scale(physical, units);  // what only the continuum has is free of dimension
  return physical;
}

}  // namespace pseudorigid::io
