#include "io/units.h"

namespace pseudorigid::io {

Units ball_units(double radius, double density, double time) {
  return {.length = radius, .mass = density * radius * radius * radius, .time = time};
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

mechanics::ReducedObservables to_physical(const mechanics::ReducedObservables& internal, const Units& units) {
  auto physical = internal;
  scale(physical, units);
  physical.central_pressure *= units.stress();
  physical.axes *= units.length;
  physical.Omega_star /= units.time;
  physical.Lambda_star /= units.time;
  physical.bipolar_residual *= units.multiplier();
  return physical;
}

mechanics::ContinuumObservables to_physical(const mechanics::ContinuumObservables& internal, const Units& units) {
  auto physical = internal;
  scale(physical, units);  // what only the continuum has is free of dimension
  return physical;
}

}  // namespace pseudorigid::io
