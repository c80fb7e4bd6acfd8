#pragma once
/// The incompressible ball on rigid planes, and its balance of energy.

#include "reduced/loaded_body.h"
#include "reduced/potential.h"
#include "reduced/pseudo_rigid_body.h"

namespace pseudorigid::testing {

using BodyOnPlanes = reduced::LoadedBody<reduced::PseudoRigidBody<reduced::Potential, true>>;
using StateOnPlanes = mechanics::State<BodyOnPlanes>;

inline BodyOnPlanes ball_on(const loads::Loads& loads) {
  const auto reference = reduced::ReferenceBody::unit_ball();
  const loads::Forcing forcing = loads::constant_forcing(loads);
  return {{reduced::Potential(materials::CiarletGeymonat{1, 0}, reference, forcing), reference}, loads};
}

/// The energy under the acceleration (0, 0, −g), with the dissipated energy and without the energy that planes gave.
inline double energy_of(const BodyOnPlanes& body, const StateOnPlanes& state, double g = 0) {
  const double mass = body.body().reference().mass;
  return body.body().kinetic_energy(body.matrix(state.v)) + body.body().potential_energy(body.matrix(state.q)) +
         0.5 * mass * body.center(state.v).squaredNorm() + mass * g * body.center(state.q)[2] +
         body.contact(state.t, state.q).energy + body.dissipated(state) + body.driven_energy(state);
}

}  // namespace pseudorigid::testing
